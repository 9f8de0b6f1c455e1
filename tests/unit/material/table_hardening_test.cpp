// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/table_hardening.hpp"

#include <gtest/gtest.h>

#include <array>

namespace rubato::material::table_hardening_test {
namespace {

const TableHardening table{{{0, 200}, {0.01, 260}, {0.03, 300}}};

TEST(TableHardening, IsLinearInBetweenAndKeepsItsLastSlope) {
  EXPECT_DOUBLE_EQ(yield(table, 0, 0, {}).stress, 200);
  EXPECT_DOUBLE_EQ(yield(table, 0.002, 0.003, {}).stress, 230);
  EXPECT_DOUBLE_EQ(yield(table, 0, 0.005, {}).slope, 6000);
  EXPECT_DOUBLE_EQ(yield(table, 0.02, 0, {}).stress, 280);
  EXPECT_DOUBLE_EQ(yield(table, 0.03, 0.05, {}).stress, 400);
  EXPECT_DOUBLE_EQ(yield(table, 0.03, 0.05, {}).slope, 2000);
}

TEST(TableHardening, OfOnePointDoesNotHarden) {
  const TableHardening one{{{0, 200}}};
  EXPECT_EQ(yield(one, 0.1, 0.1, {}).stress, 200);
  EXPECT_EQ(yield(one, 0.1, 0.1, {}).slope, 0);
}

TEST(TableHardening, OfATensionCurveTakesTheElasticStrainAway) {
  const std::array<TableHardening::Point, 2> curve{{{0.001, 200}, {0.0213, 260}}};
  const auto made = hardening_of_tension(200e3, curve);
  ASSERT_EQ(made.points.size(), 2U);
  EXPECT_EQ(made.points[0].strain, 0);
  EXPECT_NEAR(made.points[1].strain, 0.02, 1e-15);
  EXPECT_EQ(made.points[1].stress, 260);
}

} // namespace
} // namespace rubato::material::table_hardening_test
