// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps in which a body without contact would fly farther than its size: contact is found nevertheless.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <cmath>
#include <string>
#include <tuple>

namespace rubato::run::long_steps_test {
namespace {

/// A block that a slowly growing force presses on another one and pushes along it; sound crosses both within
/// 0.0004.
std::string pressed(const std::string& time, const std::string& integration, const std::string& cells) {
  return fmt::format(R"(
mesh: {{generate: [{{name: low, rectangle: {{from: [0, 0], to: [4, 2]}}, divisions: [5, 3], cells: {2}, sides: {{bottom: ground, top: over}}}},
 {{name: top, rectangle: {{from: [0, 2], to: [4, 4]}}, divisions: [3, 2], cells: {2}, sides: {{bottom: sole, top: roof}}}}]}}
physics: plane_strain
materials: {{steel: {{young: 1, poisson: 0.3, density: 1e-8}}}}
functions: {{press: {{expression: "(3-2*t)*t^2"}}}}
supports: [{{on: ground, fix: [x, y]}}]
loads: [{{surface_force: {{on: roof, y: -5e-4, x: 2e-5, function: press}}}}]
contact: {{joint: {{slave: sole, master: over, friction: 0.3, integration: {1}}}}}
time: {{{0}, end: 1}}
)",
                     time, integration, cells);
}

double depth_of_roof(const std::string& deck) {
  test::Walk walk(deck);
  EXPECT_TRUE(walk.to_end());
  return walk.displacement(walk.node_at(4, 4), 1);
}

using Row = std::tuple<const char*, double, const char*, const char*>;

class LongSteps : public testing::TestWithParam<Row> {};

TEST_P(LongSteps, FindContactAsStaticOnesDo) {
  const auto& [scheme, step, integration, cells] = GetParam();
  const double at_rest = depth_of_roof(pressed("scheme: static, step: 0.1", integration, cells));
  const double moving =
      depth_of_roof(pressed(fmt::format("scheme: {}, step: {:g}", scheme, step), integration, cells));
  EXPECT_NEAR(moving, at_rest, 1e-5 * std::abs(at_rest));
}

INSTANTIATE_TEST_SUITE_P(Schemes, LongSteps,
                         testing::Combine(testing::Values("hht, alpha: -0.1", "newmark", "generalized_alpha",
                                                          "moreau_jean"),
                                          testing::Values(0.05, 0.1, 0.2), testing::Values("mortar", "nodes"),
                                          testing::Values("quad4", "quad8", "tria3")));

} // namespace
} // namespace rubato::run::long_steps_test
