// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/move_search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace rubato::step::move_search_test {
namespace {

struct Tried {
  SearchedPart found;
  std::vector<double> parts;
};

/// Along a move that starts at 100, by what is out of balance at a part of it.
template <class Unbalanced> Tried searched(const Unbalanced& unbalanced) {
  Tried tried;
  tried.found = search_along_move(100, unbalanced(1.0), [&](double part) {
    tried.parts.push_back(part);
    return unbalanced(part);
  });
  return tried;
}

TEST(SearchAlongAMove, TakesAllOfOneThatIsGoodEnough) {
  const auto tried = searched([](double) { return std::optional(80.0); });
  EXPECT_EQ(tried.found.best, 1);
  EXPECT_EQ(tried.found.tried, 1);
  EXPECT_TRUE(tried.parts.empty());
}

TEST(SearchAlongAMove, EndsAtTheFirstPartThatIsGoodEnough) {
  // least at 0.2, where halves do not come by
  const auto tried = searched([](double part) { return std::optional(60 + 300 * std::abs(part - 0.2)); });
  EXPECT_EQ(tried.found.best, 0.25);
  EXPECT_EQ(tried.parts, (std::vector{0.5, 0.25}));
}

TEST(SearchAlongAMove, TakesTheBestOfThoseThatAreNot) {
  const auto tried = searched([](double part) { return std::optional(part == 0.25 ? 101.0 : 200.0); });
  EXPECT_EQ(tried.found.best, 0.25);
  EXPECT_EQ(tried.found.tried, 0.0625);
}

TEST(SearchAlongAMove, KnowsNothingOfPartsWhereACellHasNoForces) {
  const auto tried = searched([](double part) { return part > 0.3 ? std::nullopt : std::optional(50.0); });
  EXPECT_EQ(tried.found.best, 0.25);
  EXPECT_EQ(tried.parts, (std::vector{0.5, 0.25}));
  EXPECT_EQ(searched([](double) { return std::optional<double>(); }).found.best, 1);
}

} // namespace
} // namespace rubato::step::move_search_test
