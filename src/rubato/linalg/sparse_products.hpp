// SPDX-License-Identifier: LGPL-3.0-or-later
/// Products with sparse matrices, compiled once: each source that instantiates Eigen's takes seconds more.
#pragma once

#include "rubato/linalg/sparse_matrix.hpp"

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace rubato::linalg {

/// A x
Eigen::VectorXd product(const SparseMatrix& a, const Eigen::VectorXd& x);
Eigen::MatrixXd product(const SparseMatrix& a, const Eigen::MatrixXd& x);
/// Aᵀ x
Eigen::VectorXd transposed_product(const SparseMatrix& a, const Eigen::VectorXd& x);
Eigen::MatrixXd transposed_product(const SparseMatrix& a, const Eigen::MatrixXd& x);
/// A x of a symmetric A, of which the lower triangle is read.
Eigen::VectorXd symmetric_product(const SparseMatrix& a, const Eigen::VectorXd& x);
/// AᵀA
Eigen::MatrixXd gram_of_columns(const SparseMatrix& a);
/// `count` columns from `first` on, dense.
Eigen::MatrixXd dense_columns(const SparseMatrix& a, Eigen::Index first, Eigen::Index count);

} // namespace rubato::linalg
