// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/johnson_cook.hpp"

#include <gtest/gtest.h>

#include "support/point_path.hpp"

namespace rubato::material::johnson_cook_test {
namespace {

using test::PointPath;

// 4340 steel of Johnson and Cook, in MPa and s.
const JohnsonCook steel{792, 510, 0.26, 0.014, 1, 1};
constexpr double young = 200e3;

Plastic plastic(const JohnsonCook& kind) {
  return {young, 0.29, kind, {}};
}

TEST(JohnsonCook, IsItsFormula) {
  const double expected = (792 + 510 * std::pow(0.05, 0.26)) * (1 + 0.014 * std::log(500));
  EXPECT_NEAR(yield(steel, 0.04, 0.01, {2e-5}).stress, expected, 1e-12 * expected);
  auto warm = steel;
  warm.softening = johnson_cook_softening(600, 300, 1800, 1.03);
  EXPECT_NEAR(yield(warm, 0.04, 0.01, {2e-5}).stress, expected * (1 - std::pow(0.2, 1.03)), 1e-12 * expected);
}

TEST(JohnsonCook, HasNoRateBelowItsReferenceAndInStepsOfNoLength) {
  const double still = 792 + 510 * std::pow(0.05, 0.26);
  EXPECT_DOUBLE_EQ(yield(steel, 0.04, 0.01, {1}).stress, still);
  EXPECT_DOUBLE_EQ(yield(steel, 0.04, 0.01, {0}).stress, still);
}

TEST(JohnsonCook, SoftensBetweenTheRoomAndMelting) {
  EXPECT_EQ(johnson_cook_softening(200, 300, 1800, 1.03), 1);
  EXPECT_EQ(johnson_cook_softening(1900, 300, 1800, 1.03), 0);
}

TEST(JohnsonCook, SlopesAreThoseOfDifferences) {
  for (const double growth : {1e-6, 1e-4, 1e-2}) {
    const StepInfo step{1e-7};
    const double width = 1e-4 * growth;
    const double slope = (yield(steel, 0.003, growth + width, step).stress -
                          yield(steel, 0.003, growth - width, step).stress) /
                         (2 * width);
    EXPECT_NEAR(yield(steel, 0.003, growth, step).slope, slope, 1e-6 * slope);
  }
}

/// A bar whose plastic strain grows at 1000 a second, pulled to 5 %.
TEST(JohnsonCook, ABarHasTheYieldStressOfItsRate) {
  PointPath path(plastic(steel));
  constexpr int steps = 50;
  for (int i = 1; i <= steps; ++i)
    ASSERT_TRUE(path.pull(0.05 * i / steps, 1e-6));
  const double stress = path.response().stress[0];
  const double plastic_strain = 0.05 - stress / young;
  EXPECT_NEAR(path.p(), plastic_strain, 1e-14);
  const double rate = (path.p() - 0) / 1e-6; // of the last step below
  ASSERT_GT(rate, 0);
  const auto before = path.p();
  ASSERT_TRUE(path.pull(0.051, 1e-6));
  const double speed = (path.p() - before) / 1e-6;
  const double expected = (792 + 510 * std::pow(path.p(), 0.26)) * (1 + 0.014 * std::log(speed));
  EXPECT_NEAR(path.response().stress[0], expected, 1e-11 * expected);
}

/// The slope is infinite at p = 0, and the rate counts from one growth on.
TEST(JohnsonCook, TheFirstGrowthIsFoundHoweverSmall) {
  for (const double over : {1e-11, 1e-8, 1e-4, 1e-2, 1.0, 100.0}) {
    PointPath path(plastic(steel));
    ASSERT_TRUE(path.pull(792 / young * (1 + over), 1e-5)) << over;
    const double reached = path.response().stress[0];
    const double growth = std::max(1.0, path.p() / 1e-5);
    const double expected = (792 + 510 * std::pow(path.p(), 0.26)) * (1 + 0.014 * std::log(growth));
    EXPECT_NEAR(reached, expected, 1e-11 * expected) << over;
  }
}

TEST(JohnsonCook, AStepOfNoLengthKeepsTheStress) {
  PointPath path(plastic(steel));
  ASSERT_TRUE(path.pull(0.05, 1e-6));
  const auto stress = path.response().stress;
  const double p = path.p();
  ASSERT_GT(stress[0], 1.1 * (792 + 510 * std::pow(p, 0.26))) << "the rate counts";
  ASSERT_TRUE(path.to_strain(path.strain(), 0));
  EXPECT_LT((path.response().stress - stress).norm(), 1e-12 * stress.norm());
  EXPECT_EQ(path.p(), p);
}

TEST(JohnsonCook, RandomStepsStayFinite) {
  std::mt19937 engine(4);
  PointPath path(plastic(steel));
  for (int i = 0; i < 20'000; ++i)
    ASSERT_TRUE(path.to_strain(test::random_six(engine, i % 2 == 0 ? 1e-3 : 3e-2), 1e-5));
  EXPECT_TRUE(std::isfinite(path.work));
}

} // namespace
} // namespace rubato::material::johnson_cook_test
