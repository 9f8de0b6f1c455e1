// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/bracketed_root.hpp"

#include <gtest/gtest.h>

namespace rubato::material::bracketed_root_test {
namespace {

TEST(BracketedRoot, FindsWhereNewtonsMethodAloneWouldNot) {
  int calls = 0;
  const auto steep = [&](double x) { // an infinite slope at 0
    ++calls;
    return ValueAndSlope{1e-3 - std::pow(x, 0.2), -0.2 * std::pow(x, -0.8)};
  };
  const auto root = bracketed_root(steep, 1, 1e-15);
  ASSERT_TRUE(root);
  EXPECT_NEAR(*root, 1e-15, 1e-26);
  EXPECT_LT(calls, 100);
}

TEST(BracketedRoot, WidensItsBracket) {
  const auto line = [](double x) { return ValueAndSlope{1e6 - x, -1}; };
  EXPECT_DOUBLE_EQ(bracketed_root(line, 1, 1e-6).value_or(0), 1e6);
}

TEST(BracketedRoot, StopsAtTheDoublesNextToAJump) {
  const auto jump = [](double x) { return ValueAndSlope{x < 0.3 ? 1.0 : -1.0, -1}; };
  EXPECT_NEAR(bracketed_root(jump, 1, 0).value_or(0), 0.3, 1e-16);
}

TEST(BracketedRoot, SaysThatThereIsNone) {
  EXPECT_FALSE(bracketed_root([](double) { return ValueAndSlope{1, -1}; }, 1, 1e-12));
  EXPECT_FALSE(bracketed_root([](double) { return ValueAndSlope{std::nan(""), -1}; }, 1, 1e-12));
}

} // namespace
} // namespace rubato::material::bracketed_root_test
