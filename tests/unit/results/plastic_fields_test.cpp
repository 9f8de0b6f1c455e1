// SPDX-License-Identifier: LGPL-3.0-or-later
// Fields and probes of bodies that flow, in cells, at their Gauss points and at nodes.
#include "rubato/domain/recovery.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/cell_fields.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/results/probe_values.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <gtest/gtest.h>

#include "support/solid_materials.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace rubato::results::plastic_fields_test {
namespace {

using Values = std::vector<double>;

constexpr double young = 200e3;
constexpr double poisson = 0.3;
constexpr double yield_stress = 200;
constexpr double modulus = 20e3;

/// A bar of two cells that is drawn out along x to 1.01 of its length, free to become thinner.
const std::string drawn_bar = R"(
mesh:
  generate:
    - {name: bar, box: {from: [0, 0, 0], to: [2, 1, 1]}, divisions: [2, 1, 1], cells: hexa8,
       sides: {left: left, right: right, bottom: bottom, front: front}}
physics: solid
materials: {steel: {young: 200e3, poisson: 0.3}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports:
  - {on: left, fix: x}
  - {on: bottom, fix: y}
  - {on: front, fix: z}
  - {on: right, x: {value: 0.02, function: ramp}}
time: {scheme: static, step: 0.5, end: 1}
)";

const Values& values_of(const std::vector<OwnedField>& fields, const std::string& name) {
  return std::ranges::find(fields, name, &OwnedField::name)->values;
}

void expect_each(const Values& values, const Values& expected, const std::string& what) {
  ASSERT_FALSE(values.empty()) << what;
  ASSERT_EQ(values.size() % expected.size(), 0U) << what;
  double largest = 0;
  for (const double value : expected)
    largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(values[i], expected[i % expected.size()], 1e-7 * largest + 1e-15) << what << ' ' << i;
}

/// A bar after its run, and what it has everywhere alike.
class DrawnBar {
public:
  explicit DrawnBar(study::StrainKind strain) : simulation_(study_with(strain)) {
    while (!simulation_.finished())
      EXPECT_TRUE(simulation_.advance().accepted());
  }

  const model::Model& model() const { return simulation_.model(); }
  const step::State& state() const { return simulation_.state(); }

  std::vector<OwnedField> at_nodes(const std::vector<std::string>& also) const {
    study::FieldOutput output;
    output.also = also;
    return nodal_fields(model(), state(), output);
  }

  /// Fields in cells by their names, all parts one after the other.
  std::map<std::string, Values> in_cells(const std::string& ending) const {
    study::FieldOutput output;
    for (const auto& field : study::stored_fields(3))
      if (field.name.ends_with(ending))
        output.also.push_back(field.name);
    std::map<std::string, Values> all;
    for (const auto& field : cell_fields(model(), state(), output))
      for (const auto& part : field.parts)
        std::ranges::copy(part.values,
                          std::back_inserter(all[field.name.substr(0, field.name.size() - ending.size())]));
    return all;
  }

private:
  static study::Study study_with(study::StrainKind strain) {
    auto study = test::study_of(drawn_bar);
    test::make_plastic(study.materials[0], yield_stress, modulus, strain);
    return study;
  }

  simulation::Simulation simulation_;
};

/// Of a bar under a true stress along x, with the plastic strain p along it.
std::map<std::string, Values> expected_fields(double stress, double strain, double p, double narrowing) {
  return {{"stress", {stress, 0, 0, 0, 0, 0}},
          {"strain", {strain, narrowing, narrowing, 0, 0, 0}},
          {"plastic_strain", {p, -p / 2, -p / 2, 0, 0, 0}},
          {"cumulated_plastic_strain", {p}},
          {"von_mises", {stress}},
          {"tresca", {stress}},
          {"mean_stress", {stress / 3}},
          {"principal_stress", {stress, 0, 0}}};
}

void expect_fields(const DrawnBar& bar, const std::map<std::string, Values>& expected) {
  std::vector<std::string> names;
  for (const auto& [name, values] : expected)
    names.push_back(name);
  const auto nodal = bar.at_nodes(names);
  for (const auto& [name, values] : expected)
    expect_each(values_of(nodal, name), values, name);
  for (const auto* ending : {"_elno", "_elga", "_elem"}) {
    const auto fields = bar.in_cells(ending);
    EXPECT_EQ(fields.size(), expected.size()) << "none of temperature";
    for (const auto& [name, values] : expected)
      expect_each(fields.at(name), values, name + ending);
  }
  EXPECT_EQ(bar.in_cells("_elem").at("stress").size(), 2U * 6);
  EXPECT_EQ(bar.in_cells("_elga").at("tresca").size(), 2U * 8);
}

/// A cantilever whose outer points flow near its root: the line through the points of a cell is negative
/// where the cell is elastic.
const std::string bent_beam = R"(
mesh:
  generate:
    - {name: beam, rectangle: {from: [0, 0], to: [4, 1]}, divisions: [4, 1], cells: CELLS, sides: {left: left, right: right}}
physics: plane_strain
materials: {steel: {young: 200e3, poisson: 0.3}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: left, fix: [x, y]}, {on: right, y: {value: -0.05, function: ramp}}]
time: {scheme: static, step: 0.5, end: 1}
)";

