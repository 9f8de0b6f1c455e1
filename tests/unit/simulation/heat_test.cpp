// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies that expand by their temperature: closed forms, ledgers, condensed steps against whole ones.
#include "rubato/deck/read.hpp"
#include "rubato/domain/cut.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/domain/recovery.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace rubato::simulation::heat_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

const std::string steel =
    "{young: 2e5, poisson: 0.3, density: 7.8e-9, expansion: 1e-5, reference_temperature: 20}";
constexpr double modulus = 2e5;
constexpr double alpha = 1e-5;

std::string one_step(const std::string& mesh, const std::string& physics, const std::string& more,
                     const std::string& material = steel) {
  return fmt::format(R"(mesh: {{generate: [{}]}}
physics: {}
materials: {{any: {}}}
time: {{scheme: static, step: 1, end: 1}}
{})",
                     mesh, physics, material, more);
}

std::string flat(const std::string& cells) {
  return fmt::format("{{name: plate, rectangle: {{from: [0, 0], to: [2, 1]}}, divisions: [3, 2], cells: {}, "
                     "sides: {{left: left, right: right, bottom: bottom}}, points: {{left_bottom: corner, "
                     "right_bottom: foot}}}}",
                     cells);
}

std::string solid(const std::string& cells) {
  return fmt::format(
      "{{name: block, box: {{from: [0, 0, 0], to: [2, 1, 1]}}, divisions: [3, 2, 2], cells: {}, "
      "sides: {{left: left, right: right, bottom: bottom, back: back}}}}",
      cells);
}

double largest_stress(const test::Walk& walk) {
  const auto& model = walk.model;
  return domain::nodal_stress(model.mesh, model.bulk, model.dofs, walk.state().motion.u,
                              {model.domain.heat(), walk.state().t})
      .stress.cwiseAbs()
      .maxCoeff();
}

Eigen::Matrix<double, 6, 1> stress_at(const test::Walk& walk, mesh::NodeIndex node) {
  const auto& model = walk.model;
  return domain::nodal_stress(model.mesh, model.bulk, model.dofs, walk.state().motion.u,
                              {model.domain.heat(), walk.state().t})
      .stress.col(node);
}

struct Cells {
  std::string physics;
  std::string type;
};

class FreeBody : public testing::TestWithParam<Cells> {};

/// 100 degrees above the reference: u = α 100 x, (1 + ν) α 100 x in plane strain, nothing stressed in the
/// plane.
TEST_P(FreeBody, ExpandsWithoutStress) {
  const auto& [physics, type] = GetParam();
  const bool in_space = physics == "solid";
  const auto supports = in_space
                            ? "supports: [{on: left, fix: x}, {on: bottom, fix: y}, {on: back, fix: z}]\n"
                            : "supports: [{on: left, fix: x}, {on: bottom, fix: y}]\n";
  test::Walk walk(one_step(in_space ? solid(type) : flat(type), physics,
                           std::string(supports) + "temperature: [{on: all, value: 120}]\n"));
  ASSERT_TRUE(walk.to_end());
  const double stretch = alpha * 100 * (physics == "plane_strain" ? 1.3 : 1);
  for (const auto node : walk.model.dofs.nodes) {
    const auto& x = walk.model.mesh.points[static_cast<std::size_t>(node)];
    for (int i = 0; i < walk.model.dofs.components; ++i)
      EXPECT_NEAR(walk.displacement(node, i), stretch * x[i], 1e-13);
  }
  const auto stress = stress_at(walk, walk.model.dofs.nodes.front());
  const double along_z = physics == "plane_strain" ? -modulus * alpha * 100 : 0;
  EXPECT_NEAR(stress[2], along_z, 1e-9 * modulus * alpha * 100);
  EXPECT_LE(largest_stress(walk), std::abs(along_z) + 1e-9 * modulus * alpha * 100);
  const auto energy = walk.simulation.energy();
  const double volume = 2;
  const double held_along_z = physics == "plane_strain" ? 0.5 * modulus * 1e-6 * volume : 0;
  EXPECT_NEAR(energy.strain, held_along_z, 1e-10 * energy.held_heat);
  EXPECT_NEAR(energy.balance(), 0, 1e-12 * energy.largest());
}

