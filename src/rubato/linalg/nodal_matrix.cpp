// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/nodal_matrix.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace rubato::linalg {
namespace {

template <std::size_t Components>
void multiply(const Eigen::SparseMatrix<double, Eigen::RowMajor, int>& matrix, const Eigen::VectorXd& x,
              Eigen::VectorXd& y) {
  for (int row = 0; row < matrix.outerSize(); ++row) {
    std::array<double, Components> sum{};
    for (Eigen::SparseMatrix<double, Eigen::RowMajor, int>::InnerIterator entry(matrix, row); entry;
         ++entry) {
      const double* const from = x.data() + static_cast<std::ptrdiff_t>(Components) * entry.col();
      for (std::size_t a = 0; a < Components; ++a)
        sum[a] += entry.value() * from[a];
    }
    std::copy_n(sum.data(), Components, y.data() + static_cast<std::ptrdiff_t>(Components) * row);
  }
}

} // namespace

NodalMatrix::NodalMatrix(const Eigen::SparseMatrix<double, Eigen::ColMajor, int>& matrix, int components)
    : components_(components) {
  if (components < 1 || components > 3 || matrix.rows() != matrix.cols() || matrix.rows() % components != 0)
    throw std::invalid_argument("the matrix is no square of nodes with one to three components");
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int column = 0; column < matrix.outerSize(); column += components)
    for (Eigen::SparseMatrix<double, Eigen::ColMajor, int>::InnerIterator entry(matrix, column); entry;
         ++entry)
      if (entry.row() % components == 0)
        entries.emplace_back(static_cast<int>(entry.row()) / components, column / components, entry.value());
  of_nodes_.resize(matrix.rows() / components, matrix.rows() / components);
  of_nodes_.setFromTriplets(entries.begin(), entries.end());
}

Eigen::VectorXd NodalMatrix::operator*(const Eigen::VectorXd& x) const {
  if (x.size() != rows())
    throw std::invalid_argument("NodalMatrix wants a vector of its size");
  Eigen::VectorXd y(rows());
  if (components_ == 1)
    multiply<1>(of_nodes_, x, y);
  else if (components_ == 2)
    multiply<2>(of_nodes_, x, y);
  else
    multiply<3>(of_nodes_, x, y);
  return y;
}

} // namespace rubato::linalg
