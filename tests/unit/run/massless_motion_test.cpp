// SPDX-License-Identifier: LGPL-3.0-or-later
// Velocities and accelerations of nodes without mass, as results have them.
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/massless_motion.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace rubato::run::massless_motion_test {
namespace {

constexpr double former_velocity = 2;

/// A block that slides with 2 along x on a rigid floor under g = 10, and stands after 0.4 of friction 0.5.
std::string deck_of(const std::string& cells, double step, const std::string& integration) {
  const bool solid = cells.starts_with("hexa") || cells.starts_with("tetra");
  const std::string body = solid ? "box: {from: [0, 0, 0], to: [1, 0.5, 0.5]}, divisions: [4, 2, 1]"
                                 : "rectangle: {from: [0, 0], to: [1, 0.5]}, divisions: [4, 2]";
  return fmt::format(R"(
mesh: {{generate: [{{name: block, {}, cells: {}, sides: {{bottom: under}}}}]}}
physics: {}
materials: {{steel: {{young: 1e7, poisson: 0.3, density: 1000, rayleigh: {{mass: 20}}}}}}
initial: [{{on: block, velocity: {{x: {}}}}}]
loads: [{{gravity: {{y: -10}}}}]
contact: {{floor: {{slave: under, friction: 0.5, integration: {}, obstacle: {{plane: {}}}}}}}
time: {{step: {}, end: 0.6}}
)",
                     body, cells, solid ? "solid" : "plane_strain", former_velocity, integration,
                     solid ? "{point: [0, 0, 0], normal: [0, 1, 0]}" : "{point: [0, 0], normal: [0, 1]}",
                     step);
}

struct Told {
  double fastest_stuck = 0;  ///< of a node, in the last tenth, where all points stick
  double fastest = 0;        ///< of a node without mass, at any instant
  double fastest_raw = 0;    ///< the same at the end of the step
  double momentum_error = 0; ///< of M v against what the step has
  int stuck = 0;
};

Told walk(const std::string& deck) {
  test::Walk walk(deck);
  const auto& model = walk.model.whole;
  Told found;
  walk.accepted = [&] {
    const auto told = step::with_massless_motion(model, walk.before, walk.state());
    const auto& now = walk.state();
    found.momentum_error = std::max(
        found.momentum_error,
        (model.products.mass(told.motion.v) - model.products.mass(now.motion.v)).lpNorm<Eigen::Infinity>());
    // By mortar what sticks is a mean over nodes.
    const bool all_stick = std::ranges::count(now.zones[0].status, contact::Status::stick) ==
                           static_cast<std::ptrdiff_t>(now.zones[0].status.size());
    for (std::size_t i = 0; i < model.zones[0].points.size(); ++i) {
      const int dof = model.dofs.dof(model.zones[0].points[i].nodes.front(), 0);
      found.fastest = std::max(found.fastest, std::abs(told.motion.v[dof]));
      found.fastest_raw = std::max(found.fastest_raw, std::abs(now.motion.v[dof]));
      if (now.t > 0.54 && all_stick) {
        ++found.stuck;
        found.fastest_stuck = std::max(found.fastest_stuck, std::abs(told.motion.v[dof]));
      }
    }
  };
  EXPECT_TRUE(walk.to_end());
  return found;
}

class Massless : public testing::TestWithParam<std::tuple<std::string, double, std::string>> {};

TEST_P(Massless, StandWhereTheyStick) {
  const auto& [cells, step, integration] = GetParam();
  const auto told = walk(deck_of(cells, step, integration));
  EXPECT_GT(told.stuck, 20);
  EXPECT_LE(told.fastest_stuck, 1e-6 * former_velocity);
  EXPECT_LE(told.momentum_error, 1e-10 * 500 * former_velocity);
  EXPECT_LE(told.fastest, 2 * former_velocity) << "at the end of a step it is " << told.fastest_raw;
}

INSTANTIATE_TEST_SUITE_P(Any, Massless,
                         testing::Combine(testing::Values("quad4", "quad8", "tria6", "hexa8"),
                                          testing::Values(4e-3, 5e-4), testing::Values("mortar", "nodes")));

} // namespace
} // namespace rubato::run::massless_motion_test