INSTANTIATE_TEST_SUITE_P(Heat, FreeBody,
                         testing::Values(Cells{"plane_stress", "quad4"}, Cells{"plane_stress", "tria6"},
                                         Cells{"plane_strain", "quad8"}, Cells{"plane_strain", "tria3"},
                                         Cells{"axisymmetric", "quad4"}, Cells{"axisymmetric", "quad9"},
                                         Cells{"solid", "hexa8"}, Cells{"solid", "hexa20"},
                                         Cells{"solid", "hexa27"}, Cells{"solid", "tetra4"},
                                         Cells{"solid", "tetra10"}, Cells{"solid", "penta6"},
                                         Cells{"solid", "penta15"}),
                         [](const auto& info) { return info.param.physics + "_" + info.param.type; });

/// T = 50 x leaves a plate without stress: u = α 50 (x² − y²)/2, v = α 50 x y.
TEST(Heat, BendsAPlateWithoutStressWhereItIsLinear) {
  test::Walk walk(one_step(flat("quad8"), "plane_stress",
                           "supports: [{on: corner, fix: [x, y]}, {on: foot, fix: y}]\n"
                           "temperature: [{on: all, value: '20 + 50*x'}]\n"));
  ASSERT_TRUE(walk.to_end());
  EXPECT_LE(largest_stress(walk), 1e-9 * modulus * alpha * 100);
  for (const auto node : walk.model.dofs.nodes) {
    const auto& x = walk.model.mesh.points[static_cast<std::size_t>(node)];
    EXPECT_NEAR(walk.displacement(node, 0), alpha * 25 * (x[0] * x[0] - x[1] * x[1]), 1e-14);
    EXPECT_NEAR(walk.displacement(node, 1), alpha * 50 * x[0] * x[1], 1e-14);
  }
}

/// Both ends held: σ = −E α ϑ, the energy is ½ E (α ϑ)² V and comes from the heat.
TEST(Heat, PressesABarBetweenItsEnds) {
  test::Walk walk(one_step(
      solid("hexa8"), "solid",
      "supports: [{on: left, fix: x}, {on: right, fix: x}, {on: bottom, fix: y}, {on: back, fix: z}]\n"
      "temperature: [{on: all, value: '20 + 50*t'}]\n"
      "probes: {cut: {section: {point: [1, 0.5, 0.5], normal: [1, 0, 0]}}}\n"));
  ASSERT_TRUE(walk.to_end());
  const double stress = -modulus * alpha * 50;
  EXPECT_NEAR(stress_at(walk, walk.model.dofs.nodes.front())[0], stress, 1e-9 * std::abs(stress));
  const auto forces =
      domain::forces_at(walk.model.probe_cuts[0], walk.state().motion.u, {walk.model.domain.heat(), 1});
  EXPECT_NEAR(forces[0], stress, 1e-9 * std::abs(stress)) << "area 1";
  const auto energy = walk.simulation.energy();
  EXPECT_NEAR(energy.strain, 0.5 * stress * stress / modulus * 2, 1e-10 * energy.strain);
  EXPECT_NEAR(energy.heat, energy.strain, 1e-10 * energy.strain);
}

/// S. Timoshenko, J. N. Goodier, Theory of Elasticity, §151: tube 1 to 2, T = 100 ln(2/r)/ln 2, ends held in
/// z: σ_θ(b) = E α 100/(2 (1 − ν) ln 2) (1 − 2 a²/(b² − a²) ln(b/a)).
TEST(Heat, StressesATubeThatIsHotInside) {
  test::Walk walk(one_step("{name: tube, rectangle: {from: [1, 0], to: [2, 0.25]}, divisions: [16, 2], "
                           "cells: quad8, sides: {bottom: "
                           "bottom, top: top}}",
                           "axisymmetric",
                           "supports: [{on: bottom, fix: y}, {on: top, fix: y}]\ntemperature: [{on: all, "
                           "value: '20 + 100*log(2/x)/log(2)'}]\n"));
  ASSERT_TRUE(walk.to_end());
  const double scale = modulus * alpha * 100 / (2 * 0.7 * std::numbers::ln2);
  const auto outer = stress_at(walk, walk.node_at(2, 0.125));
  EXPECT_NEAR(outer[2], scale * (1 - 2. / 3 * std::numbers::ln2), 2e-3 * scale);
  EXPECT_NEAR(outer[0], 0, 2e-3 * scale);
  const auto inner = stress_at(walk, walk.node_at(1, 0.125));
  EXPECT_NEAR(inner[2], scale * (1 - 8. / 3 * std::numbers::ln2), 5e-3 * scale);
}

