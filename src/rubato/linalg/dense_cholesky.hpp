// SPDX-License-Identifier: LGPL-3.0-or-later
/// Dense symmetric positive definite systems (LAPACK).
#pragma once

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace rubato::linalg {

/// A = L Lᵀ (LAPACK), for several solves.
class DenseCholesky {
public:
  /// The lower triangle of the matrix is read. Solutions are NaN where it is not positive definite.
  explicit DenseCholesky(Eigen::MatrixXd matrix);

  Eigen::VectorXd solve(Eigen::VectorXd right_side) const;
  /// One column a right side.
  Eigen::MatrixXd solve(Eigen::MatrixXd right_sides) const;

private:
  void solve_in_place(double* values, Eigen::Index columns) const;
  Eigen::MatrixXd factor_;
};

/// x of A x = b; only the lower triangle of A is read. Full of NaN when A is not positive definite. Throws
/// std::invalid_argument when sizes do not match.
Eigen::VectorXd solve_positive_definite(Eigen::MatrixXd matrix, Eigen::VectorXd right_side);

/// A⁻¹, both triangles; only the upper triangle of A is read. Nothing when A is not positive definite.
std::optional<Eigen::MatrixXd> inverse_of_positive_definite(Eigen::MatrixXd matrix);

/// x of A x + b = 0 for the rows and columns of `unknowns`, in their order; else the same.
Eigen::VectorXd solve_among(std::span<const Eigen::Index> unknowns, const Eigen::MatrixXd& matrix,
                            const Eigen::VectorXd& values);

/// Rows of a positive semidefinite matrix that do not depend on one another, ascending: a Cholesky
/// factorisation with the largest remaining pivot first, as long as it is above `tolerance` (≥ 0). Only the
/// lower triangle is read.
std::vector<int> independent_rows(Eigen::MatrixXd matrix, double tolerance);

} // namespace rubato::linalg
