// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/sparse_products.hpp"

#include <stdexcept>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void must_fit(Index size, Index expected) {
  if (size != expected)
    throw std::invalid_argument("a product of a sparse matrix with a vector of another size");
}

/// y += A x
void add_product(const SparseMatrix& a, const double* x, double* y) {
  for (Index column = 0; column < a.outerSize(); ++column) {
    const double factor = x[column];
    for (SparseMatrix::InnerIterator entry(a, column); entry; ++entry)
      y[entry.row()] += entry.value() * factor;
  }
}

/// y = Aᵀ x
void multiply_transposed(const SparseMatrix& a, const double* x, double* y) {
  for (Index column = 0; column < a.outerSize(); ++column) {
    double sum = 0;
    for (SparseMatrix::InnerIterator entry(a, column); entry; ++entry)
      sum += entry.value() * x[entry.row()];
    y[column] = sum;
  }
}

} // namespace

VectorXd product(const SparseMatrix& a, const VectorXd& x) {
  must_fit(x.size(), a.cols());
  VectorXd y = VectorXd::Zero(a.rows());
  add_product(a, x.data(), y.data());
  return y;
}

MatrixXd product(const SparseMatrix& a, const MatrixXd& x) {
  must_fit(x.rows(), a.cols());
  MatrixXd y = MatrixXd::Zero(a.rows(), x.cols());
  for (Index j = 0; j < x.cols(); ++j)
    add_product(a, x.data() + j * x.rows(), y.data() + j * y.rows());
  return y;
}

VectorXd transposed_product(const SparseMatrix& a, const VectorXd& x) {
  must_fit(x.size(), a.rows());
  VectorXd y(a.cols());
  multiply_transposed(a, x.data(), y.data());
  return y;
}

MatrixXd transposed_product(const SparseMatrix& a, const MatrixXd& x) {
  must_fit(x.rows(), a.rows());
  MatrixXd y(a.cols(), x.cols());
  for (Index j = 0; j < x.cols(); ++j)
    multiply_transposed(a, x.data() + j * x.rows(), y.data() + j * y.rows());
  return y;
}

VectorXd symmetric_product(const SparseMatrix& a, const VectorXd& x) {
  must_fit(x.size(), a.cols());
  VectorXd y = VectorXd::Zero(a.rows());
  for (Index column = 0; column < a.outerSize(); ++column) {
    double sum = 0;
    for (SparseMatrix::InnerIterator entry(a, column); entry; ++entry)
      if (entry.row() == column) {
        y[column] += entry.value() * x[column];
      } else if (entry.row() > column) {
        y[entry.row()] += entry.value() * x[column];
        sum += entry.value() * x[entry.row()];
      }
    y[column] += sum;
  }
  return y;
}

MatrixXd gram_of_columns(const SparseMatrix& a) {
  MatrixXd gram(a.cols(), a.cols());
  VectorXd column = VectorXd::Zero(a.rows());
  for (Index j = 0; j < a.cols(); ++j) {
    for (SparseMatrix::InnerIterator entry(a, j); entry; ++entry)
      column[entry.row()] += entry.value();
    multiply_transposed(a, column.data(), gram.data() + j * gram.rows());
    for (SparseMatrix::InnerIterator entry(a, j); entry; ++entry)
      column[entry.row()] = 0;
  }
  return gram;
}

MatrixXd dense_columns(const SparseMatrix& a, Index first, Index count) {
  MatrixXd columns = MatrixXd::Zero(a.rows(), count);
  for (Index j = 0; j < count; ++j)
    for (SparseMatrix::InnerIterator entry(a, first + j); entry; ++entry)
      columns(entry.row(), j) += entry.value();
  return columns;
}

} // namespace rubato::linalg
