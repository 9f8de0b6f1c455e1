// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/sparse_products.hpp"

namespace rubato::linalg {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd product(const SparseMatrix& a, const VectorXd& x) {
  return a * x;
}

MatrixXd product(const SparseMatrix& a, const MatrixXd& x) {
  return a * x;
}

VectorXd transposed_product(const SparseMatrix& a, const VectorXd& x) {
  return a.transpose() * x;
}

MatrixXd transposed_product(const SparseMatrix& a, const MatrixXd& x) {
  return a.transpose() * x;
}

VectorXd symmetric_product(const SparseMatrix& a, const VectorXd& x) {
  return a.selfadjointView<Eigen::Lower>() * x;
}

MatrixXd gram_of_columns(const SparseMatrix& a) {
  return a.transpose() * MatrixXd(a);
}

MatrixXd dense_columns(const SparseMatrix& a, Eigen::Index first, Eigen::Index count) {
  return a.middleCols(first, count);
}

} // namespace rubato::linalg
