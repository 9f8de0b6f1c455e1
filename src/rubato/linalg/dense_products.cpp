// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_products.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::linalg {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd product(const MatrixXd& a, const MatrixXd& b) {
  return a * b;
}

MatrixXd transposed_product(const MatrixXd& a, const MatrixXd& b) {
  return a.transpose() * b;
}

VectorXd product(const MatrixXd& a, const VectorXd& x) {
  return a * x;
}

VectorXd transposed_product(const MatrixXd& a, const VectorXd& x) {
  return a.transpose() * x;
}

void add_product(const MatrixXd& a, const VectorXd& x, VectorXd& y) {
  y.noalias() += a * x;
}

void add_scaled(double factor, const VectorXd& values, VectorXd& to) {
  const auto size = to.size();
  for (Eigen::Index i = 0; i < size; ++i)
    to[i] += factor * values[i];
}

double largest_magnitude(const VectorXd& values) {
  double largest = 0;
  for (const double value : values)
    largest = std::max(largest, std::abs(value));
  return largest;
}

} // namespace rubato::linalg
