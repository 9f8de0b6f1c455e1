// SPDX-License-Identifier: LGPL-3.0-or-later
// What a study becomes: unknowns, matrices, loads, zones.
#include "rubato/contact/zone.hpp"
#include "rubato/material/linear_elastic.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/model/sparse_matrix.hpp"

#include <gtest/gtest.h>

#include "studies.hpp"
#include <numbers>

namespace rubato::model::build_test {
namespace {

using Eigen::Vector3d;
using test::box_deck;
using test::located_model;
using test::resultant;
using test::two_blocks;
using test::with;

/// The load's resultant over the box, and the one wanted.
void expect_resultant(const std::string& loads, const Vector3d& wanted, double t = 0) {
  const auto model = located_model(box_deck + loads);
  const Vector3d sum = resultant(model, external_force(model, t));
  EXPECT_LE((sum - wanted).norm(), 1e-12 * wanted.norm()) << sum.transpose() << "; " << loads;
}

TEST(Model, NumbersWhatIsFreeAndWhatIsPrescribed) {
  const auto model = located_model(box_deck);
  EXPECT_EQ(model.dofs.dof_count, 3 * 18);
  const auto& reduction = model.reduction;
  EXPECT_EQ(reduction.prescribed().size(), 3U * 6U);
  EXPECT_EQ(reduction.free_dofs().size(), 3U * 12U);
  for (std::size_t i = 0; i < reduction.free_dofs().size(); ++i)
    EXPECT_EQ(reduction.unknown_of(reduction.free_dofs()[i]), static_cast<int>(i));
  for (const auto& support : reduction.prescribed()) {
    EXPECT_EQ(reduction.unknown_of(support.dof), -1);
    EXPECT_EQ(model.mesh.points[static_cast<std::size_t>(model.node_of(support.dof))][0], 0.0);
  }
}

TEST(Model, PrescribesDisplacementsByTheirFunctionOfTime) {
  const auto model = located_model(with(box_deck, "supports:\n",
                                        "functions: {ramp: {times: [0, 2], values: [0, 1]}}\nsupports:\n"
                                        "  - {on: end, x: {value: 0.1, function: ramp}}\n"));
  ASSERT_EQ(model.reduction.prescribed().size(), 3U * 6U + 6U);
  const auto imposed = model.reduction.imposed(1.0);
  for (int dof = 0; dof < model.dofs.dof_count; ++dof) {
    const bool at_end = model.mesh.points[static_cast<std::size_t>(model.node_of(dof))][0] == 2.0;
    EXPECT_DOUBLE_EQ(imposed[dof], at_end && model.reduction.is_prescribed(dof) ? 0.05 : 0.0);
  }
}

TEST(Model, AppliesTheTotalOfEachLoad) {
  expect_resultant("loads: [{nodal_force: {on: N1, z: 3}}]\n", {0, 0, 3});
  expect_resultant("loads: [{line_force: {on: ridge, x: 10, z: 4}}]\n", {5, 0, 2});
  expect_resultant("loads: [{surface_force: {on: roof, y: -3}}]\n", {0, -3, 0});
  expect_resultant("loads: [{pressure: {on: end, value: 7}}]\n", {-3.5, 0, 0});
  expect_resultant("loads: [{gravity: {y: -9.81}}]\n", {0, -9.81 * 7800, 0});
  expect_resultant("loads: [{gravity: {on: box, y: -9.81}}, {surface_force: {on: roof, x: 2}}]\n",
                   {2, -9.81 * 7800, 0});
  expect_resultant("functions: {pulse: {times: [0, 1], values: [1, 0]}}\n"
                   "loads: [{pressure: {on: end, value: 8, function: pulse}}]\n",
                   {-1, 0, 0}, 0.75);
}

TEST(Model, WeighsOnlyTheGroupThatGravityIsOn) {
  const auto model = located_model(
      with(two_blocks, "  - nodal_force: {on: tip, y: -1e7}", "  - gravity: {on: upper, y: -10}"));
  EXPECT_NEAR(resultant(model, external_force(model, 0))[1], -10 * 7800 * 0.2, 1e-9);
}

TEST(Model, TakesThicknessIntoMassStiffnessAndLoads) {
  const auto load = with(two_blocks, "nodal_force: {on: tip, y: -1e7}", "pressure: {on: roof, value: 3}");
  for (const double thickness : {1.0, 0.25}) {
    const auto model = located_model(with(load, "thickness: 1", "thickness: " + std::to_string(thickness)));
    EXPECT_NEAR(model.mass.sum(), 2 * 7800 * 0.4 * thickness, 1e-9);
    EXPECT_NEAR(resultant(model, external_force(model, 0))[1], -3 * thickness, 1e-12);
  }
}

/// Reaction per unit strain in x of one square held so that it cannot contract in z (plane strain) or can.
double stiffness_against_stretching(const std::string& physics) {
  const auto model = located_model(
      "mesh: {generate: [{name: body, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [1, 1]}]}\n"
      "physics: " +
      physics +
      "\n"
      "materials: {steel: {young: 1000, poisson: 0.25, cells: all}}\n"
      "supports: [{on: body, fix: [x, y]}]\n"
      "time: {scheme: static, step: 1, end: 1}\n");
  Eigen::VectorXd stretched = Eigen::VectorXd::Zero(model.dofs.dof_count);
  for (const auto node : model.dofs.nodes)
    stretched[model.dofs.dof(node, 0)] = model.mesh.points[static_cast<std::size_t>(node)][0];
  return stretched.dot(model.domain.initial_tangent() * stretched);
}

TEST(Model, TellsPlaneStrainFromPlaneStress) {
  EXPECT_NEAR(stiffness_against_stretching("plane_stress"), 1000 / (1 - 0.0625), 1e-9);
  EXPECT_NEAR(stiffness_against_stretching("plane_strain"), 1000 * 0.75 / (1.25 * 0.5), 1e-9);
}

TEST(Model, GivesTheRingOfAnAxisymmetricBodyItsWholeMass) {
  const auto model = located_model(
      "mesh: {generate: [{name: body, rectangle: {from: [1, 0], to: [3, 2]}, divisions: [2, 2]}]}\n"
      "physics: axisymmetric\n"
      "materials: {steel: {young: 1000, poisson: 0.25, density: 2, cells: all}}\n"
      "supports: [{on: N1, fix: [x, y]}]\n"
      "time: {scheme: newmark, step: 1, end: 1}\n");
  EXPECT_NEAR(model.mass.sum() / 2, 2 * std::numbers::pi * (9 - 1) * 2, 1e-9);
}

TEST(Model, KeepsTheMaterialsOfDifferentBodiesApart) {
  const auto model =
      located_model(with(two_blocks, "cells: all}",
                         "cells: upper}\n  foam: {young: 1e6, poisson: 0, density: 10, cells: lower}"));
  EXPECT_NEAR(model.mass.sum(), 2 * (7800 + 10) * 0.2, 1e-9);
  ASSERT_EQ(model.bulk.cells.size(), 16U);
  const auto& lower = model.mesh.cell_group("lower")->items;
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i)
    EXPECT_EQ(std::get<material::LinearElastic>(model.bulk.law(i)).young,
              std::ranges::binary_search(lower, model.bulk.cells[i]) ? 1e6 : 200e9);
}

TEST(Model, DampsByEachMaterialsOwnCoefficients) {
  const auto model =
      located_model(with(box_deck, "density: 7800", "density: 7800, rayleigh: {stiffness: 2e-3, mass: 5}"));
  const SparseMatrix wanted = 2e-3 * model.domain.initial_tangent() + 5 * model.mass;
  EXPECT_LE((model.damping - wanted).norm(), 1e-12 * wanted.norm());
  EXPECT_EQ(located_model(box_deck).damping.nonZeros(), 0);
}

TEST(Model, AddsItsSpringsToTheStiffness) {
  const auto free = located_model(box_deck);
  const auto sprung = located_model(box_deck + "springs: [{on: end, x: 3, z: 5}, {on: ridge, z: 2}]\n");
  const SparseMatrix added = sprung.domain.initial_tangent() - free.domain.initial_tangent();
  EXPECT_NEAR(added.sum(), 6 * (3 + 5) + 2 * 2, 1e-3); // rounding of a stiffness of 1e11
  for (const auto& spring : sprung.springs)
    EXPECT_EQ(sprung.mesh.points[static_cast<std::size_t>(sprung.node_of(spring.dof))].x(), 2.0);
}

TEST(Model, BeginsAsTheDeckSaysAndElsewhereAtRest) {
  const auto free = with(two_blocks, "{left: held, top: lower_face}", "{top: lower_face}");
  const auto model =
      located_model(with(free, "contact:\n",
                         "initial:\n"
                         "  - {on: lower, velocity: {y: 3}}\n"
                         "  - {on: tip, displacement: {x: 1e-3, y: 0}, velocity: {x: 2}}\ncontact:\n"));
  const auto tip = model.probe_nodes.at(0).front();
  EXPECT_EQ(model.initial.displacement[model.dofs.dof(tip, 0)], 1e-3);
  EXPECT_EQ(model.initial.velocity[model.dofs.dof(tip, 0)], 2);
  EXPECT_EQ(model.initial.displacement.sum(), 1e-3);
  EXPECT_EQ(model.initial.velocity.sum(), 2 + 15 * 3);
}

TEST(Model, NumbersTheMultipliersOfItsZonesOneAfterAnother) {
  const auto model = located_model(
      with(two_blocks, "exclude_nodes: [held]}",
           "exclude_nodes: [held]}\n  second: {master: lower_face, slave: upper_face, integration: nodes}"));
  ASSERT_EQ(model.zones.size(), 2U);
  EXPECT_EQ(model.zones[0].multiplier_count(), 10);
  EXPECT_EQ(model.zones[1].multiplier_count(), 5);
  EXPECT_EQ(model.multiplier_offsets, (std::vector<int>{0, 10}));
  EXPECT_EQ(model.multiplier_count, 15);
}

TEST(Model, ExcludesTheNamedNodesFromContact) {
  const auto model = located_model(two_blocks);
  EXPECT_EQ(std::ranges::count_if(model.zones.at(0).points, &contact::SlavePoint::excluded), 1);
}

TEST(Model, FindsTheNodesOfItsProbes) {
  const auto model = located_model(
      with(two_blocks, "  end: {node: tip}", "  end: {node: tip}\n  near: {point: [0.9, 0.21]}"));
  ASSERT_EQ(model.probe_nodes.size(), 2U);
  EXPECT_EQ(model.probe_nodes[0], model.probe_nodes[1]);
  EXPECT_EQ(model.mesh.points[static_cast<std::size_t>(model.probe_nodes[0].front())], Vector3d(1, 0.2, 0));
}

} // namespace
} // namespace rubato::model::build_test
