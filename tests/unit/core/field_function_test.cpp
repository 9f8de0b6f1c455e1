// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/field_function.hpp"

#include <gtest/gtest.h>

#include <array>

namespace rubato::field_function_test {
namespace {

constexpr std::array place{0.5, 2.0, 0.0};
const Function ramp{{0, 1}, {0, 2}};

FieldFunction field(const std::string& text, const std::optional<Function>& function = {}) {
  return {.expression = Expression(text), .function = function, .path = "contact.a.gap"};
}

TEST(AFieldFunction, IsANumberOrAnExpressionTimesAFunctionOfTime) {
  EXPECT_EQ((FieldFunction{.number = 3, .expression = {}, .function = {}}.at(place, 0.5)), 3);
  EXPECT_EQ((FieldFunction{.number = 3, .expression = {}, .function = ramp}.at(place, 0.5)), 3);
  EXPECT_EQ((FieldFunction{.number = 3, .expression = {}, .function = ramp}.at(place, 0.25)), 1.5);
  EXPECT_EQ(field("x*y").at(place, 7), 1);
  EXPECT_EQ(field("x*y+t").at(place, 7), 8);
  EXPECT_EQ(field("x*y+t", ramp).at(place, 0.75), 1.75 * 1.5);
}

TEST(AFieldFunction, KnowsWhatItVariesWith) {
  EXPECT_TRUE(field("x").varies_in_place());
  EXPECT_FALSE(field("x").varies_in_time());
  EXPECT_TRUE(field("x", ramp).varies_in_time());
  EXPECT_TRUE(field("t").varies_in_time());
  EXPECT_FALSE(field("t").varies_in_place());
  EXPECT_FALSE((FieldFunction{.number = 2, .expression = {}, .function = {}}.varies_in_time()));
}

TEST(AFieldFunction, RefusesWhatIsNotFiniteWithPlaceAndInstant) {
  const auto told = [](const FieldFunction& field, double t) {
    try {
      field.at(place, t);
    } catch (const InputError& error) {
      EXPECT_EQ(error.faults().front().path, "contact.a.gap");
      return error.faults().front().text;
    }
    return std::string();
  };
  EXPECT_EQ(told(field("1/(t-0.5)"), 0.25), "");
  EXPECT_EQ(told(field("1/(t-0.5)"), 0.5), "contact.a.gap: '1/(t-0.5)' is infinite at x = 0.5, y = 2, z = 0, "
                                           "t = 0.5, expected a finite number");
  EXPECT_EQ(told(field("sqrt(-y)", ramp), 0), "contact.a.gap: 'sqrt(-y)' is not a number at x = 0.5, y = 2, "
                                              "z = 0, t = 0, expected a finite number");
}

TEST(AFieldFunction, MayBeATableAlongAnAxis) {
  FieldFunction table;
  table.profile = Profile{1, {{0, 2}, {1, 5}, LinearTable::Outside::constant}};
  table.function = ramp;
  EXPECT_TRUE(table.varies_in_place());
  EXPECT_EQ(table.at(std::array{9.0, 1.0, 9.0}, 0.5), 3);
  EXPECT_EQ(table.at(std::array{9.0, 7.0, 9.0}, 1), 10);
  EXPECT_EQ(table.multiplied_at(std::array{9.0, 1.0, 9.0}, 0.25), 3);
  auto other = table;
  other.profile->axis = 0;
  EXPECT_FALSE(table == other);
}

} // namespace
} // namespace rubato::field_function_test
