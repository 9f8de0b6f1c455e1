// SPDX-License-Identifier: LGPL-3.0-or-later
/// Pressures that follow their faces, in steps.

#include "rubato/domain/bulk.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace rubato::simulation::follower_test {
namespace {

using std::numbers::pi;

/// A beam of large turns from (0, 0) to (4, 1) that is held at its left end and pressed from above.
std::string beam(const std::string& angle, const std::string& time) {
  return fmt::format(
      R"(mesh: {{generate: [{{name: beam, rectangle: {{from: [0, 0], to: [4, 1]}}, divisions: [4, 1], cells: quad8, sides: {{left: left, top: top}}}}]}}
physics: plane_strain
materials: {{any: {{young: 1000, poisson: 0.3, density: 1, strain: green_lagrange}}}}
functions: {{ramp: {{ramp: [0, 0.25]}}}}
supports: [{{on: left, rotate: {{about: [0, 0.5], angle: {}}}}}]
loads: [{{pressure: {{on: top, value: 2, function: ramp, follower: true}}}}]
newton: {{residual: 1e-11}}
time: {}
)",
      angle, time);
}

/// What a beam that is pressed and rotated comes to is what one that is pressed comes to, rotated.
TEST(FollowerPressure, RotatesWithItsSupport) {
  const std::string time = "{scheme: static, step: 0.0625, end: 1}";
  test::Walk still(beam("0", time));
  test::Walk rotated(beam("'pi/2*t'", time));
  ASSERT_TRUE(still.to_end() && rotated.to_end());
  double largest = 0;
  for (const auto node : still.model.dofs.nodes) {
    const auto& x = still.model.mesh.points[static_cast<std::size_t>(node)];
    const double there_x = x[0] + still.displacement(node, 0);
    const double there_y = x[1] + still.displacement(node, 1);
    EXPECT_NEAR(x[0] + rotated.displacement(node, 0), -(there_y - 0.5), 1e-8); // by 90° about (0, 0.5)
    EXPECT_NEAR(x[1] + rotated.displacement(node, 1), 0.5 + there_x, 1e-8);
    largest = std::max(largest, std::abs(still.displacement(node, 1)));
  }
  EXPECT_GT(largest, 0.3) << "it must bend";
  const auto& energy = rotated.simulation.energy();
  EXPECT_LE(std::abs(energy.balance()), 1e-9 * energy.largest());
}

/// A block under 30 all round loses 30 times the volume that it loses, whatever the scheme.
std::string block(const std::string& time) {
  return R"(mesh: {generate: [{name: block, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [4, 2], cells: quad4, sides: {left: left, right: right, top: top, bottom: bottom}}]}
physics: plane_strain
thickness: 0.5
materials: {any: {young: 1000, poisson: 0.3, density: 1, strain: green_lagrange}}
functions: {push: {ramp: [0, 0.02]}}
supports: [{on: left, fix: x}, {on: bottom, fix: y}]
loads:
  - {pressure: {on: right, value: 30, function: push, follower: true}}
  - {pressure: {on: top, value: 30, function: push, follower: true}}
newton: {residual: 1e-12}
time: )" +
         time + "\n";
}

/// Of the deformed cells.
double volume(const test::ModelParts& model, const Eigen::VectorXd& u) {
  double sum = 0;
  for (const auto cell : model.bulk.cells) {
    const auto nodes = model.mesh.nodes_of(cell);
    const auto place = [&](std::size_t i) -> Eigen::Vector2d {
      const auto node = nodes[i % nodes.size()];
      return model.mesh.points[static_cast<std::size_t>(node)].head<2>() +
             u.segment<2>(model.dofs.dof(node, 0));
    };
    for (std::size_t i = 0; i < nodes.size(); ++i)
      sum += 0.5 * 0.5 * (place(i).x() * place(i + 1).y() - place(i).y() * place(i + 1).x());
  }
  return sum;
}

TEST(FollowerPressure, DoesTheWorkOfTheVolumeThatIsLost) {
  for (const std::string time :
       {"{scheme: newmark, step: 1e-3, end: 0.2}", "{scheme: central_difference, record: 1e-3, end: 0.2}"}) {
    Simulation simulation(test::study_of(block(time)));
    const test::ModelParts model(simulation.model());
    double work = 0;
    double last = volume(model, simulation.state().motion.u);
    while (!simulation.finished()) {
      const double t = simulation.state().t;
      ASSERT_TRUE(simulation.advance().accepted()) << time;
      const double now = volume(model, simulation.state().motion.u);
      const double mean = (std::min(t, 0.02) + std::min(simulation.state().t, 0.02)) / 2;
      work += 30 * mean / 0.02 * (last - now);
      last = now;
    }
    const auto& energy = simulation.energy();
    EXPECT_GT(energy.external_work, 0.1) << time;
    EXPECT_NEAR(energy.external_work, work, 1e-3 * work) << time;
    EXPECT_LE(std::abs(energy.balance()), 1e-11 * energy.largest()) << time;
  }
}

} // namespace
} // namespace rubato::simulation::follower_test
