// SPDX-License-Identifier: LGPL-3.0-or-later
/// Decompositions of dense matrices, compiled once: Eigen's templates for them take longer to compile than
/// all else in a source. LAPACK makes them, but for the choice of columns.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace rubato::linalg {

struct SymmetricEigen {
  Eigen::VectorXd values;  ///< ascending
  Eigen::MatrixXd vectors; ///< a column each
};

/// A v = λ v with vectors of length one. Only the lower triangle of A is read. Numbers that are not found, as
/// of a matrix that is not finite, are NaN.
SymmetricEigen symmetric_eigen(const Eigen::MatrixXd& a);
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);
/// The largest eigenvalue of a symmetric tridiagonal matrix, NaN when it is not found. `beside` holds the
/// entries beside the diagonal.
double largest_of_tridiagonal(Eigen::VectorXd diagonal, Eigen::VectorXd beside);
/// A v = λ B v with v·B v = 1, B positive definite: otherwise all numbers are NaN.
SymmetricEigen generalized_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// Q of A = Q R (Householder): square and orthogonal; its first columns span those of A, where these are
/// independent, the others what is perpendicular to them.
Eigen::MatrixXd orthogonal_factor(const Eigen::MatrixXd& a);

/// X of A X = B for symmetric A. Unknowns whose pivots are rounding are 0.
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);
/// The smallest x that leaves least of A x = b, whatever the rank of A.
Eigen::VectorXd least_norm_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);

/// Columns of A that span all of them, in the order of their pivots (QR with column pivoting). Pivots up to
/// `threshold` of the largest count as rounding.
std::vector<std::size_t> independent_columns(const Eigen::MatrixXd& a, double threshold);

} // namespace rubato::linalg
