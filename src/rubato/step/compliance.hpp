// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a bulk that keeps its effective matrix A answers to forces on its contact surfaces: A factored once,
/// and the surface compliance S = B A⁻¹ Bᵀ, B picking the contact unknowns. Columns of S are computed when
/// first asked for: few contact points are ever active.
#pragma once

#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::step {

class Compliance {
public:
  /// `surface`: unknowns of all contact surfaces, ascending.
  Compliance(linalg::CholeskyFactor factor, std::vector<int> surface, Eigen::Index unknowns);

  /// A⁻¹ force
  Eigen::VectorXd solve(const Eigen::VectorXd& force) const { return factor_.solve(force); }

  /// S for these unknowns, which must lie on the surfaces.
  Eigen::MatrixXd between(std::span<const int> unknowns);

private:
  void compute_missing(std::span<const int> positions);

  linalg::CholeskyFactor factor_;
  std::vector<int> surface_;
  Eigen::Index size_;
  std::vector<Eigen::VectorXd> columns_; ///< by position in surface_, empty until used
};

} // namespace rubato::step
