// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies beyond linear elasticity that expand by their temperature: closed forms, ledgers, fields.
#include "rubato/domain/cut.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/domain/recovery.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/study/formulation.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/bulk_laws.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace rubato::simulation::nonlinear_heat_test {
namespace {

using Eigen::VectorXd;
using test::NamedLaw;
using test::study_with;

constexpr double warmth = 0.03; ///< α ϑ

/// Reduced cells follow no temperature.
std::vector<NamedLaw> laws_that_heat() {
  auto laws = test::every_law;
  std::erase_if(laws, [](const NamedLaw& law) { return law.name.find("Reduced") != std::string::npos; });
  return laws;
}

/// Held against rigid motions only, warmed in three steps, by 3 % at last.
std::string free_body(const std::string& physics) {
  const bool solid = physics == "solid";
  return fmt::format(
      R"(mesh: {{generate: [{}]}}
physics: {}
materials: {{any: {{young: 100, poisson: 0.3, density: 1, expansion: 1e-4, reference_temperature: 20}}}}
supports: [{{on: left, fix: x}}, {{on: bottom, fix: y}}{}]
temperature: [{{on: all, value: '20 + 100*t'}}]
newton: {{residual: 1e-12}}
time: {{scheme: static, step: 1, end: 3}}
)",
      solid
          ? "{name: block, box: {from: [0, 0, 0], to: [2, 1, 1]}, divisions: [2, 2, 1], cells: hexa8, sides: "
            "{left: left, bottom: bottom, back: back}}"
          : "{name: block, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [2, 2], cells: quad4, sides: "
            "{left: left, bottom: bottom}}",
      physics, solid ? ", {on: back, fix: z}" : "");
}

/// Of a strain measure that is α ϑ along every axis.
double stretch_of(const study::Material& material) {
  if (study::is_hyperelastic(material.law))
    return 1 + warmth;
  switch (material.strain.value_or(study::StrainKind::small)) {
  case study::StrainKind::green_lagrange:
    return std::sqrt(1 + 2 * warmth);
  case study::StrainKind::logarithmic:
    return std::exp(warmth);
  default:
    return 1 + warmth;
  }
}

Eigen::MatrixXd at_nodes(domain::Tensor what, const test::Walk& walk) {
  const auto& model = walk.model;
  const auto& state = walk.state();
  return domain::nodal_tensors(what, model.mesh, model.bulk, model.dofs, state.motion.u,
                               {model.domain.heat(), state.t}, &state.bulk_points);
}

class FreeBodyOf : public testing::TestWithParam<std::tuple<NamedLaw, std::string>> {};

TEST_P(FreeBodyOf, ExpandsWithoutStress) {
  const auto& [law, physics] = GetParam();
  const auto study = study_with(free_body(physics), law);
  test::Walk walk(study);
  ASSERT_TRUE(walk.to_end());
  const double stretch = stretch_of(study.materials[0]);
  for (const auto node : walk.model.dofs.nodes) {
    const auto& x = walk.model.mesh.points[static_cast<std::size_t>(node)];
    for (int i = 0; i < walk.model.dofs.components; ++i)
      EXPECT_NEAR(walk.displacement(node, i), (stretch - 1) * x[i], 1e-8);
  }
  EXPECT_LE(at_nodes(domain::Tensor::stress, walk).cwiseAbs().maxCoeff(), 1e-6);
  const bool finite =
      study.materials[0].strain.value_or(study::StrainKind::small) != study::StrainKind::small ||
      study::is_hyperelastic(study.materials[0].law);
  const double strain = !finite ? warmth
                        : study.materials[0].strain == study::StrainKind::logarithmic
                            ? std::log(stretch)
                            : (stretch * stretch - 1) / 2;
  const auto strains = at_nodes(domain::Tensor::strain, walk);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(strains(i, 0), strain, 1e-7) << i;
  const auto energy = walk.simulation.energy();
  EXPECT_NEAR(energy.strain, 0, 1e-8);
  EXPECT_NEAR(energy.heat, 0, 1e-8);
}

std::string name_of(const NamedLaw& law, const std::string& physics) {
  return law.name + "_" + physics;
}

INSTANTIATE_TEST_SUITE_P(NonlinearHeat, FreeBodyOf,
                         testing::Combine(testing::ValuesIn(laws_that_heat()),
                                          testing::Values("solid", "axisymmetric")),
                         [](const auto& info) {
                           return name_of(std::get<0>(info.param), std::get<1>(info.param));
                         });

/// σ = −E α ϑ until it yields, then E (α ϑ − p) = σ_y + H p; it keeps a strain when it is cold again.
TEST(NonlinearHeat, MakesAHeldBarYield) {
  test::Walk walk(
      R"(mesh: {generate: [{name: bar, box: {from: [0, 0, 0], to: [2, 1, 1]}, divisions: [3, 1, 1], cells: hexa8,
  sides: {left: left, right: right, bottom: bottom, back: back}}]}
