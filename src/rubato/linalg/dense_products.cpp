// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_products.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace rubato::linalg {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

double largest_of(std::span<const double> values) {
  double largest = 0;
  for (const double value : values)
    largest = std::max(largest, std::abs(value));
  return largest;
}

} // namespace

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

void add_square(double factor, const VectorXd& v, MatrixXd& a) {
  for (Eigen::Index j = 0; j < v.size(); ++j)
    for (Eigen::Index i = 0; i < v.size(); ++i)
      a(i, j) += factor * v[i] * v[j];
}

double largest_magnitude(const VectorXd& values) {
  return largest_of({values.data(), static_cast<std::size_t>(values.size())});
}

double largest_magnitude(const MatrixXd& values) {
  return largest_of({values.data(), static_cast<std::size_t>(values.size())});
}

} // namespace rubato::linalg
