// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/linear_table.hpp"

#include <gtest/gtest.h>

namespace rubato::linear_table_test {
namespace {

using Outside = LinearTable::Outside;

LinearTable bent(Outside outside) {
  return {{-1, 0, 2, 3}, {-3, -1, 5, 4}, outside};
}

TEST(LinearTable, HasTheSlopeOfThePieceAfterACorner) {
  const auto table = bent(Outside::linear);
  EXPECT_EQ(slope_at(table, -0.5), 2);
  EXPECT_EQ(slope_at(table, 0), 3);
  EXPECT_EQ(slope_at(table, 2.5), -1);
  EXPECT_EQ(slope_at(table, -7), 2);
  EXPECT_EQ(slope_at(table, 3), -1);
  EXPECT_EQ(slope_at(bent(Outside::constant), -7), 0);
  EXPECT_EQ(slope_at(bent(Outside::zero), 7), 0);
  EXPECT_EQ(slope_at({{1}, {5}, Outside::linear}, 0), 0);
  EXPECT_EQ(steepest(table), 3);
  EXPECT_EQ(steepest({{1}, {5}}), 0);
}

/// Against sums of many trapezoids.
TEST(LinearTable, IsIntegratedFromZeroOn) {
  for (const auto outside : {Outside::linear, Outside::constant, Outside::zero})
    for (const double x : {-2.5, -1.0, -0.3, 0.0, 0.7, 2.0, 2.5, 4.0}) {
      const auto table = bent(outside);
      constexpr int parts = 400'000;
      double sum = 0;
      for (int i = 0; i < parts; ++i)
        sum += interpolated(table, x * (i + 0.5) / parts) * x / parts;
      EXPECT_NEAR(integral_to(table, x), sum, 1e-4) << x;
    }
}

TEST(LinearTable, IsIntegratedWhereZeroLiesOutside) {
  EXPECT_NEAR(integral_to({{1, 2}, {3, 5}, Outside::linear}, 2), 2 * 3, 1e-15);
  EXPECT_NEAR(integral_to({{1, 2}, {3, 5}, Outside::constant}, 2), 3 + 4, 1e-15);
}

} // namespace
} // namespace rubato::linear_table_test
