// SPDX-License-Identifier: LGPL-3.0-or-later
/// Sets of items that are joined one pair after another: a forest with one tree for each set (union-find with
/// path halving).
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace rubato {

class DisjointSets {
public:
  /// Each of the items 0, 1, … in a set of its own.
  explicit DisjointSets(std::size_t items) : parent_(items) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// The lowest item of the set that this one is in, in whatever order the set was joined.
  std::size_t root(std::size_t item) {
    while (parent_[item] != item)
      item = parent_[item] = parent_[parent_[item]];
    return item;
  }

  void join(std::size_t one, std::size_t other) {
    const auto [low, high] = std::minmax({root(one), root(other)});
    parent_[high] = low;
  }

private:
  std::vector<std::size_t> parent_; ///< never above its item
};

} // namespace rubato
