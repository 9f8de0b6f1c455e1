// SPDX-License-Identifier: LGPL-3.0-or-later
// Sets of items that are joined one pair after another.
#include "rubato/core/disjoint_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace rubato::disjoint_sets_test {
namespace {

std::vector<std::size_t> roots(DisjointSets& sets, std::size_t items) {
  std::vector<std::size_t> all;
  for (std::size_t item = 0; item < items; ++item)
    all.push_back(sets.root(item));
  return all;
}

TEST(ItemsThatNothingJoins, AreSetsOfTheirOwn) {
  DisjointSets sets(3);
  EXPECT_EQ(roots(sets, 3), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(JoinedItems, HaveTheLowestOfThemAsRoot) {
  DisjointSets sets(7);
  sets.join(6, 4);
  EXPECT_EQ(roots(sets, 7), (std::vector<std::size_t>{0, 1, 2, 3, 4, 5, 4}));
  sets.join(5, 6);
  sets.join(2, 2);
  sets.join(3, 5);
  EXPECT_EQ(roots(sets, 7), (std::vector<std::size_t>{0, 1, 2, 3, 3, 3, 3}));
  sets.join(1, 4);
  EXPECT_EQ(roots(sets, 7), (std::vector<std::size_t>{0, 1, 2, 1, 1, 1, 1}));
}

/// What is known of each item by looking at all pairs again and again.
std::vector<std::size_t> lowest_reached(std::size_t items,
                                        const std::vector<std::pair<std::size_t, std::size_t>>& pairs) {
  std::vector<std::size_t> lowest;
  for (std::size_t item = 0; item < items; ++item)
    lowest.push_back(item);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [one, other] : pairs) {
      const auto least = std::min(lowest[one], lowest[other]);
      changed = changed || lowest[one] != least || lowest[other] != least;
      lowest[one] = lowest[other] = least;
    }
  }
  return lowest;
}

TEST(JoinedItems, AreThoseThatPairsConnectInWhateverOrderTheyAreJoined) {
  constexpr std::size_t items = 60;
  std::mt19937 random(5);
  std::uniform_int_distribution<std::size_t> any(0, items - 1);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (int i = 0; i < 45; ++i)
    pairs.emplace_back(any(random), any(random));
  const auto expected = lowest_reached(items, pairs);
  ASSERT_GT(std::ranges::count(expected, 0U), 1);
  for (int order = 0; order < 20; ++order) {
    DisjointSets sets(items);
    for (const auto& [one, other] : pairs)
      sets.join(one, other);
    EXPECT_EQ(roots(sets, items), expected) << order;
    std::ranges::shuffle(pairs, random);
  }
}

/// A chain joined from its end is as deep as a tree can get.
TEST(AChainOfItems, HasItsFirstAsRoot) {
  constexpr std::size_t items = 1000;
  DisjointSets sets(items);
  for (std::size_t item = items - 1; item > 0; --item)
    sets.join(item, item - 1);
  EXPECT_EQ(roots(sets, items), std::vector<std::size_t>(items, 0));
}

} // namespace
} // namespace rubato::disjoint_sets_test
