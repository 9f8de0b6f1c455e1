// SPDX-License-Identifier: LGPL-3.0-or-later
// Bodies whose material depends on the place, from the deck to displacements, stresses and masses.
#include "rubato/deck/read.hpp"
#include "rubato/domain/cut.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/domain/recovery.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/two_blocks.hpp"
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::simulation::graded_test {
namespace {

using Eigen::VectorXd;

std::string plane_deck(const std::string& cells, int divisions, const std::string& materials,
                       const std::string& time, const std::string& physics = "plane_stress") {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: bar, rectangle: {{from: [0, 0], to: [2, 1]}}, divisions: [{}, 2], cells: {},
       sides: {{left: held, right: end, bottom: floor}}}}
  groups:
    near: {{box: {{from: [-1, -1], to: [1, 2]}}, take: cells}}
    far: {{box: {{from: [1, -1], to: [3, 2]}}, take: cells}}
physics: {}
materials: {{{}}}
supports: [{{on: held, fix: x}}, {{on: floor, fix: y}}]
loads: [{{surface_force: {{on: end, x: 3}}}}]
time: {{{}}}
)",
                     divisions, cells, physics, materials, time);
}

const std::string at_rest = "scheme: static, step: 1, end: 1";

VectorXd end_of(const std::string& deck) {
  Simulation simulation(deck::parse_deck(deck, "deck.yaml").runs.front());
  while (!simulation.finished())
    simulation.advance();
  return simulation.state().motion.u;
}

double largest_along_x(const VectorXd& u) {
  double largest = 0;
  for (Eigen::Index i = 0; i < u.size(); i += 2)
    largest = std::max(largest, u[i]);
  return largest;
}

/// E = 100 (1 + 1.5 x): u(l) = s/(E₀ k) ln(1 + k l).
double error_of_bar(const std::string& young, int divisions) {
  const auto deck = plane_deck("quad8", divisions, "steel: {young: " + young + ", poisson: 0}", at_rest);
  const double exact = 3 / (100 * 1.5) * std::log(1 + 1.5 * 2);
  return std::abs(largest_along_x(end_of(deck)) / exact - 1);
}

TEST(AGradedBar, StretchesByTheClosedFormAndConverges) {
  const double coarse = error_of_bar("100*(1+1.5*x)", 4);
  const double fine = error_of_bar("100*(1+1.5*x)", 8);
  EXPECT_LT(fine, 2e-5);
  EXPECT_LT(error_of_bar("100*(1+1.5*x)", 16), 2e-6);
  EXPECT_GT(std::log2(coarse / fine), 3.5) << coarse << " " << fine;
  RecordProperty("error_8_cells", fmt::format("{:.3g}", fine));
  RecordProperty("order", fmt::format("{:.3g}", std::log2(coarse / fine)));
}

TEST(AGradedBar, MayHaveATableInsteadOfAnExpression) {
  const double by_text = error_of_bar("100*(1+1.5*x)", 4);
  const double by_table = error_of_bar("{along: x, at: [0, 2], values: [100, 400]}", 4);
  EXPECT_NEAR(by_table, by_text, 1e-13);
}

const std::string two_materials =
    "soft: {young: 100, poisson: 0.2, density: 3, rayleigh: {stiffness: 0.01, mass: 0.1}, cells: near}, "
    "hard: {young: 250, poisson: 0.3, density: 5, rayleigh: {stiffness: 0.01, mass: 0.1}, cells: far}";
const std::string one_material =
    "both: {young: 'if(x<1, 100, 250)', poisson: 'if(x<1, 0.2, 0.3)', density: 'if(x<1, 3, 5)', "
    "rayleigh: {stiffness: 0.01, mass: 0.1}}";

struct Piecewise {
  std::string cells;
  std::string physics;
  std::string time;
};

class PiecewiseConstantMaterials : public testing::TestWithParam<Piecewise> {};

TEST_P(PiecewiseConstantMaterials, AreTheSameAsSeveralMaterials) {
  const auto& [cells, physics, time] = GetParam();
  const auto expected = end_of(plane_deck(cells, 4, two_materials, time, physics));
  const auto found = end_of(plane_deck(cells, 4, one_material, time, physics));
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
}

