// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/report/quantise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rubato::report::quantise_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(QuantisedValues, AreOffByHalfAStepAtMost) {
  for (const auto levels : {finest_levels, std::uint16_t{1022}, std::uint16_t{1}}) {
    std::vector<double> values;
    for (int i = 0; i < 1000; ++i)
      values.push_back(1e6 * std::sin(0.37 * i) + 3e5);
    const auto quantised = quantise(values, levels);
    EXPECT_NEAR(quantised.step * levels, 2e6, 2e3);
    for (std::size_t i = 0; i < values.size(); ++i) {
      EXPECT_LE(quantised.numbers[i], levels);
      EXPECT_LE(std::abs(quantised.value(i) - values[i]), 0.5 * quantised.step * (1 + 1e-9));
    }
  }
}

TEST(QuantisedValues, HaveTheirLeastAndLargestExactly) {
  const std::vector<double> values{3.0, -1.25, 0.5};
  const auto quantised = quantise(values);
  EXPECT_EQ(quantised.numbers[1], 0);
  EXPECT_EQ(quantised.numbers[0], finest_levels);
  EXPECT_EQ(quantised.value(1), -1.25);
  EXPECT_NEAR(quantised.value(0), 3.0, 1e-14);
}

TEST(QuantisedValues, ThatAreAllEqualNeedNoRange) {
  const auto quantised = quantise(std::vector<double>{4.5, 4.5});
  EXPECT_EQ(quantised.step, 0.0);
  EXPECT_EQ(quantised.value(0), 4.5);
  EXPECT_EQ(quantised.value(1), 4.5);
}

TEST(QuantisedValues, KeepWhatIsNoNumberApart) {
  const auto quantised = quantise(std::vector<double>{1.0, std::nan(""), 2.0, infinity});
  EXPECT_EQ(quantised.least, 1.0);
  EXPECT_TRUE(std::isnan(quantised.value(1)));
  EXPECT_TRUE(std::isnan(quantised.value(3)));
  EXPECT_DOUBLE_EQ(quantised.value(2), 2.0);
  EXPECT_TRUE(std::isnan(quantise(std::vector<double>{infinity}).value(0)));
}

TEST(QuantisedValues, MayReachOverTheWholeRangeOfNumbers) {
  constexpr double largest = std::numeric_limits<double>::max();
  const auto quantised = quantise(std::vector<double>{-largest, 0.0, largest});
  EXPECT_TRUE(std::isfinite(quantised.step));
  EXPECT_EQ(quantised.numbers[0], 0);
  EXPECT_EQ(quantised.numbers[2], finest_levels);
}

} // namespace
} // namespace rubato::report::quantise_test
