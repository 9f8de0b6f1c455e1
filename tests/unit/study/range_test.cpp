// SPDX-License-Identifier: LGPL-3.0-or-later
// Bounds of numbers.
#include "rubato/study/range.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rubato::study::range_test {
namespace {

TEST(ARange, HasItsBoundsOrNot) {
  EXPECT_TRUE(from_to(0, 1).contains(0));
  EXPECT_TRUE(from_to(0, 1).contains(1));
  EXPECT_FALSE(between(0, 1).contains(0));
  EXPECT_FALSE(between(0, 1).contains(1));
  EXPECT_TRUE(between(0, 1).contains(0.5));
  EXPECT_FALSE(above(2).contains(2));
  EXPECT_TRUE(at_least(2).contains(2));
  EXPECT_TRUE(at_most(2).contains(2));
  EXPECT_FALSE(at_most(2).contains(std::nextafter(2.0, 3.0)));
}

TEST(ARange, HasNoNumberThatIsNotFinite) {
  for (const double number :
       {static_cast<double>(NAN), static_cast<double>(INFINITY), -static_cast<double>(INFINITY)})
    EXPECT_FALSE(Range().contains(number)) << number;
  EXPECT_TRUE(Range().contains(-1e308));
}

TEST(ARange, IsToldByItsBounds) {
  EXPECT_EQ(bounds_text({}), "");
  EXPECT_EQ(bounds_text(above(0)), " > 0");
  EXPECT_EQ(bounds_text(at_least(0.5)), " >= 0.5");
  EXPECT_EQ(bounds_text(at_most(-1)), " <= -1");
  EXPECT_EQ(bounds_text(from_to(0, 1)), " from 0 to 1");
  EXPECT_EQ(bounds_text(between(-1, 0.5)), " between -1 and 0.5");
  EXPECT_EQ(bounds_text({0, 1, true, false}), " >= 0 and < 1");
  EXPECT_EQ(bounds_text({0, 1, false, true}), " > 0 and <= 1");
}

} // namespace
} // namespace rubato::study::range_test
