// SPDX-License-Identifier: LGPL-3.0-or-later
/// Springs and dashpots by tables: straight ones against linear ones, stops and bumpers against closed forms.
#include "rubato/deck/read.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <string>

namespace rubato::simulation::law_springs_test {
namespace {

using Eigen::VectorXd;

/// A plate on a connector, pulled.
std::string plate(const std::string& connector, const std::string& time, const std::string& more = "") {
  return fmt::format(
      R"(mesh: {{generate: [{{name: plate, rectangle: {{from: [0, 0], to: [2, 1]}}, divisions: [4, 2], cells: quad8, sides: {{left: left, right: right, bottom: bottom}}, points: {{right_top: tip}}}}]}}
physics: plane_stress
materials: {{any: {{young: 1e5, poisson: 0.3, density: 1}}}}
functions: {{wave: {{sine: {{frequency: 40, amplitude: 1, mean: 0}}}}, rise: {{ramp: {{begin: 0, end: 1}}}}}}
supports: [{{on: bottom, fix: y}}]
connectors: [{}]
loads: [{{surface_force: {{on: right, x: 100, function: {}}}}}]
newton: {{residual: 1e-11}}
time: {}
{})",
      connector, time.find("static") != std::string::npos ? "rise" : "wave", time, more);
}

const std::string dynamic = "{scheme: hht, alpha: -0.1, step: 5e-4, end: 0.05}";
const std::string stepwise = "{scheme: static, step: 0.1, end: 1}";

/// A straight table is a linear spring; so is a straight dashpot.
TEST(LawSprings, AreLinearOnesWhereTablesAreStraight) {
  for (const auto& time : {dynamic, stepwise, std::string("{scheme: moreau_jean, step: 5e-4, end: 0.05}")}) {
    const auto linear = "{on: left, along: [1, 0], stiffness: 500, damping: 3}";
    const auto table =
        "{on: left, along: [1, 0], force: {elongations: [-1, 0, 2], forces: [-500, 0, 1000]}, damper: "
        "{rates: [-1, 1], forces: [-3, 3]}}";
    test::Walk a(plate(linear, time));
    test::Walk b(plate(table, time));
    ASSERT_TRUE(a.to_end());
    ASSERT_TRUE(b.to_end());
    const auto& u = a.state().motion.u;
    EXPECT_LE((u - b.state().motion.u).lpNorm<Eigen::Infinity>(), 1e-10 * u.lpNorm<Eigen::Infinity>())
        << time;
    EXPECT_NEAR(a.simulation.energy().strain, b.simulation.energy().strain,
                1e-9 * a.simulation.energy().largest())
        << time;
  }
}

/// One spring at one node: its force balances the load, and the table gives the elongation.
double shift_of(const std::string& law) {
  test::Walk walk(fmt::format(
      R"(mesh: {{generate: [{{name: bar, rectangle: {{from: [0, 0], to: [2, 1]}}, divisions: [1, 1], sides: {{left: left, right: right, bottom: bottom}}}}]}}
physics: plane_stress
materials: {{any: {{young: 1e4, poisson: 0}}}}
functions: {{rise: {{ramp: {{begin: 0, end: 1}}}}}}
supports: [{{on: bottom, fix: y}}]
relations: {{hub: {{rigid: {{on: bar}}}}}}
connectors: [{{on: hub, along: [1, 0], force: {}}}, {{on: hub, along: [1, 0], stiffness: 1}}]
loads: [{{nodal_force: {{on: hub, x: 100, function: rise}}}}]
newton: {{residual: 1e-12}}
time: {{scheme: static, step: 0.25, end: 1}}
)",
      law));
  EXPECT_TRUE(walk.to_end()) << law;
  const auto energy = walk.simulation.energy();
  EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest()) << law;
  return walk.displacement(walk.node_at(2, 1), 0);
}

TEST(LawSprings, GiveTheElongationOfTheirTable) {
  // A stop after a play of 0.5: beside it a spring of 1.
  EXPECT_NEAR(shift_of("{elongations: [0, 0.5, 1], forces: [0, 0, 1e6]}"), 0.5 + (100 - 0.5) / (2e6 + 1),
              1e-9);
  // Progressive, and saturated.
  EXPECT_NEAR(shift_of("{elongations: [-1, 0, 1, 2], forces: [-10, 0, 10, 90]}"), 1 + 89. / 81, 1e-9);
  EXPECT_NEAR(shift_of("{elongations: [-1, 0, 1], forces: [-60, 0, 60], outside: constant}"), 40, 1e-8);
  // Prestressed: pulls with 50 at rest.
  EXPECT_NEAR(shift_of("{elongations: [-1, 1], forces: [30, 70]}"), 50. / 21, 1e-9);
}

