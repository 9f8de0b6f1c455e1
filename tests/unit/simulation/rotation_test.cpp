// SPDX-License-Identifier: LGPL-3.0-or-later
/// Supports that rotate whole groups.
#include "rubato/constraint/reduction.hpp"
#include "rubato/results/probe_values.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <string>

namespace rubato::simulation::rotation_test {
namespace {

/// A beam from (0, 0) to (4, 1) of E = 1000, whose left end stands on the line of most rotations.
std::string beam(const std::string& supports, const std::string& time, const std::string& more = "") {
  return fmt::format(
      R"(mesh: {{generate: [{{name: beam, rectangle: {{from: [0, 0], to: [4, 1]}}, divisions: [8, 2], cells: quad8, sides: {{left: left, right: right}}}}]}}
physics: plane_stress
materials: {{any: {{young: 1000, poisson: 0.3, density: 1}}}}
functions: {{ramp: {{ramp: [0, 1]}}}}
supports: [{}]
newton: {{residual: 1e-12}}
time: {}
{})",
      supports, time, more);
}

const std::string at_rest = "{scheme: static, step: 0.5, end: 1}";
const std::string newmark = "{scheme: newmark, step: 0.01, end: 0.5}";

/// Of the probe `drive`, in the order of its columns.
std::vector<double> drive(const test::Walk& walk) {
  std::vector<double> row;
  results::add_probe_values(walk.model, walk.state(), row);
  return row;
}

/// Nothing else holds it: what small strain does not see of a rotation is of second order.
TEST(RotatingSupport, TakesAFreeBeamAlong) {
  test::Walk walk(
      beam("{on: left, rotate: {about: [0, 0.5], angle: {value: 1e-5, function: ramp}}}", at_rest));
  ASSERT_TRUE(walk.to_end());
  for (const auto node : walk.model.dofs.nodes) {
    const auto& x = walk.model.mesh.points[static_cast<std::size_t>(node)];
    EXPECT_NEAR(walk.displacement(node, 0), -1e-5 * (x[1] - 0.5), 1e-9);
    EXPECT_NEAR(walk.displacement(node, 1), 1e-5 * x[0], 1e-9);
  }
}

/// A beam that is held at its right end, bent by its left one: as by displacements that say the same.
TEST(RotatingSupport, IsTheDisplacementOfEachNode) {
  const std::string held = ", {on: right, fix: [x, y]}";
  test::Walk rotated(beam("{on: left, y: 1e-3, rotate: {about: [1, 0.5], angle: 0.04*t}}" + held, at_rest));
  test::Walk displaced(beam("{on: left, x: '-sin(0.04*t)*(y-0.5)+(cos(0.04*t)-1)*(x-1)', y: "
                            "'1e-3+sin(0.04*t)*(x-1)+(cos(0.04*t)-1)*(y-0.5)'}" +
                                held,
                            at_rest));
  ASSERT_TRUE(rotated.to_end() && displaced.to_end());
  const auto& u = displaced.state().motion.u;
  EXPECT_LE((rotated.state().motion.u - u).norm(), 1e-13 * u.norm());
  const auto& energy = rotated.simulation.energy();
  EXPECT_LE(std::abs(energy.balance()), 1e-12 * energy.largest());
}

/// The force 2 at the end of the lever 4 is held at the left end; all forces act on displaced nodes.
TEST(RotatingSupport, HasAReactionAndItsMoment) {
  const std::string more = R"(loads: [{surface_force: {on: right, y: 2}}]
probes: {drive: {on: left, field: reaction, about: [0, 0.5]}})";
  test::Walk still(beam("{on: left, rotate: {about: [0, 0.5], angle: 0}}", at_rest, more));
  ASSERT_TRUE(still.to_end());
  const auto held = drive(still);
  ASSERT_EQ(held.size(), 3U);
  EXPECT_NEAR(held[0], 0, 1e-9);
  EXPECT_NEAR(held[1], -2, 1e-9);
  EXPECT_NEAR(held[2], -8, 1e-9);
  EXPECT_EQ(results::probe_columns(still.model),
            (std::vector<std::string>{"drive.x", "drive.y", "drive.mz"}));

