// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/function.hpp"

#include <gtest/gtest.h>

namespace rubato::load::function_test {
namespace {

using Outside = Function::Outside;

Function hill(Outside outside) {
  return {{1, 2, 4}, {10, 30, 20}, outside};
}

TEST(FunctionOfTime, IsLinearBetweenItsPoints) {
  const auto f = hill(Outside::constant);
  EXPECT_DOUBLE_EQ(value_at(f, 1), 10);
  EXPECT_DOUBLE_EQ(value_at(f, 1.25), 15);
  EXPECT_DOUBLE_EQ(value_at(f, 2), 30);
  EXPECT_DOUBLE_EQ(value_at(f, 3), 25);
  EXPECT_DOUBLE_EQ(value_at(f, 4), 20);
}

TEST(FunctionOfTime, KeepsItsEndValuesWhenConstantOutside) {
  EXPECT_DOUBLE_EQ(value_at(hill(Outside::constant), -5), 10);
  EXPECT_DOUBLE_EQ(value_at(hill(Outside::constant), 9), 20);
}

TEST(FunctionOfTime, GoesOnAlongItsEndPiecesWhenLinearOutside) {
  EXPECT_DOUBLE_EQ(value_at(hill(Outside::linear), 0), -10);
  EXPECT_DOUBLE_EQ(value_at(hill(Outside::linear), 6), 10);
}

TEST(FunctionOfTime, IsZeroOutsideButNotAtItsEnds) {
  EXPECT_DOUBLE_EQ(value_at(hill(Outside::zero), 0.999), 0);
  EXPECT_DOUBLE_EQ(value_at(hill(Outside::zero), 1), 10);
  EXPECT_DOUBLE_EQ(value_at(hill(Outside::zero), 4), 20);
  EXPECT_DOUBLE_EQ(value_at(hill(Outside::zero), 4.001), 0);
}

TEST(FunctionOfTime, JumpsToTheLaterValueWhereATimeStandsTwice) {
  const Function step{{0, 1, 1, 2}, {0, 0, 5, 5}, Outside::constant};
  EXPECT_DOUBLE_EQ(value_at(step, 0.999), 0);
  EXPECT_DOUBLE_EQ(value_at(step, 1), 5);
  EXPECT_DOUBLE_EQ(value_at(step, 1.5), 5);
}

TEST(FunctionOfTime, IsConstantWithOnePoint) {
  for (const auto outside : {Outside::constant, Outside::linear})
    for (const double t : {-1., 3., 7.})
      EXPECT_DOUBLE_EQ(value_at({{3}, {8}, outside}, t), 8);
  EXPECT_DOUBLE_EQ(value_at({{3}, {8}, Outside::zero}, 3), 8);
  EXPECT_DOUBLE_EQ(value_at({{3}, {8}, Outside::zero}, 4), 0);
}

TEST(FunctionOfTime, RisesAlongARampAndStays) {
  const Function ramp(Ramp{1, 3, 2, -2});
  EXPECT_DOUBLE_EQ(value_at(ramp, 0), 2);
  EXPECT_DOUBLE_EQ(value_at(ramp, 1), 2);
  EXPECT_DOUBLE_EQ(value_at(ramp, 1.5), 1);
  EXPECT_DOUBLE_EQ(value_at(ramp, 3), -2);
  EXPECT_DOUBLE_EQ(value_at(ramp, 9), -2);
}

TEST(FunctionOfTime, SwingsWithItsPhaseInDegrees) {
  const Function sine(Sine{3, 0.5, 30, 1});
  EXPECT_NEAR(value_at(sine, 0), 1 + 3 * 0.5, 1e-14);
  EXPECT_NEAR(value_at(sine, 2.0 / 3), 1 + 3 * 0.5, 1e-14); // 120 degrees on
  EXPECT_NEAR(value_at(sine, 1), 1 - 3 * 0.5, 1e-14);
}

TEST(FunctionOfTime, IsAProductOrAnExpression) {
  const Function expression(Expression("2*t^2"));
  EXPECT_DOUBLE_EQ(value_at(expression, 3), 18);
  const Function product(Product{{expression, Function(Ramp{0, 4, 0, 1}), Function{{0}, {5}}}});
  EXPECT_DOUBLE_EQ(value_at(product, 2), 8 * 0.5 * 5);
  EXPECT_EQ(factor_count(product), 3U);
  EXPECT_EQ(table_size(product), 1U);
  EXPECT_EQ(product, Function(product));
  EXPECT_FALSE(product == expression);
}

TEST(FunctionOfTime, RefusesWhatHasNoFiniteValue) {
  EXPECT_THROW(value_at(Function(Expression("1/t")), 0), InputError);
  EXPECT_THROW(value_at(Function(Expression("sqrt(t)")), -1), InputError);
  EXPECT_THROW(value_at(Function(Product{}), 0), InputError);
}

TEST(FunctionOfTime, RefusesAnEmptyOrLopsidedTable) {
  EXPECT_THROW(value_at({}, 0), InputError);
  EXPECT_THROW(value_at({{1, 2}, {1}, Outside::constant}, 0), InputError);
}

} // namespace
} // namespace rubato::load::function_test
