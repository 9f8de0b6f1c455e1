// SPDX-License-Identifier: LGPL-3.0-or-later
/// Eigenvalues of largest magnitude by Lanczos' method.
#pragma once

#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/linear_map.hpp"

#include <Eigen/Core>

namespace rubato::linalg {

struct RitzLimits {
  Eigen::Index wanted = 1;  ///< eigenvalues
  Eigen::Index vectors = 2; ///< of the Krylov space, more than are wanted
  int restarts = 1;
  double tolerance = 0; ///< of eigenvalues, relative
};

/// θ of A M v = θ v with vᵀ M v = 1: `inverse` is A, `mass` is M, both symmetric, M positive semidefinite. Of
/// the wanted ones those that converged, in any order. Of equal eigenvalues one is found, as the Krylov space
/// of one start has one of them. Lanczos' method with full orthogonalisation and thick restarts (K. Wu and
/// H. Simon, SIAM J. Matrix Anal. Appl. 22 (2000) 602–616).
SymmetricEigen largest_ritz_pairs(const LinearMap& inverse, const LinearMap& mass,
                                  const Eigen::VectorXd& start, const RitzLimits& limits);

} // namespace rubato::linalg