INSTANTIATE_TEST_SUITE_P(
    Of, PiecewiseConstantMaterials,
    testing::Values(Piecewise{"quad4", "plane_stress", at_rest}, Piecewise{"quad9", "plane_strain", at_rest},
                    Piecewise{"tria6", "axisymmetric", at_rest},
                    Piecewise{"quad8", "plane_strain", "scheme: hht, alpha: -0.1, step: 0.01, end: 0.05"},
                    Piecewise{"quad4", "axisymmetric", "scheme: central_difference, step: auto, end: 0.02"}),
    [](const auto& chosen) {
      return chosen.param.cells + chosen.param.physics.substr(0, 4) + std::to_string(chosen.index);
    });

/// ∫ 1 + 2x + 3x² y over 2 × 1 is 2 + 4 + 4.
TEST(AGradedDensity, HasItsIntegralAsMassAndAsWeight) {
  const auto materials = "steel: {young: 1, poisson: 0, density: 1+2*x+3*x^2*y}";
  for (const auto* cells : {"quad8", "quad9", "tria6"}) {
    const auto deck = plane_deck(cells, 3, materials, "scheme: newmark, step: 1, end: 1");
    const auto model = test::model_of(deck);
    EXPECT_NEAR(model.mass.sum(), 2 * 10, 1e-12) << cells;
    const auto lumped =
        test::model_of(plane_deck(cells, 3, materials, "scheme: central_difference, step: auto, end: 0.01"));
    EXPECT_NEAR(lumped.lumped_mass.sum(), 2 * 10, 1e-12) << cells;
    const auto heavy = test::model_of(test::with(deck, "surface_force: {on: end, x: 3}", "gravity: {y: -9}"));
    EXPECT_NEAR(model::external_force(heavy, 0).sum(), -9 * 10, 1e-11) << cells;
  }
}

TEST(AGradedBody, HasStressesOfItsMaterialAtEachPoint) {
  const auto deck = plane_deck("quad4", 8, "steel: {young: 100*(1+1.5*x), poisson: 0}", at_rest);
  const auto model = test::model_of(deck);
  VectorXd u = VectorXd::Zero(model.dofs.dof_count);
  for (const auto node : model.dofs.nodes)
    u[model.dofs.dof(node, 0)] = 1e-3 * model.mesh.points[static_cast<std::size_t>(node)][0];
  domain::CellTensors tensors(model.mesh, model.bulk, model.dofs, u);
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i) {
    const auto cell = model.bulk.cells[i];
    const domain::CellPoints points(model.mesh, model.mesh.nodes_of(cell));
    const auto places = element::places(cell::stiffness_table(model.mesh.type_of(cell)), points);
    const auto stress = tensors.at_points(domain::Tensor::stress, i);
    for (Eigen::Index q = 0; q < places.cols(); ++q)
      EXPECT_NEAR(stress(0, q), 0.1 * (1 + 1.5 * places(0, q)), 1e-13);
  }
}

/// Nodal forces of the cells behind the cut hold the load, whatever the material.
TEST(AGradedBody, TransmitsItsLoadInEveryCut) {
  for (const auto* cells : {"quad4", "quad8"}) {
    const auto model =
        test::model_of(plane_deck(cells, 4, "steel: {young: 100*(1+x*y), poisson: 0.1+0.1*x}", at_rest) +
                       "probes: {cut: {section: {point: [1, 0.5], normal: [1, 0]}}}\n");
    Simulation simulation(model);
    while (!simulation.finished())
      simulation.advance();
    const auto force = domain::forces_at(model.probe_cuts.front(), simulation.state().motion.u);
    EXPECT_NEAR(force[0], 3, 1e-11) << cells;
  }
}

/// ∫ σ·ε/2 at the points is ½ u·K u.
TEST(AGradedBody, StoresTheEnergyOfItsPoints) {
  const auto model =
      test::model_of(plane_deck("quad8", 3, "steel: {young: 100*(1+x*y), poisson: 0.1+0.1*x}", at_rest));
  std::srand(5);
  const VectorXd u = VectorXd::Random(model.dofs.dof_count);
  domain::CellTensors tensors(model.mesh, model.bulk, model.dofs, u);
  double energy = 0;
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i) {
    const auto cell = model.bulk.cells[i];
    const domain::CellPoints points(model.mesh, model.mesh.nodes_of(cell));
    const auto stress = tensors.at_points(domain::Tensor::stress, i);
    const auto strain = tensors.at_points(domain::Tensor::strain, i);
    VectorXd volume(stress.cols());
    element::point_volumes(model.mesh.type_of(cell), points, model.bulk.section, volume);
    for (Eigen::Index q = 0; q < stress.cols(); ++q)
      energy += 0.5 * volume[q] *
                (stress(0, q) * strain(0, q) + stress(1, q) * strain(1, q) + 2 * stress(3, q) * strain(3, q));
  }
  EXPECT_NEAR(model.domain.energy(u, model.domain.initial_tangent() * u, 0, {}), energy, 1e-12 * energy);
}