TEST(LawSprings, AreLinearOnesInExplicitSteps) {
  const std::string time = "{scheme: central_difference, step: 1e-5, end: 0.02}";
  const auto end_of = [&](const std::string& connector) {
    Simulation simulation(deck::parse_deck(plate(connector, time), "deck.yaml").runs.front());
    while (!simulation.finished())
      EXPECT_TRUE(simulation.advance().accepted());
    const auto energy = simulation.energy();
    EXPECT_NEAR(energy.balance(), 0, 1e-9 * energy.largest()) << connector;
    return simulation.state().motion.u;
  };
  const auto linear = end_of("{on: left, along: [1, 0], stiffness: 500, damping: 3}");
  const auto table =
      end_of("{on: left, along: [1, 0], force: {elongations: [-1, 0, 2], forces: [-500, 0, 1000]}, "
             "damper: {rates: [-1, 1], forces: [-3, 3]}}");
  EXPECT_LE((linear - table).lpNorm<Eigen::Infinity>(), 1e-10 * linear.lpNorm<Eigen::Infinity>());
  end_of("{on: left, along: [1, 0], force: {elongations: [0, 1e-3, 2e-3], forces: [0, 0, 5]}}");
}

struct Course {
  std::string name;
  std::string time;
};

class Bumper : public testing::TestWithParam<Course> {};

/// A stop with play and a degressive dashpot, dragged on a table with friction.
std::string block(const std::string& time, const std::string& solver) {
  return fmt::format(R"(mesh:
  generate:
    - {{name: low, rectangle: {{from: [0, -1], to: [4, 0]}}, divisions: [7, 2], sides: {{bottom: ground, top: table}}}}
    - {{name: up, rectangle: {{from: [1, 0], to: [3, 1]}}, divisions: [5, 3], sides: {{bottom: sole, top: roof, right: face}}}}
physics: plane_strain
materials: {{any: {{young: 2e5, poisson: 0.3, density: 7.8e-3}}}}
functions: {{push: {{times: [0, 1e-3, 4e-3], values: [0, 1, 1]}}}}
supports: [{{on: ground, fix: [x, y]}}]
loads: [{{surface_force: {{on: roof, x: 60, y: -100, function: push}}}}]
connectors:
  - {{on: face, along: [1, 0], force: {{elongations: [0, 1e-3, 2e-3], forces: [0, 0, 20]}}}}
  - {{on: roof, along: [0, 1], damper: {{rates: [-10, -1, 0, 1, 10], forces: [-2, -1, 0, 1, 2]}}}}
  - {{on: face, along: [1, 0], stiffness: 100}}
contact: {{c: {{master: table, slave: sole, friction: 0.3, integration: nodes}}}}
newton: {{residual: 1e-12}}
solver: {}
time: {}
)",
                     solver, time);
}

TEST_P(Bumper, ClosesItsLedgerAndIsTheSameInWholeSteps) {
  test::Walk condensed(block(GetParam().time, "condensed"));
  test::Walk full(block(GetParam().time, "full"));
  ASSERT_TRUE(condensed.to_end());
  ASSERT_TRUE(full.to_end());
  const auto& u = full.state().motion.u;
  EXPECT_LE((u - condensed.state().motion.u).lpNorm<Eigen::Infinity>(), 1e-9 * u.lpNorm<Eigen::Infinity>());
  const auto energy = condensed.simulation.energy();
  EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest());
  EXPECT_GT(condensed.displacement(condensed.node_at(3, 1), 0), 1e-3) << "the stop is reached";
  for (const auto& report : condensed.reports)
    EXPECT_TRUE(report.converged());
}

INSTANTIATE_TEST_SUITE_P(
    LawSprings, Bumper,
    testing::Values(Course{"Static", "{scheme: static, step: 2e-4, end: 4e-3}"},
                    Course{"Hht", "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-3}"},
                    Course{"MoreauJean",
                           "{scheme: moreau_jean, contact_mass: consistent, step: 1e-4, end: 4e-3}"}),
    [](const auto& info) { return info.param.name; });

TEST(LawSprings, AreRefusedWhereTheySayNothing) {
  const auto fault = [](const std::string& connector) {
    return test::fault_of([&] { test::Walk(plate(connector, stepwise)); });
  };
  EXPECT_NE(fault("{on: left, along: [1, 0], force: {elongations: [0, 0], forces: [0, 1]}}").find("ascend"),
            std::string::npos);
  EXPECT_NE(fault("{on: left, along: [1, 0], force: {elongations: [0, 1], forces: [0, 1, 2]}}")
                .find("found 3 forces for 2"),
            std::string::npos);
  EXPECT_NE(fault("{on: left, along: [1, 0], force: {elongations: [0], forces: [0]}}").find("at least"),
            std::string::npos);
  EXPECT_NE(fault("{on: left, along: [1, 0], stiffness: 1, force: {elongations: [0, 1], forces: [0, 1]}}")
                .find("one of the two"),
            std::string::npos);
  EXPECT_NE(
      fault("{on: left, along: [1, 0], damper: {rates: [0, 1], forces: [1, 1]}}").find("no rate changes"),
      std::string::npos);
  EXPECT_NE(fault("{on: left, along: [1, 0], force: {elongations: [0, 1]}}").find("forces"),
            std::string::npos);
}

} // namespace
} // namespace rubato::simulation::law_springs_test