  test::Walk turned(
      beam("{on: left, rotate: {about: [0, 0.5], angle: {value: 0.05, function: ramp}}}", at_rest, more));
  ASSERT_TRUE(turned.to_end());
  double moment = 0;
  for (const auto node : turned.model.dofs.nodes) {
    const auto& x = turned.model.mesh.points[static_cast<std::size_t>(node)];
    if (x[0] != 0)
      continue;
    const double lever_x = -(x[1] - 0.5) * std::sin(0.05);
    const double lever_y = (x[1] - 0.5) * std::cos(0.05);
    const int dof = turned.model.dofs.dof(node, 0);
    const auto& reaction = turned.state().reaction;
    moment += lever_x * reaction[dof + 1] - lever_y * reaction[dof];
  }
  EXPECT_NEAR(drive(turned)[2], moment, 1e-11);
  EXPECT_GT(std::abs(drive(turned)[2] + 8), 1e-4) << "undeformed levers would give another one";
}

/// A spin by its velocity begins with ω × d and the centripetal acceleration.
TEST(RotatingSupport, BeginsWithTheRatesOfItsAngle) {
  test::Walk walk(
      beam("{on: left, rotate: {about: [0, -3], angle: {velocity: 0.1}}, x: {velocity: 2}}", newmark));
  const auto& motion = walk.state().motion;
  const int dof = walk.model.dofs.dof(walk.node_at(0, 1), 0);
  EXPECT_NEAR(motion.v[dof], 2 - 0.1 * 4, 1e-14);
  EXPECT_NEAR(motion.v[dof + 1], 0, 1e-14);
  EXPECT_NEAR(motion.a[dof], 0, 1e-12);
  EXPECT_NEAR(motion.a[dof + 1], -0.01 * 4, 1e-12);
  const Eigen::VectorXd left = walk.model.mass * motion.a + walk.state().bulk.internal;
  EXPECT_LE(walk.model.reduction.gather(left).lpNorm<Eigen::Infinity>(), 1e-12);
  ASSERT_TRUE(walk.to_end());
  EXPECT_NEAR(walk.displacement(walk.node_at(0, 1), 0), 2 * 0.5 - 4 * std::sin(0.05), 1e-14);
  EXPECT_NEAR(walk.displacement(walk.node_at(0, 1), 1), 4 * (std::cos(0.05) - 1), 1e-14);
  const auto& energy = walk.simulation.energy();
  EXPECT_LE(std::abs(energy.balance()), 1e-12 * energy.largest());
}

TEST(RotatingSupport, RotatesInExplicitRuns) {
  Simulation simulation(test::study_of(beam("{on: left, rotate: {about: [0, -3], angle: {velocity: 0.1}}}",
                                            "{scheme: central_difference, record: 0.05, end: 0.5}")));
  const test::ModelParts model(simulation.model());
  while (!simulation.finished())
    ASSERT_TRUE(simulation.advance().accepted());
  const auto& state = simulation.state();
  for (const auto node : model.dofs.nodes) {
    const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
    if (x[0] != 0)
      continue;
    EXPECT_NEAR(state.motion.u[model.dofs.dof(node, 0)], -std::sin(0.05) * (x[1] + 3), 1e-14);
    EXPECT_NEAR(state.motion.u[model.dofs.dof(node, 1)], (std::cos(0.05) - 1) * (x[1] + 3), 1e-14);
  }
  EXPECT_LE(std::abs(simulation.energy().balance()), 1e-12 * simulation.energy().largest());
}

/// Axes across those of the model, and a group that lets go.
TEST(RotatingSupport, RotatesInSpaceUntilItEnds) {
  const std::string deck =
      R"(mesh: {generate: [{name: box, box: {from: [0, 0, 0], to: [2, 1, 1]}, divisions: [2, 1, 1], cells: hexa8, sides: {left: left, right: right}}]}
physics: solid
materials: {any: {young: 1000, poisson: 0.3, density: 1}}
supports:
  - {on: left, rotate: {about: [0, 1, 0], axis: [1, 1, 0], angle: {velocity: 0.1}}, until: 0.25}
newton: {residual: 1e-12}
time: {scheme: newmark, step: 0.05, end: 0.5}
)";
  test::Walk walk(deck);
  const auto node = walk.node_at(0, 0, 1);
  while (walk.state().t < 0.25 - 1e-9)
    ASSERT_TRUE(walk.advance());
  const Eigen::Vector3d k = Eigen::Vector3d(1, 1, 0).normalized();
  const Eigen::Vector3d d(0, -1, 1);
  const Eigen::Vector3d expected = std::sin(0.025) * k.cross(d) + (1 - std::cos(0.025)) * k.cross(k.cross(d));
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(walk.displacement(node, i), expected[i], 1e-15);
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.state().reaction.norm(), 0);
  const auto& energy = walk.simulation.energy();
  EXPECT_LE(std::abs(energy.balance()), 1e-12 * energy.largest());
}

} // namespace
} // namespace rubato::simulation::rotation_test
