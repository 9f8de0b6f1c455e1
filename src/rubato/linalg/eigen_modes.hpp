// SPDX-License-Identifier: LGPL-3.0-or-later
/// The smallest eigenvalues of K φ = λ M φ with their vectors: the only file that knows Spectra.
#pragma once

#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <optional>

namespace rubato::linalg {

struct EigenModes {
  Eigen::VectorXd values;  ///< λ ≥ 0, ascending; exactly 0 of what K does not resist
  Eigen::MatrixXd vectors; ///< a column each, φ·M φ = 1, the entry of largest magnitude positive
  /// √(r·A⁻¹ r/(λ − σ)) with r = K φ − λ M φ and A = K − σ M; with constraints of what their forces do not
  /// carry. An eigenvalue μ of the matrices is no farther from λ than that part of μ − σ.
  Eigen::VectorXd residuals;
  double shift = 0; ///< σ: 0 when K is positive definite, else < 0
  /// Whether residuals are below 1e-7, or below what rounding of φ leaves where that is more. No smaller
  /// value was found in vectors orthogonal to these then.
  bool converged = false;
};

/// What is known of K: `none` says that it is singular, which spares an attempt to factor it.
enum class Support { unknown, none };

/// The `number` smallest λ of K φ = λ M φ, Cᵀ φ = 0, or all of them when there are fewer. K and M must be
/// symmetric (both triangles are stored) and positive semidefinite, K − σ M positive definite for σ < 0. C
/// has a row for each unknown and a column for each constraint; no columns: none.
///
/// Shift and invert (R. G. Grimes, J. G. Lewis, H. D. Simon, A shifted block Lanczos algorithm for solving
/// sparse symmetric generalized eigenproblems, SIAM J. Matrix Anal. Appl. 15 (1994) 228–272) by implicitly
/// restarted Lanczos (Spectra) on the Cholesky factor of K − σ M, then inverse iteration of the block with
/// Rayleigh–Ritz. One vector of a Lanczos run sees one vector of a multiple value, so further runs start in
/// what is orthogonal to all found, until they find no value below the largest wanted one. Starts are random
/// and always the same. Small systems are solved densely.
///
/// Nothing comes back when K − σ M is not positive definite to working precision or has a value that is not
/// finite. Throws std::invalid_argument when sizes do not match or `number` is below 1.
std::optional<EigenModes> smallest_modes(const SparseMatrix& stiffness, const SparseMatrix& mass,
                                         const SparseMatrix& constraints, Eigen::Index number,
                                         Support support = Support::unknown);

} // namespace rubato::linalg