/// Axes turned by 30°: what expands freely has the strains α along them.
TEST(Heat, ExpandsAnOrthotropicPlateAlongItsAxes) {
  test::Walk walk(one_step(
      flat("quad4"), "plane_stress",
      "supports: [{on: corner, fix: [x, y]}, {on: foot, fix: y}]\ntemperature: [{on: all, value: 100}]\n",
      "{law: orthotropic, young_x: 2e5, young_y: 1e5, poisson_xy: 0.3, shear_xy: 6e4, angle_z: 30, "
      "expansion: [1e-5, 3e-5, 0]}"));
  ASSERT_TRUE(walk.to_end());
  EXPECT_LE(largest_stress(walk), 1e-9 * modulus * 3e-3);
  const double xx = 1e-3 * 0.75 + 3e-3 * 0.25;
  const auto foot = walk.node_at(2, 0);
  EXPECT_NEAR(walk.displacement(foot, 0), 2 * xx, 1e-13);
}

/// The last entry counts where entries share nodes.
TEST(Heat, TakesTheLastEntryOfANode) {
  test::Walk walk(one_step(
      flat("quad4"), "plane_stress",
      "supports: [{on: corner, fix: [x, y]}, {on: foot, fix: y}]\n"
      "temperature: [{on: all, value: 1000}, {on: plate, value: 30}, {on: right, value: '20 + 10*t'}]\n"));
  ASSERT_TRUE(walk.to_end());
  EXPECT_NEAR(walk.displacement(walk.node_at(2, 0), 0), 2 * alpha * 10, 1e-14);
}

struct Course {
  std::string name;
  std::string time;
  std::string contact;
};

class HeatedBlocks : public testing::TestWithParam<Course> {};

/// A block that grows and shrinks against a table with friction, its support moving: every energy has its
/// entry.
std::string blocks(const Course& course, const std::string& solver) {
  return fmt::format(R"(mesh:
  generate:
    - {{name: low, rectangle: {{from: [0, -1], to: [4, 0]}}, divisions: [8, 2], cells: quad4, sides: {{bottom: ground, top: table}}}}
    - {{name: up, rectangle: {{from: [1, 0], to: [3, 1]}}, divisions: [5, 3], cells: quad4, sides: {{bottom: sole, top: roof}}}}
physics: plane_strain
materials:
  low: {{young: 2e5, poisson: 0.3, density: 7.8e-3, cells: low, expansion: 1e-5, rayleigh: {{stiffness: 1e-6}}}}
  up: {{young: 1e5, poisson: 0.2, density: 7.8e-3, cells: up, expansion: 3e-5, reference_temperature: 50, rayleigh: {{stiffness: 1e-6}}}}
functions:
  press: {{times: [0, 1e-3, 2e-3], values: [0, 1, 1]}}
  warms: {{sine: {{frequency: 300, amplitude: 1, mean: 0}}}}
temperature: [{{on: low, value: "40*x*t/1e-3"}}, {{on: up, value: 80, function: warms}}]
supports: [{{on: ground, fix: [x, y]}}, {{on: roof, x: {{value: 1e-3, function: press}}, y: {{value: -2e-3, function: press}}}}]
contact: {{c: {{master: table, slave: sole, friction: 0.3{}}}}}
newton: {{residual: 1e-12}}
solver: {}
time: {}
)",
                     course.contact, solver, course.time);
}

