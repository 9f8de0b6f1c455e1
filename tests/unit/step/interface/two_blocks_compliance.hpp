// SPDX-License-Identifier: LGPL-3.0-or-later
/// The compliance of two elastic blocks that nothing couples.
#pragma once

#include "rubato/step/interface/compliance.hpp"

#include "unit/linalg/elastic_block.hpp"
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace rubato::test {

/// A block whose nodes are coupled so far that its factor has more than half of all entries: S is then sooner
/// read than the factor.
inline linalg::SparseMatrix coupled_block() {
  const auto elastic = elastic_block(5, 4, 3);
  return elastic + 0.1 / elastic.diagonal().maxCoeff() * (elastic * elastic);
}

/// Two blocks of these stiffnesses.
inline linalg::SparseMatrix two_blocks(double first = 1, double second = 2) {
  const auto block = coupled_block();
  const auto size = static_cast<int>(block.rows());
  linalg::SparseMatrix both(2 * size, 2 * size);
  for (int j = 0; j < 2 * size; ++j)
    for (linalg::SparseMatrix::InnerIterator entry(block, j % size); entry; ++entry)
      both.insert(entry.row() + j / size * size, j) = (j < size ? first : second) * entry.value();
  return both;
}

/// All unknowns are on the surface, and every unknown is its own dof.
inline step::Compliance compliance_of(const linalg::SparseMatrix& matrix, Eigen::Index largest_whole,
                                      linalg::SurfaceLimits limits = {}) {
  std::vector<int> all(static_cast<std::size_t>(matrix.rows()));
  std::iota(all.begin(), all.end(), 0);
  const auto no_limit = std::numeric_limits<std::size_t>::max();
  auto factor = linalg::SplitFactor::of(
      matrix, all, no_limit, [](std::size_t) {}, limits);
  return {std::move(*factor), constraint::Reduction(static_cast<int>(matrix.rows()), {}), {}, largest_whole};
}

/// Of two blocks, the second one twice as stiff.
inline step::Compliance compliance_of_two_blocks(Eigen::Index largest_whole) {
  return compliance_of(two_blocks(), largest_whole);
}

inline std::vector<int> interface_dofs_of(const step::Compliance& compliance) {
  std::vector<int> all(static_cast<std::size_t>(compliance.size()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

} // namespace rubato::test