TEST(PlasticFields, HaveNoNegativePlasticStrainAtNodes) {
  for (const std::string cells : {"quad8", "quad9", "tria6"}) {
    auto study = test::study_of(test::with(bent_beam, "CELLS", cells));
    test::make_plastic(study.materials[0], yield_stress, modulus, study::StrainKind::small);
    simulation::Simulation simulation(study);
    while (!simulation.finished())
      ASSERT_TRUE(simulation.advance().accepted());
    const auto& model = simulation.model();
    domain::CellTensors tensors(model.mesh, model.bulk, model.dofs, simulation.state().motion.u, {},
                                &simulation.state().bulk_points);
    double raw = 0, kept = 0, largest = 0;
    for (std::size_t i = 0; i < model.bulk.cells.size(); ++i) {
      const auto& to_nodes = domain::extrapolation(model.mesh.type_of(model.bulk.cells[i]));
      raw = std::min(raw, (tensors.cumulated_plastic_strain(i) * to_nodes.transpose()).minCoeff());
      kept = std::min(kept, tensors.cumulated_plastic_strain_at_nodes(i).minCoeff());
    }
    study::FieldOutput output;
    output.also = {"cumulated_plastic_strain"};
    const auto fields = nodal_fields(model, simulation.state(), output);
    for (const double value : values_of(fields, "cumulated_plastic_strain")) {
      kept = std::min(kept, value);
      largest = std::max(largest, value);
    }
    EXPECT_LT(raw, -1e-5) << cells;
    EXPECT_EQ(kept, 0) << cells;
    EXPECT_GT(largest, 1e-3) << cells;
  }
}

/// σ = σ_y + H p = E (ε − p).
TEST(PlasticFields, AreThoseOfABarInTension) {
  const double p = (young * 0.01 - yield_stress) / (young + modulus);
  const double stress = yield_stress + modulus * p;
  const double narrowing = -poisson * stress / young - p / 2;
  expect_fields(DrawnBar(study::StrainKind::small), expected_fields(stress, 0.01, p, narrowing));
}

/// Kirchhoff's stress and ½ ln C in the place of σ and ε; J from the elastic part.
TEST(PlasticFields, HaveTrueStressesOfLargeStrains) {
  const double strain = std::log(1.01);
  const double p = (young * strain - yield_stress) / (young + modulus);
  const double kirchhoff = yield_stress + modulus * p;
  const double stress = kirchhoff / std::exp((1 - 2 * poisson) * kirchhoff / young);
  const double narrowing = -poisson * kirchhoff / young - p / 2;
  expect_fields(DrawnBar(study::StrainKind::logarithmic), expected_fields(stress, strain, p, narrowing));
}

/// The law gives second Piola's stress S of E. The true stress is σ = λ₁² S/J with stretches λ = √(1 + 2 E).
TEST(PlasticFields, HaveTrueStressesOfLargeRotations) {
  const double strain = (1.01 * 1.01 - 1) / 2;
  const double p = (young * strain - yield_stress) / (young + modulus);
  const double piola = yield_stress + modulus * p;
  const double narrowing = -poisson * piola / young - p / 2;
  const double stress = 1.01 * piola / (1 + 2 * narrowing);
  expect_fields(DrawnBar(study::StrainKind::green_lagrange), expected_fields(stress, strain, p, narrowing));
}

/// The law finds the strain across the plane; true stresses are those by the undeformed thickness.
TEST(PlasticFields, HaveTheStrainAcrossAPlate) {
  auto deck = drawn_bar;
  deck.replace(deck.find("box: {from: [0, 0, 0], to: [2, 1, 1]}, divisions: [2, 1, 1], cells: hexa8"), 73,
               "rectangle: {from: [0, 0], to: [2, 1]}, divisions: [2, 1], cells: quad4");
  deck.replace(deck.find(", front: front"), 14, "");
  deck.replace(deck.find("  - {on: front, fix: z}\n"), 24, "");
  deck.replace(deck.find("physics: solid"), 14, "physics: plane_stress");
  auto study = test::study_of(deck);
  test::make_plastic(study.materials[0], yield_stress, modulus, study::StrainKind::logarithmic);
  simulation::Simulation simulation(study);
  while (!simulation.finished())
    ASSERT_TRUE(simulation.advance().accepted());
  const double strain = std::log(1.01);
  const double p = (young * strain - yield_stress) / (young + modulus);
  const double kirchhoff = yield_stress + modulus * p;
  const double narrowing = -poisson * kirchhoff / young - p / 2;
  study::FieldOutput output;
  output.only = {"stress_elga", "strain_elga", "plastic_strain_elga"};
  const auto fields = cell_fields(simulation.model(), simulation.state(), output);
  ASSERT_EQ(fields.size(), 3U);
  expect_each(fields[0].parts[0].values, {kirchhoff / std::exp(strain + narrowing), 0, 0, 0, 0, 0}, "stress");
  expect_each(fields[1].parts[0].values, {strain, narrowing, narrowing, 0, 0, 0}, "strain");
  expect_each(fields[2].parts[0].values, {p, -p / 2, -p / 2, 0, 0, 0}, "plastic strain");
}

