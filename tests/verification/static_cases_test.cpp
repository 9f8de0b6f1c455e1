// SPDX-License-Identifier: LGPL-3.0-or-later
/// V4 to V7 and V9: Hertz, Cattaneo and Mindlin, blocks that slide and stick, and the order of convergence.
#include <gtest/gtest.h>

#include "verification/hertz.hpp"
#include "verification/signorini.hpp"
#include "verification/sliding.hpp"
#include <array>
#include <cmath>

namespace rubato::verification::static_cases_test {
namespace {

constexpr double closed = 1e-10;

TEST(CylinderOnBlock, TouchesAndPressesAsHertzSays) {
  CaseRuns runs("v4_hertz_cylinder/cylinder.yaml");
  const auto theory = v4_theory();
  EXPECT_NEAR(theory.half_width, 6.215, 1e-3);
  EXPECT_NEAR(theory.peak, 3585.4, 0.1);
  const auto points = surface_at_end(runs["run"]);
  const auto found = fitted_ellipse(points);
  EXPECT_NEAR(found.half_width, theory.half_width, 0.03 * theory.half_width);
  EXPECT_NEAR(found.peak, theory.peak, 0.03 * theory.peak);
  EXPECT_NEAR(largest_pressure(points), theory.peak, 0.03 * theory.peak);
  EXPECT_LE(runs["run"].ledger(), closed);
}

TEST(CylinderPushedSideways, SticksWhereCattaneoAndMindlinSay) {
  CaseRuns runs("v5_cattaneo_mindlin/cylinder.yaml");
  const auto theory = mindlin_theory(runs["pushed"]);
  EXPECT_NEAR(theory.mobilised, 0.5, 0.005);
  const auto points = surface_at_end(runs["pushed"]);
  EXPECT_NEAR(stick_half_width(points), theory.stick, v5_cell);
  EXPECT_LE(traction_error(points, theory), 0.05);
  EXPECT_LE(runs["pressed"].ledger(), closed);
  EXPECT_LE(runs["pushed"].ledger(), closed);
}

class BlockOnIncline : public testing::TestWithParam<const char*> {
protected:
  CaseRuns runs_{"v6_block_on_incline/block.yaml"};
  std::string size_ = GetParam();
};

TEST_P(BlockOnIncline, SlidesAsFrictionLetsIt) {
  const auto& run = runs_["slides_" + size_];
  const double theory = incline_acceleration(0.3);
  EXPECT_NEAR(measured_acceleration(run), theory, 1e-6 * theory);
  EXPECT_LE(run.ledger(), closed);
}

TEST_P(BlockOnIncline, SticksWhenFrictionIsEnough) {
  const auto& run = runs_["sticks_" + size_];
  const double freely = incline_acceleration(0) * run.study.time.end;
  EXPECT_LE(std::abs(column(run.probes, "speed.x").back()), 1e-6 * freely);
  EXPECT_LE(run.ledger(), closed);
}

INSTANTIATE_TEST_SUITE_P(OfSize, BlockOnIncline, testing::Values("1mm", "1m", "1km"),
                         [](const auto& chosen) { return std::string(chosen.param); });

TEST(FrictionSlider, TurnsAndStopsWhereItMust) {
  CaseRuns runs("v7_friction_slider/slider.yaml");
  const auto theory = slider_theory();
  const auto found = measured_slider(runs["run"]);
  ASSERT_EQ(theory.turning_points.size(), 4u);
  ASSERT_EQ(found.turning_points.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_NEAR(found.turning_points[i], theory.turning_points[i], 0.01 * std::abs(theory.turning_points[i]));
  EXPECT_NEAR(theory.stop, 0.12566, 1e-5);
  EXPECT_NEAR(found.stop, theory.stop, 0.01 * theory.stop);
  EXPECT_LE(runs["run"].ledger(), closed);
}

TEST(BlockOnCylinder, ConvergesAtTheOrderOfItsCells) {
  constexpr std::array divisions{4, 8, 16};
  const auto order = [&](CellType cells) {
    const auto errors = signorini_errors(cells, divisions, 64);
    return std::log2(errors[0] / errors[2]) / 2;
  };
  EXPECT_GT(order(CellType::quad4), 0.9);
  EXPECT_GT(order(CellType::quad9), 1.35);
}

} // namespace
} // namespace rubato::verification::static_cases_test
