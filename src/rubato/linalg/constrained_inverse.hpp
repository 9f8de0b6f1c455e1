// SPDX-License-Identifier: LGPL-3.0-or-later
/// Solutions of a symmetric positive definite system that keep linear constraints.
#pragma once

#include "rubato/linalg/dense_cholesky.hpp"
#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>

#include <optional>

namespace rubato::linalg {

/// x of A x + C μ = b, Cᵀ x = 0, on the Cholesky factor of A:
///   x = A⁻¹ (b − C S⁻¹ Cᵀ A⁻¹ b),  S = Cᵀ A⁻¹ C
/// S is dense, with a row for each constraint.
class ConstrainedInverse {
public:
  /// `constraints`: a row for each unknown and a column for each constraint, of any length. Columns that are
  /// zero or depend on others are left out. Nothing comes back when A is not positive definite to working
  /// precision or has a value that is not finite.
  static std::optional<ConstrainedInverse> of(const SparseMatrix& matrix, const SparseMatrix& constraints);

  Eigen::VectorXd solve(const Eigen::VectorXd& right_side) const;
  /// One column for each right side.
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_sides) const;

  /// What is left of forces when those of the constraints, C μ, take as much of them as they can.
  Eigen::VectorXd without_reactions(const Eigen::VectorXd& force) const;

  /// C without the columns that were left out.
  const SparseMatrix& constraints() const { return constraints_; }

private:
  explicit ConstrainedInverse(CholeskyFactor factor);
  template <class Vectors> Vectors solve_constrained(const Vectors& right_sides) const;

  CholeskyFactor factor_;
  SparseMatrix constraints_;
  std::optional<DenseCholesky> schur_;   ///< of S; none without constraints
  std::optional<DenseCholesky> lengths_; ///< of Cᵀ C; likewise
};

} // namespace rubato::linalg
