// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/mode_factor.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace rubato::element {
namespace {

/// Calls work(size) with the sizes that there are known at compile time: bubbles, QUAD4, HEXA8, HEXA8 in
/// small strain.
template <class Work> void with_size(int size, const Work& work) {
  if (size == 2)
    work(std::integral_constant<std::size_t, 2>{});
  else if (size == 3)
    work(std::integral_constant<std::size_t, 3>{});
  else if (size == 4)
    work(std::integral_constant<std::size_t, 4>{});
  else if (size == 9)
    work(std::integral_constant<std::size_t, 9>{});
  else
    work(std::integral_constant<std::size_t, 12>{});
}

} // namespace

ModeFactor::ModeFactor(const MatrixView& matrix, int first, int size) : size_(size) {
  with_size(size, [&](auto n) {
    for (std::size_t j = 0; j < n; ++j)
      std::copy_n(matrix.column(first + static_cast<int>(j)) + first, n.value, columns_[j].begin());
    for (std::size_t k = 0; k < n; ++k) {
      auto& column = columns_[k];
      std::size_t pivot = k;
      for (std::size_t i = k + 1; i < n; ++i)
        if (std::abs(column[i]) > std::abs(column[pivot]))
          pivot = i;
      exchanged_[k] = pivot;
      if (pivot != k)
        for (std::size_t j = 0; j < n; ++j)
          std::swap(columns_[j][k], columns_[j][pivot]);
      column[k] = 1 / column[k];
      for (std::size_t i = k + 1; i < n; ++i)
        column[i] *= column[k];
      for (std::size_t j = k + 1; j < n; ++j)
        for (std::size_t i = k + 1; i < n; ++i)
          columns_[j][i] -= column[i] * columns_[j][k];
    }
  });
}

void ModeFactor::solve(ModeValues& values) const {
  with_size(size_, [&](auto n) {
    for (std::size_t k = 0; k < n; ++k)
      std::swap(values[k], values[exchanged_[k]]);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t i = j + 1; i < n; ++i)
        values[i] -= columns_[j][i] * values[j];
    for (std::size_t j = n; j-- > 0;) {
      values[j] *= columns_[j][j];
      for (std::size_t i = 0; i < j; ++i)
        values[i] -= columns_[j][i] * values[j];
    }
  });
}

double dot(const ModeValues& x, const ModeValues& y, int size) {
  double sum = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i)
    sum += x[i] * y[i];
  return sum;
}

double largest(const ModeValues& values, int size) {
  double most = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) {
    if (std::isnan(values[i]))
      return values[i];
    most = std::max(most, std::abs(values[i]));
  }
  return most;
}

void condense_modes(const MatrixView& all, int node_dofs, int size, const MatrixView& k) {
  const ModeFactor factor(all, node_dofs, size);
  std::array<double, static_cast<std::size_t>(3 * most_nodes_of_cell)> followed;
  for (int j = 0; j < node_dofs; ++j) {
    ModeValues solved;
    for (int m = 0; m < size; ++m)
      solved[static_cast<std::size_t>(m)] = all(j, node_dofs + m);
    factor.solve(solved);
    std::fill_n(followed.begin(), j + 1, 0.);
    for (int m = 0; m < size; ++m)
      for (int i = 0; i <= j; ++i)
        followed[static_cast<std::size_t>(i)] += all(i, node_dofs + m) * solved[static_cast<std::size_t>(m)];
    for (int i = 0; i <= j; ++i)
      k(i, j) = k(j, i) = all(i, j) - followed[static_cast<std::size_t>(i)];
  }
}

} // namespace rubato::element