TEST(BadGradedMaterials, AreToldWithPlaceValueAndPath) {
  const auto fault = [](const std::string& material) {
    return test::fault_of(
        [&] { test::model_of(plane_deck("quad4", 2, "steel: {" + material + "}", at_rest)); });
  };
  EXPECT_EQ(
      fault("young: 1-x, poisson: 0"),
      "materials.steel.young: found -0.211325 at x = 1.21132, y = 0.105662, z = 0, expected a number > 0");
  EXPECT_EQ(fault("young: 1, poisson: x"), "materials.steel.poisson: found 0.788675 at x = 0.788675, y = "
                                           "0.105662, z = 0, expected a number between -1 and 0.5");
  EXPECT_EQ(
      fault("young: 1, poisson: 0, density: 1-x"),
      "materials.steel.density: found -0.211325 at x = 1.21132, y = 0.105662, z = 0, expected a number > 0");
  EXPECT_EQ(fault("young: 1/(x-x), poisson: 0"),
            "materials.steel.young: '1/(x-x)' is infinite at x = 0.211325, y = 0.105662, z = 0, t = 0, "
            "expected a finite number");
  EXPECT_EQ(
      fault("law: orthotropic, young_x: 4, young_y: 4-3*y, poisson_xy: 1.2, shear_xy: 1"),
      "materials.steel.poisson_xy: at x = 0.211325, y = 0.105662, z = 0: found 1.2, expected a number "
      "between -1.04215 and 1.04215, the roots of young_x/young_y: else a strain has no positive energy");
}

/// Of numbers, coordinates, signs and functions.
std::string random_expression(std::mt19937& random, int depth) {
  static constexpr std::array<std::string_view, 8> leaves{"x", "y", "1", "0", "2.5", "1e3", "pi", "0.3"};
  static constexpr std::array<std::string_view, 6> signs{"+", "-", "*", "/", "^", "<"};
  static constexpr std::array<std::string_view, 6> functions{"sin", "exp", "log", "sqrt", "abs", "floor"};
  const auto inner = [&] { return random_expression(random, depth - 1); };
  if (depth == 0)
    return std::string(leaves[random() % leaves.size()]);
  if (random() % 3 == 0)
    return fmt::format("{}({})", functions[random() % functions.size()], inner());
  return fmt::format("({}{}{})", inner(), signs[random() % signs.size()], inner());
}

TEST(AnyExpressionOfAMaterial, GivesAModelOrOneSentence) {
  std::mt19937 random(7); // NOLINT(cert-msc32-c, cert-msc51-cpp): the same texts every time
  const auto deck = [](const std::string& text) {
    return plane_deck("quad4", 2, "steel: {young: '" + text + "', poisson: 0.3}", at_rest);
  };
  const auto study = deck::parse_deck(deck("1"), "deck.yaml").runs.front();
  const auto mesh = model::load_mesh(study.mesh);
  int built = 0;
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    auto varied = study;
    const auto text = random_expression(random, 1 + static_cast<int>(random() % 3));
    varied.materials[0].in_place["young"] = study::Formula{text};
    const auto fault = test::fault_of([&] { test::BuiltModel(varied, mesh); });
    if (fault == "nothing thrown") {
      ++built;
      continue;
    }
    EXPECT_TRUE(fault.starts_with("materials.steel.young: ") ||
                fault.find("is not finite") != std::string::npos)
        << text << ": " << fault;
    EXPECT_EQ(fault.find('\n'), std::string::npos) << fault;
    ++refused;
  }
  EXPECT_GT(built, 200);
  EXPECT_GT(refused, 200);
}

} // namespace
} // namespace rubato::simulation::graded_test
