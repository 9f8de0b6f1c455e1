// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/reach.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace rubato::step::reach_test {
namespace {

using Eigen::VectorXd;

VectorXd move(double x) {
  return VectorXd::Constant(1, x);
}

TEST(Reach, TakesShortMovesWholeAndLongOnesInPart) {
  Reach reach(2);
  EXPECT_EQ(reach.part_of(move(2)), 1);
  EXPECT_EQ(reach.part_of(move(8)), 0.25);
  EXPECT_EQ(reach.part_of(move(8), 2), 0.5);
}

TEST(Reach, HalvesWhereMovesTurnBackAndGrowsAgainOtherwise) {
  Reach reach(2);
  EXPECT_EQ(reach.part_of(move(4)), 0.5);
  EXPECT_EQ(reach.part_of(move(-4)), 0.25);
  EXPECT_EQ(reach.part_of(move(4)), 0.125);
  EXPECT_EQ(reach.part_of(move(4)), 0.25);
  EXPECT_EQ(reach.part_of(move(4)), 0.5);
  EXPECT_EQ(reach.part_of(move(4)), 0.5);
}

TEST(Reach, WithoutEndTakesEveryMove) {
  Reach reach(std::numeric_limits<double>::infinity());
  EXPECT_EQ(reach.part_of(move(1e300)), 1);
  EXPECT_EQ(reach.part_of(move(-1e300)), 1);
}

} // namespace
} // namespace rubato::step::reach_test
