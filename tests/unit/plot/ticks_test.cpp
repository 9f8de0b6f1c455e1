// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/ticks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rubato::plot::ticks_test {
namespace {

std::vector<std::string> labels_of(const Ticks& ticks) {
  std::vector<std::string> labels;
  for (const double value : ticks.values)
    labels.push_back(label_of(ticks, value));
  return labels;
}

TEST(Ticks, AreRoundNumbersInsideOfTheRange) {
  EXPECT_EQ(labels_of(ticks_in({0, 1}, 5)),
            (std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(labels_of(ticks_in({-7, 12}, 5)), (std::vector<std::string>{"−5", "0", "5", "10"}));
  EXPECT_EQ(labels_of(ticks_in({0.9, 3.1}, 6)),
            (std::vector<std::string>{"1.0", "1.5", "2.0", "2.5", "3.0"}));
}

TEST(Ticks, AreAtMostOneMoreThanWhatHasRoomForAnyRange) {
  for (const double length : {1.0, 1.7, 2.3, 4.9, 5.1, 9.9, 3e-9, 7e12})
    for (const double low : {0.0, -0.3 * length, 1.25 * length})
      for (const int most : {2, 5, 8}) {
        const auto ticks = ticks_in({low, low + length}, most);
        EXPECT_GE(ticks.values.size(), 1U);
        EXPECT_LE(ticks.values.size(), static_cast<std::size_t>(most) + 1) << low << " " << length;
        EXPECT_GE(ticks.values.front(), low - 1e-9 * length);
        EXPECT_LE(ticks.values.back(), low + length * (1 + 1e-9));
      }
}

TEST(Ticks, HaveAnExponentWhereTheirNumbersWouldBeLong) {
  const auto small = ticks_in({0, 3e-6}, 4);
  EXPECT_EQ(labels_of(small), (std::vector<std::string>{"0", "1", "2", "3"}));
  EXPECT_EQ(factor_of(small), "×10⁻⁶");
  const auto large = ticks_in({-2e5, 2e5}, 4);
  EXPECT_EQ(labels_of(large), (std::vector<std::string>{"−200", "−100", "0", "100", "200"}));
  EXPECT_EQ(factor_of(large), "×10³");
  EXPECT_EQ(factor_of(ticks_in({0, 5000}, 4)), "");
  EXPECT_EQ(factor_of(ticks_in({0, 0.01}, 4)), "");
}

TEST(Ticks, TellSmallRangesAroundLargeNumbersApart) {
  const auto ticks = ticks_in({1000, 1000.0005}, 5);
  const auto labels = labels_of(ticks);
  ASSERT_GE(labels.size(), 3U);
  for (std::size_t i = 1; i < labels.size(); ++i)
    EXPECT_NE(labels[i - 1], labels[i]);
  EXPECT_EQ(labels[1], "1000.0001");
}

TEST(Ranges, HoldTheirNumbersWithAMargin) {
  const auto range = range_of({3, -1, 2}, 0.1);
  EXPECT_NEAR(range.low, -1.4, 1e-15);
  EXPECT_NEAR(range.high, 3.4, 1e-15);
}

TEST(Ranges, OfOneNumberOrNoneHaveALength) {
  for (const double value : {0.0, 45.0, -3e-7}) {
    const auto range = range_of({value, value});
    EXPECT_LT(range.low, value);
    EXPECT_GT(range.high, value);
  }
  EXPECT_EQ(range_of({}).length(), 1);
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(range_of({nothing}).length(), 1);
  EXPECT_EQ(range_of({nothing, 2, 4}).low, 2);
}

} // namespace
} // namespace rubato::plot::ticks_test