TEST_P(HeatedBlocks, ClosesItsLedger) {
  const auto& course = GetParam();
  Simulation simulation(deck::parse_deck(blocks(course, "auto"), "deck.yaml").runs.front());
  while (!simulation.finished())
    ASSERT_TRUE(simulation.advance().accepted());
  const auto energy = simulation.energy();
  EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest());
  EXPECT_GT(std::abs(energy.heat), 1e-3 * energy.largest());
  EXPECT_GT(energy.friction, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Heat, HeatedBlocks,
    testing::Values(
        Course{"Static", "{scheme: static, step: 1e-4, end: 2e-3}", ""},
        Course{"StaticOnNodes", "{scheme: static, step: 1e-4, end: 2e-3}", ", integration: nodes"},
        Course{"Hht", "{scheme: hht, alpha: -0.1, step: 5e-5, end: 2e-3}", ""},
        Course{"GeneralizedAlpha", "{scheme: generalized_alpha, step: 5e-5, end: 2e-3}", ""},
        Course{"MoreauJean", "{scheme: moreau_jean, step: 5e-5, end: 2e-3}", ""},
        Course{"CentralDifference", "{scheme: central_difference, step: 1e-6, end: 2e-3, record: 1e-4}",
               ", method: penalty, integration: nodes"}),
    [](const auto& info) { return info.param.name; });

TEST(Heat, IsTheSameInCondensedAndInWholeSteps) {
  const Course course{"", "{scheme: static, step: 1e-4, end: 2e-3}", ", integration: nodes"};
  test::Walk condensed(blocks(course, "condensed"));
  test::Walk full(blocks(course, "full"));
  ASSERT_TRUE(condensed.to_end());
  ASSERT_TRUE(full.to_end());
  const VectorXd difference = condensed.state().motion.u - full.state().motion.u;
  EXPECT_LE(difference.lpNorm<Eigen::Infinity>(), 1e-10 * full.state().motion.u.lpNorm<Eigen::Infinity>());
}

/// A temperature that follows time is a load: two ways of writing it, one motion.
TEST(Heat, MovesABodyAsAnExpressionOfTimeOrAsAFunction) {
  const auto deck = [](const std::string& temperature) {
    return fmt::format(R"(mesh: {{generate: [{}]}}
physics: solid
materials: {{any: {}}}
functions: {{rise: {{times: [0, 1e-4], values: [0, 1]}}}}
supports: [{{on: left, fix: [x, y, z]}}]
temperature: [{}]
time: {{scheme: hht, alpha: -0.05, step: 1e-6, end: 2e-5}}
)",
                       solid("hexa8"), steel, temperature);
  };
  test::Walk by_function(deck("{on: all, value: 1e6, function: rise}"));
  test::Walk by_expression(deck("{on: all, value: '1e10*t'}"));
  ASSERT_TRUE(by_function.to_end());
  ASSERT_TRUE(by_expression.to_end());
  const auto& u = by_function.state().motion.u;
  EXPECT_GT(u.lpNorm<Eigen::Infinity>(), 0);
  EXPECT_LE((u - by_expression.state().motion.u).lpNorm<Eigen::Infinity>(),
            1e-12 * u.lpNorm<Eigen::Infinity>());
}

TEST(Heat, RefusesWhatSaysNothing) {
  const auto faults = [](const std::string& more, const std::string& material) {
    return test::fault_of([&] {
      test::Walk(
          one_step(flat("quad4"), "plane_stress", "supports: [{on: left, fix: [x, y]}]\n" + more, material));
    });
  };
  EXPECT_NE(
      faults("temperature: [{on: all, value: 1}]\n", "{young: 1, poisson: 0}").find("no material expands"),
      std::string::npos);
  EXPECT_NE(
      faults("temperature: [{on: left, value: 1}]\n", steel).find("nodes with and without a temperature"),
      std::string::npos);
  EXPECT_NE(faults("temperature: [{on: nowhere, value: 1}]\n", steel).find("nowhere"), std::string::npos);
  EXPECT_NE(faults("temperature: [{on: all, value: '1/(x-x)'}]\n", steel).find("finite"), std::string::npos);
  EXPECT_NE(faults("", "{young: 1, poisson: 0, reference_temperature: 3}").find("expansion"),
            std::string::npos);
  EXPECT_NE(faults("", "{young: 1, poisson: 0, expansion: [1, 2, 3]}").find("alike"), std::string::npos);
  EXPECT_NE(faults("", "{young: 1, poisson: 0, expansion: [1, 2]}").find("found 2 numbers"),
            std::string::npos);
  EXPECT_NE(faults("probes: {p: {node: corner, field: temperature}}\n", steel).find("no temperatures"),
            std::string::npos);
}

} // namespace
} // namespace rubato::simulation::heat_test
