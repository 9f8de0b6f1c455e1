// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/history.hpp"

#include <gtest/gtest.h>

namespace rubato::results::history_test {
namespace {

Table history() {
  return {{"t", "u"}, {{0, 10}, {0.1, 20}, {0.3, 0}, {1.0, 7}}};
}

TEST(ValueAt, IsTheRowsOwnAtItsInstant) {
  for (const auto& row : history().rows)
    EXPECT_EQ(value_at(history(), 1, row[0]), row[1]);
}

/// Steps sum up to 0.30000000000000004.
TEST(ValueAt, IsTheRowsOwnButForRoundingOfTheInstant) {
  EXPECT_EQ(value_at(history(), 1, 0.1 + 0.2), 0);
  EXPECT_EQ(value_at(history(), 1, 0.3 - 1e-12), 0);
}

TEST(ValueAt, IsLinearBetweenRows) {
  EXPECT_NEAR(value_at(history(), 1, 0.05).value(), 15, 1e-13);
  EXPECT_NEAR(value_at(history(), 1, 0.15).value(), 15, 1e-13);
  EXPECT_NEAR(value_at(history(), 1, 0.65).value(), 3.5, 1e-13);
}

TEST(ValueAt, IsNothingBesideTheHistory) {
  EXPECT_FALSE(value_at(history(), 1, -0.01));
  EXPECT_FALSE(value_at(history(), 1, 1.01));
  EXPECT_FALSE(value_at(history(), -1, 0.1));
  EXPECT_FALSE(value_at(Table(), 1, 0.1));
}

TEST(ValueAt, IsTakenFromAHistoryOfOneRow) {
  const Table one{{"t", "u"}, {{0.5, 3}}};
  EXPECT_EQ(value_at(one, 1, 0.5), 3);
  EXPECT_FALSE(value_at(one, 1, 0.4));
}

TEST(NamedInstant, IsMetByTheEndOfAStepButForRounding) {
  const double instants[] = {0.1, 0.7};
  EXPECT_TRUE(is_named_instant(instants, 0.1, 0.01));
  EXPECT_TRUE(is_named_instant(instants, 0.7 + 1e-9, 0.01)) << "a part of the step";
  EXPECT_TRUE(is_named_instant(instants, 0.7 * (1 + 1e-12), 1e-12)) << "a part of the instant";
  EXPECT_FALSE(is_named_instant(instants, 0.11, 0.01));
  EXPECT_FALSE(is_named_instant(instants, 0.70001, 0.01));
  EXPECT_FALSE(is_named_instant({}, 0.1, 0.01));
}

} // namespace
} // namespace rubato::results::history_test
