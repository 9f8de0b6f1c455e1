// SPDX-License-Identifier: LGPL-3.0-or-later
// A few of the studies of which `make verify` compares hundreds, each in several ways.
#include <gtest/gtest.h>

#include "verification/second_way.hpp"
#include <algorithm>

namespace rubato::verification::second_way_test {
namespace {

constexpr std::uint32_t seed = 2900;

WayResult result_with(double force, double moment) {
  WayResult result;
  result.kinds = {{"force", 10, {{"zone_joint.x", {0, 0, force, 0}}}},
                  {"moment", 4, {{"zone_joint.mz", {moment, 0, 0, 0}}}}};
  return result;
}

TEST(StudiesInWays, AreTheSameEachTime) {
  const auto first = way_studies(seed, 3, 2);
  const auto second = way_studies(seed, 4, 1);
  EXPECT_EQ(first[1].deck, second[0].deck);
  EXPECT_NE(first[0].deck, first[1].deck);
}

TEST(DifferenceOfWays, IsMeasuredByTheScaleOfItsKind) {
  const auto difference = largest_difference(result_with(1, 2), result_with(2, 3));
  EXPECT_DOUBLE_EQ(difference.size, 0.25);
  EXPECT_EQ(difference.quantity, "zone_joint.mz (1)");
  EXPECT_EQ(largest_difference(result_with(1, 2), result_with(1, 2)).size, 0);
}

TEST(DifferenceOfWays, IsExplainedWhereRefinementHalvesIt) {
  Comparison comparison;
  comparison.coarse.size = 0.1;
  comparison.fine = 0.05;
  EXPECT_TRUE(comparison.large());
  EXPECT_TRUE(comparison.explained());
  comparison.fine = 0.09;
  EXPECT_FALSE(comparison.explained());
  comparison.finest = 0.05;
  EXPECT_FALSE(comparison.explained()) << "an error of first order has 0.49 or less after two halvings";
  comparison.finest = 0.048;
  EXPECT_TRUE(comparison.explained());
  comparison.fine = comparison.finest = -1;
  EXPECT_FALSE(comparison.explained());
}

double last_quarter(const WayResult& result, const std::string& name) {
  for (const auto& kind : result.kinds)
    for (const auto& quantity : kind.quantities)
      if (quantity.name == name)
        return quantity.mean.back();
  ADD_FAILURE() << "no " << name;
  return 0;
}

/// A crowned block between a rail and a plate, which nothing but contact holds, is pressed as hard by the
/// whole system.
TEST(WholeSystem, KeepsARollerInItsPlace) {
  const auto study = way_studies(seed, 4, 1).front();
  ASSERT_EQ(study.family, "rollers");
  const auto whole = run_way(study, {"full", {{"solver", "full"}}, false}, 1);
  const auto condensed = run_way(study, {"deck", {}, false}, 1);
  ASSERT_EQ(whole.failure, "");
  for (const auto* force : {"zone_above.y", "zone_below.y"})
    EXPECT_NEAR(last_quarter(whole, force) / last_quarter(condensed, force), 1, 1e-3) << force;
}

class StudyInWays : public testing::TestWithParam<int> {};

/// The whole system and the condensed one solve the same equations; other ways agree to 2 % or approach each
/// other as edges and steps are halved.
TEST_P(StudyInWays, HasOneAnswer) {
  const auto study = way_studies(seed, GetParam(), 1).front();
  const auto comparison = compare_ways(study);
  EXPECT_GE(comparison.ways.size(), 5U);
  for (const auto& way : comparison.ways) {
    SCOPED_TRACE(study.family + ", " + study.words + ": " + way.way + ", " + way.coarse.quantity);
    EXPECT_EQ(way.failure, "");
    EXPECT_LE(way.coarse.size, way.way == "full" ? 1e-5 : 0.05);
    EXPECT_TRUE(!way.large() || way.explained());
  }
}

INSTANTIATE_TEST_SUITE_P(Chosen, StudyInWays, testing::Values(0, 10));

} // namespace
} // namespace rubato::verification::second_way_test
