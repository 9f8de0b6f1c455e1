// SPDX-License-Identifier: LGPL-3.0-or-later
/// Decompositions that tests compare with, compiled once: each source that instantiates one of Eigen's
/// compiles seconds longer.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace rubato::test {

/// x of A x = b by LU with full pivoting.
Eigen::VectorXd dense_solution(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
/// x that minimises |A x − b|, for A of full column rank.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
/// x of A x = b for symmetric A; throws std::runtime_error where the factorisation fails.
Eigen::VectorXd sparse_solution(const Eigen::SparseMatrix<double>& a, const Eigen::VectorXd& b);
Eigen::MatrixXd inverse(const Eigen::MatrixXd& a);
Eigen::MatrixXd pseudo_inverse(const Eigen::MatrixXd& a);
double determinant(const Eigen::MatrixXd& a);
Eigen::Index rank(const Eigen::MatrixXd& a);
bool is_positive_definite(const Eigen::MatrixXd& a);
/// Ascending, of a symmetric matrix.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& a);
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& a);

/// K v = λ M v with vectors of modal mass 1, M positive definite; λ ascending.
struct GeneralModes {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors; ///< a column for each mode
};
GeneralModes general_modes(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);

} // namespace rubato::test