TEST(PlasticFields, AreUsualWhereAMaterialFlows) {
  const auto has = [](const std::vector<OwnedField>& fields, const std::string& name) {
    return std::ranges::find(fields, name, &OwnedField::name) != fields.end();
  };
  const DrawnBar bar(study::StrainKind::small);
  EXPECT_TRUE(has(bar.at_nodes({}), "cumulated_plastic_strain"));
  EXPECT_FALSE(has(bar.at_nodes({}), "plastic_strain"));
  simulation::Simulation elastic(test::study_of(drawn_bar));
  EXPECT_TRUE(elastic.advance().accepted());
  EXPECT_FALSE(has(nodal_fields(elastic.model(), elastic.state()), "cumulated_plastic_strain"));
  study::FieldOutput named;
  named.only = {"cumulated_plastic_strain", "plastic_strain"};
  const auto zero = nodal_fields(elastic.model(), elastic.state(), named);
  ASSERT_EQ(zero.size(), 2U);
  for (const auto& field : zero)
    EXPECT_TRUE(std::ranges::all_of(field.values, [](double x) { return x == 0; })) << field.name;
}

// ---- probes

/// A strip of two cells whose temperature is that of its place: T = x. The points of its cells are at
/// (1 ± 1/√3)/2 and 1 more.
const std::string warm_strip = R"(
mesh:
  generate: [{name: strip, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [2, 1], cells: quad4, sides: {left: held},
              points: {right_bottom: tip}}]
physics: PHYSICS
materials: {any: {young: 1000, poisson: 0.3, expansion: 1e-5, reference_temperature: 0}}
supports: [{on: held, fix: [x, y]}]
temperature: [{on: all, value: x}]
time: {scheme: static, step: 1, end: 1}
probes:
  least: {on: strip, take: min, field: temperature, place: gauss_points}
  most: {on: all, take: max, field: temperature, place: gauss_points}
  mean: {on: all, take: mean, field: temperature, place: gauss_points}
  coldest: {on: all, take: min, field: temperature, place: cells}
  warmest: {on: all, take: max, field: temperature, place: cells}
  whole: {on: all, take: mean, field: temperature, place: cells}
  near: {point: [1.9, 0.9], field: temperature, place: gauss_points}
  there: {point: [1.9, 0.9], field: temperature, place: cells}
  node: {node: tip, field: temperature}
  drop: {minus: [most, least]}
)";

std::map<std::string, double> probed(const std::string& physics) {
  auto deck = warm_strip;
  deck.replace(deck.find("PHYSICS"), 7, physics);
  simulation::Simulation simulation(test::study_of(deck));
  EXPECT_TRUE(simulation.advance().accepted());
  Values row;
  add_probe_values(simulation.model(), simulation.state(), row);
  const auto columns = probe_columns(simulation.model());
  EXPECT_EQ(columns.size(), row.size());
  std::map<std::string, double> values;
  for (std::size_t i = 0; i < row.size(); ++i)
    values[columns[i]] = row[i];
  return values;
}

TEST(ProbesInCells, TakeExtremesAndMeansOfPointsAndCells) {
  const double before = (1 - 1 / std::sqrt(3.)) / 2;
  const auto values = probed("plane_stress");
  EXPECT_EQ(values.size(), 10U);
  EXPECT_NEAR(values.at("least"), before, 1e-14);
  EXPECT_NEAR(values.at("most"), 2 - before, 1e-14);
  EXPECT_NEAR(values.at("mean"), 1, 1e-14);
  EXPECT_NEAR(values.at("coldest"), 0.5, 1e-14);
  EXPECT_NEAR(values.at("warmest"), 1.5, 1e-14);
  EXPECT_NEAR(values.at("whole"), 1, 1e-14);
  EXPECT_NEAR(values.at("near"), 2 - before, 1e-14);
  EXPECT_NEAR(values.at("there"), 1.5, 1e-14);
  EXPECT_NEAR(values.at("node"), 2, 1e-14);
  EXPECT_NEAR(values.at("drop"), 2 - 2 * before, 1e-14);
}

/// ∫ x · x dx over ∫ x dx.
TEST(ProbesInCells, TakeMeansByTheVolumeOfRings) {
  const auto values = probed("axisymmetric");
  EXPECT_NEAR(values.at("coldest"), (1. / 3) / (1. / 2), 1e-14);
  EXPECT_NEAR(values.at("warmest"), (7. / 3) / (3. / 2), 1e-14);
  EXPECT_NEAR(values.at("mean"), (8. / 3) / 2, 1e-14);
  EXPECT_NEAR(values.at("whole"), (8. / 3) / 2, 1e-14);
}

} // namespace
} // namespace rubato::results::plastic_fields_test
