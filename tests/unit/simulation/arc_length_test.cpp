// SPDX-License-Identifier: LGPL-3.0-or-later
/// Loads along a path of equilibrium: past limit loads, with and without contact.
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/step/energy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::simulation::arc_length_test {
namespace {

constexpr double rise = 0.12;
constexpr double force = 100; ///< per area of the crown, of which the half arch has 0.02

/// Half of a clamped shallow arch: a strip that is bent to a parabola.
test::BuiltModel arch(const std::string& rest) {
  const auto study = deck::parse_deck(R"(mesh:
  generate:
    - {name: arch, rectangle: {from: [-1, -0.01], to: [0, 0.01]}, divisions: [12, 1], cells: quad8,
       sides: {left: clamp, right: crown, bottom: under, top: roof}}
physics: plane_strain
materials: {a: {young: 1e6, poisson: 0, strain: green_lagrange}}
)" + rest,
                                      "deck.yaml")
                         .runs.front();
  auto mesh = model::load_mesh(study.mesh);
  for (auto& point : mesh.points)
    point[1] += rise * (1 - point[0] * point[0]);
  return test::BuiltModel(study, std::move(mesh));
}

const std::string pushed = R"(supports: [{on: clamp, fix: [x, y]}, {on: crown, fix: x}]
loads: [{surface_force: {on: crown, y: -100}}]
newton: {residual: 1e-10}
time: {scheme: static, step: 0.025, end: 1, arc_length: {length: 0.17, on: crown}}
)";

double sum_of_reactions(const test::Walk& walk) {
  double sum = 0;
  for (const auto node : walk.model.dofs.nodes)
    if (std::abs(walk.model.mesh.points[static_cast<std::size_t>(node)][0]) < 1e-12)
      sum += walk.state().reaction[walk.model.dofs.dof(node, 1)];
  return sum;
}

struct Place {
  double deflection = 0;
  double load = 0; ///< of the crown, downwards
};

std::vector<Place> snap() {
  test::Walk walk(arch(pushed));
  const auto crown = walk.node_at(0, rise - 0.01);
  std::vector<Place> path;
  step::EnergyRecord record;
  walk.accepted = [&] {
    path.push_back({-walk.displacement(crown, 1), walk.state().load_factor * force * 0.02});
    record.note(walk.state().t, walk.simulation.energy());
  };
  EXPECT_TRUE(walk.to_end());
  EXPECT_LE(record.largest_balance, 1e-10 * record.largest);
  return path;
}

TEST(ArcLength, FollowsAnArchThatSnapsThrough) {
  const auto path = snap();
  ASSERT_GE(path.size(), 40U);
  const auto by_load = [](const Place& a, const Place& b) { return a.load < b.load; };
  const auto limit = std::ranges::max_element(path, by_load);
  EXPECT_GT(limit->load, 0);
  EXPECT_LT(limit->deflection, rise);
  const auto lowest = std::min_element(limit, path.end(), by_load);
  EXPECT_LT(lowest->load, 0.5 * limit->load) << "it falls when the arch has passed its limit";
  EXPECT_GT(path.back().load, lowest->load) << "and rises when it hangs";
  for (std::size_t i = 1; i < path.size(); ++i)
    EXPECT_NEAR(path[i].deflection - path[i - 1].deflection, 0.17 / 40, 2e-3 * 0.17 / 40)
        << "the crown moves as it is asked to";
}

/// A support that moves the crown down finds the same equilibria.
TEST(ArcLength, IsThePathOfAMovingSupport) {
  const auto path = snap();
  for (const std::size_t i : {5U, 15U, 25U, 39U}) {
    test::Walk walk(arch(fmt::format(
        "supports: [{{on: clamp, fix: [x, y]}}, {{on: crown, fix: x, y: {{value: {:.17g}, function: r}}}}]\n"
        "functions: {{r: {{times: [0, 1], values: [0, 1]}}}}\nnewton: {{residual: 1e-10}}\n"
        "time: {{scheme: static, step: 0.05, end: 1}}\n",
        -path.at(i).deflection)));
    ASSERT_TRUE(walk.to_end());
    EXPECT_NEAR(-sum_of_reactions(walk), path[i].load, 2e-3 * std::abs(path[i].load) + 1e-4 * force * 0.02)
        << path[i].deflection;
  }
}

/// A sphere of neo-Hookean rubber, μ = 1, that does not change its volume, 1 ≤ R ≤ 1.5, under inner pressure:
/// p = ½ [λ⁻⁴ + 4 λ⁻¹] from a to b μ (A. N. Gent, Engineering with Rubber; R. W. Ogden, Non-Linear Elastic
/// Deformations, 5.3), λ_b³ = 1 + (λ_a³ − 1)/1.5³. It has a largest pressure.
TEST(ArcLength, InflatesABalloonPastItsLargestPressure) {
  const auto study = deck::parse_deck(R"(mesh:
  generate:
    - {name: wall, rectangle: {from: [1, 0], to: [1.5, 1]}, divisions: [4, 8], cells: quad8,
       sides: {left: inner, bottom: equator, top: axis}}
physics: axisymmetric
materials: {rubber: {law: hyperelastic, c10: 0.5, bulk: 2000}}
supports: [{on: equator, fix: y}, {on: axis, fix: x}]
loads: [{pressure: {on: inner, value: 1, follower: true}}]
time: {scheme: static, step: 0.05, end: 1, arc_length: {length: 1.2, on: inner}}
)",
                                      "deck.yaml")
                         .runs.front();
  auto mesh = model::load_mesh(study.mesh);
  for (auto& point : mesh.points) {
    const double angle = point[1] * std::numbers::pi / 2;
    const double radius = point[0];
    point[0] = angle == std::numbers::pi / 2 ? 0 : radius * std::cos(angle);
    point[1] = radius * std::sin(angle);
  }
  test::Walk walk(study, std::move(mesh));
  double largest = 0;
  walk.accepted = [&] {
    const double stretch = 1 + walk.displacement(walk.node_at(1, 0), 0);
    const double outer = std::cbrt(1 + (std::pow(stretch, 3) - 1) / std::pow(1.5, 3));
    const auto term = [](double s) { return 2 / s + 0.5 / std::pow(s, 4); };
    const double pressure = term(outer) - term(stretch);
    EXPECT_NEAR(walk.state().load_factor, pressure, 5e-3 * pressure + 1e-3) << stretch;
    largest = std::max(largest, walk.state().load_factor);
  };
  ASSERT_TRUE(walk.to_end());
  EXPECT_GT(walk.displacement(walk.node_at(1, 0), 0), 1);
  EXPECT_LT(walk.state().load_factor, 0.97 * largest);
}

/// The crown comes to lie on a roller, what is beside it goes on.
TEST(ArcLength, TakesContactAlong) {
  test::Walk walk(arch(R"(supports: [{on: clamp, fix: [x, y]}, {on: crown, fix: x}]
loads: [{surface_force: {on: roof, y: -1}}]
contact: {c: {slave: under, obstacle: {cylinder: {point: [0, -0.22], radius: 0.3}}, integration: nodes}}
time: {scheme: static, step: 0.1, end: 1, arc_length: {length: 0.03, on: roof}}
)"));
  ASSERT_TRUE(walk.to_end());
  EXPECT_NEAR(walk.displacement(walk.node_at(0, rise - 0.01), 1), -0.03, 1e-9);
  EXPECT_GT(walk.resultants().normal, 0);
}

} // namespace
} // namespace rubato::simulation::arc_length_test