physics: solid
materials: {steel: {young: 2e5, poisson: 0.3, law: plastic, hardening: {linear: {yield_stress: 200, modulus: 2000}}, expansion: 1e-5}}
supports: [{on: left, fix: x}, {on: right, fix: x}, {on: bottom, fix: y}, {on: back, fix: z}]
functions: {warm: {times: [0, 1, 2], values: [0, 1, 0]}}
temperature: [{on: all, value: 300, function: warm}]
time: {scheme: static, step: 0.25, end: 2}
probes: {cut: {section: {point: [1.2, 0.5, 0.5], normal: [1, 0, 0]}}}
)");
  const double p = (2e5 * 3e-3 - 200) / (2e5 + 2000);
  bool seen = false;
  walk.accepted = [&] {
    if (walk.state().t != 1)
      return;
    seen = true;
    const double stress = -(200 + 2000 * p);
    EXPECT_NEAR(at_nodes(domain::Tensor::stress, walk)(0, 0), stress, 1e-8 * 200);
    const auto forces = domain::forces_at(walk.model.probe_cuts[0], walk.state().motion.u,
                                          {walk.model.domain.heat(), 1}, &walk.state().bulk_points);
    EXPECT_NEAR(forces[0], stress, 1e-8 * 200) << "area 1";
    EXPECT_NEAR(at_nodes(domain::Tensor::strain, walk)(0, 0), 0, 1e-12);
  };
  ASSERT_TRUE(walk.to_end());
  EXPECT_TRUE(seen);
  const auto energy = walk.simulation.energy();
  EXPECT_GT(energy.heat, 0);
  EXPECT_NEAR(energy.heat, energy.plastic + energy.strain, 1e-10 * energy.heat);
  EXPECT_GT(at_nodes(domain::Tensor::stress, walk)(0, 0), 100) << "drawn when it is cold again";
}

/// S. Timoshenko, J. N. Goodier, Theory of Elasticity, §151: tube 20 to 40, T = 100 ln(b/r)/ln(b/a), ends
/// held in z, α = 1.2e-5, ν = 0.3: u(a) = 0.0121060. Cells that average the dilatation come nearer than
/// others.
TEST(NonlinearHeat, WidensATubeOfMeanDilatation) {
  const auto inner = [](const std::string& formulation) {
    test::Walk walk(fmt::format(
        R"(mesh: {{generate: [{{name: tube, rectangle: {{from: [20, 0], to: [40, 1]}}, divisions: [8, 1], cells: quad4,
  sides: {{bottom: bottom, top: top}}}}]}}
physics: axisymmetric
materials: {{any: {{young: 2e5, poisson: 0.3, formulation: {}, expansion: 1.2e-5}}}}
supports: [{{on: bottom, fix: y}}, {{on: top, fix: y}}]
temperature: [{{on: all, value: '100*log(40/x)/log(2)'}}]
time: {{scheme: static, step: 1, end: 1}}
)",
        formulation));
    EXPECT_TRUE(walk.to_end());
    return walk.displacement(walk.node_at(20, 0), 0);
  };
  constexpr double exact = 0.0121060;
  const double averaged = std::abs(inner("mean_dilatation") - exact);
  EXPECT_LT(averaged, 3e-3 * exact);
  EXPECT_LT(averaged, 0.2 * std::abs(inner("full") - exact));
}

/// A block that grows, shrinks, yields and shakes between a wall and a table.
std::string shaken(const std::string& time, const std::string& contact) {
  return fmt::format(R"(mesh:
  generate:
    - {{name: low, rectangle: {{from: [0, -1], to: [4, 0]}}, divisions: [6, 2], cells: quad4, sides: {{bottom: ground, top: table}}}}
    - {{name: up, rectangle: {{from: [1, 0], to: [3, 1]}}, divisions: [4, 2], cells: quad4, sides: {{bottom: sole, top: roof}}}}
physics: plane_strain
materials:
  up: {{young: 100, poisson: 0.3, density: 1, cells: up, expansion: 1e-3, reference_temperature: 5}}
  low: {{young: 200, poisson: 0.3, density: 1, cells: low, expansion: 1e-3}}
functions:
  press: {{times: [0, 1, 2], values: [0, 1, 1]}}
  warms: {{sine: {{frequency: 0.5, amplitude: 1, mean: 0.2}}}}
temperature: [{{on: low, value: "4*x*t"}}, {{on: up, value: "15 + 5*x", function: warms}}]
supports: [{{on: ground, fix: [x, y]}}, {{on: roof, x: {{value: 1e-2, function: press}}, y: {{value: -5e-3, function: press}}}}]
contact: {{c: {{master: table, slave: sole, friction: 0.3{}}}}}
newton: {{residual: 1e-11}}
time: {}
)",
                     contact, time);
}

class HeatedBody : public testing::TestWithParam<std::tuple<NamedLaw, std::string>> {};

TEST_P(HeatedBody, ClosesItsLedger) {
  const auto& [law, time] = GetParam();
  const bool explicit_run = time.find("central") != std::string::npos;
  const auto deck = shaken(time, explicit_run ? ", method: penalty, integration: nodes" : "");
  auto study = study_with(deck, law);
  if (explicit_run && study.materials[0].formulation == study::Formulation::enhanced)
    GTEST_SKIP() << "explicit runs have no such cells";
  Simulation simulation(study);
  step::EnergyRecord record;
  while (!simulation.finished()) {
    ASSERT_TRUE(simulation.advance().accepted());
    record.note(simulation.state().t, simulation.energy());
  }
  EXPECT_LE(record.largest_balance, 1e-10 * record.largest);
  EXPECT_GT(std::abs(simulation.energy().heat), 1e-3 * record.largest);
}

std::string name_of_time(const std::string& time) {
  return time.substr(time.find(": ") + 2, time.find(',') - time.find(": ") - 2);
}

INSTANTIATE_TEST_SUITE_P(
    NonlinearHeat, HeatedBody,
    testing::Combine(testing::ValuesIn(laws_that_heat()),
                     testing::Values("{scheme: static, step: 0.1, end: 1.5}",
                                     "{scheme: hht, alpha: -0.1, step: 0.1, end: 1.5}",
                                     "{scheme: central_difference, end: 1.5, record: 0.1}")),
    [](const auto& info) { return name_of(std::get<0>(info.param), name_of_time(std::get<1>(info.param))); });

} // namespace
} // namespace rubato::simulation::nonlinear_heat_test
