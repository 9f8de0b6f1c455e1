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

/// Of two blocks, the second one twice as stiff, all their unknowns on the surface; every unknown is its own
/// dof. `largest_last`: as SplitFactor::of has it.
inline step::Compliance
compliance_of_two_blocks(Eigen::Index largest_whole,
                         Eigen::Index largest_last = std::numeric_limits<Eigen::Index>::max()) {
  const auto block = elastic_block(5, 4, 3);
  const auto size = static_cast<int>(block.rows());
  linalg::SparseMatrix both(2 * size, 2 * size);
  for (int j = 0; j < 2 * size; ++j)
    for (linalg::SparseMatrix::InnerIterator entry(block, j % size); entry; ++entry)
      both.insert(entry.row() + j / size * size, j) = (1 + j / size) * entry.value();
  std::vector<int> all(static_cast<std::size_t>(2 * size));
  std::iota(all.begin(), all.end(), 0);
  const auto no_limit = std::numeric_limits<std::size_t>::max();
  auto factor = linalg::SplitFactor::of(
      both, all, no_limit, [](std::size_t) {}, largest_last);
  return {std::move(*factor), constraint::Reduction(2 * size, {}), {}, largest_whole};
}

inline std::vector<int> interface_dofs_of(const step::Compliance& compliance) {
  std::vector<int> all(static_cast<std::size_t>(compliance.size()));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

} // namespace rubato::test
