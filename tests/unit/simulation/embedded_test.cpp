// SPDX-License-Identifier: LGPL-3.0-or-later
/// Nodes and places that move with the cells they lie in, masses of references, forces and moments out.
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/results/nodal_fields.hpp"
#include "rubato/results/probe_values.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>

namespace rubato::simulation::embedded_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// The column of a probe at the present instant.
double probed(const test::Walk& walk, const std::string& column) {
  const auto columns = results::probe_columns(walk.model);
  std::vector<double> row;
  results::add_probe_values(walk.model, walk.state(), row);
  const auto found = std::ranges::find(columns, column);
  return found == columns.end() ? std::nan("") : row[static_cast<std::size_t>(found - columns.begin())];
}

struct Cells {
  std::string type;
  bool solid;
};

class EmbeddedBody : public testing::TestWithParam<Cells> {};

/// A body within another one, of another mesh, whose displacements are linear.
TEST_P(EmbeddedBody, HasTheLinearDisplacementsOfItsHost) {
  const auto& [type, solid] = GetParam();
  const auto bodies =
      solid ? fmt::format("[{{name: host, box: {{from: [0, 0, 0], to: [2, 1, 1]}}, divisions: [3, 2, 2], "
                          "cells: {0}}}, {{name: inner, box: {{from: [0.35, 0.2, 0.15], to: [1.6, 0.7, "
                          "1]}}, divisions: [2, 2, 1], cells: hexa8}}]",
                          type)
            : fmt::format("[{{name: host, rectangle: {{from: [0, 0], to: [2, 1]}}, divisions: [3, 2], cells: "
                          "{0}}}, {{name: inner, rectangle: {{from: [0.35, 0.2], to: [1.6, 1]}}, divisions: "
                          "[4, 3], cells: quad8}}]",
                          type);
  test::Walk walk(fmt::format(R"(mesh: {{generate: {}}}
physics: {}
materials: {{any: {{young: 1e5, poisson: 0.3}}}}
supports: [{{on: host, x: "1e-3*x + 2e-3*y", y: "3e-3*x - 1e-3*y"{}}}]
relations: {{in: {{embedded: {{on: inner, in: host}}}}, place: {{embedded: {{at: [1.23, 0.45{}], in: host}}}}}}
time: {{scheme: static, step: 1, end: 1}}
probes: {{place: {{node: place}}}}
)",
                              bodies, solid ? "solid" : "plane_strain", solid ? ", z: '2e-3*x + 1e-3*z'" : "",
                              solid ? ", 0.81" : ""));
  ASSERT_TRUE(walk.to_end());
  const auto wanted = [](const Vector3d& x) {
    return Vector3d(1e-3 * x[0] + 2e-3 * x[1], 3e-3 * x[0] - 1e-3 * x[1], 2e-3 * x[0] + 1e-3 * x[2]);
  };
  for (const auto node : walk.model.dofs.nodes)
    for (int i = 0; i < walk.model.dofs.components; ++i)
      EXPECT_NEAR(walk.displacement(node, i),
                  wanted(walk.model.mesh.points[static_cast<std::size_t>(node)])[i], 1e-15);
  EXPECT_NEAR(probed(walk, "place.x"), wanted({1.23, 0.45, 0.81})[0], 1e-15);
  EXPECT_NEAR(probed(walk, "place.y"), wanted({1.23, 0.45, 0.81})[1], 1e-15);
}

INSTANTIATE_TEST_SUITE_P(Cells, EmbeddedBody,
                         testing::Values(Cells{"quad4", false}, Cells{"quad8", false}, Cells{"quad9", false},
                                         Cells{"tria3", false}, Cells{"tria6", false}, Cells{"tria7", false},
                                         Cells{"hexa8", true}, Cells{"hexa20", true}, Cells{"hexa27", true},
                                         Cells{"tetra4", true}, Cells{"tetra10", true}, Cells{"penta6", true},
                                         Cells{"penta15", true}),
                         [](const auto& info) { return info.param.type; });

const std::string beam =
    "{name: beam, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [4, 2], cells: quad8, sides: "
    "{left: clamped, right: end}, points: {right_top: tip}}";

/// On a node, a place has the force of the node; elsewhere supports balance it, moments included.
TEST(EmbeddedPlace, HandsItsForceToTheCell) {
  const auto deck = [](const std::string& relation, const std::string& on) {
    return fmt::format(R"(mesh: {{generate: [{}]}}
physics: plane_stress
materials: {{any: {{young: 1e5, poisson: 0.3}}}}
supports: [{{on: clamped, fix: [x, y]}}]
relations: {{p: {}}}
loads: [{{nodal_force: {{on: {}, x: 3, y: -5}}}}]
time: {{scheme: static, step: 1, end: 1}}
probes: {{root: {{on: clamped, field: reaction}}}}
)",
                       beam, relation, on);
  };
  test::Walk at_node(deck("{embedded: {at: [2, 1]}}", "p"));
  test::Walk on_node(deck("{embedded: {at: [2, 1]}}", "tip"));
  test::Walk inside(deck("{embedded: {at: [1.37, 0.81]}}", "p"));
  for (auto* walk : {&at_node, &on_node, &inside})
    ASSERT_TRUE(walk->to_end());
  EXPECT_LE((at_node.state().motion.u - on_node.state().motion.u).lpNorm<Eigen::Infinity>(),
            1e-14 * on_node.state().motion.u.lpNorm<Eigen::Infinity>());
  EXPECT_NEAR(probed(inside, "root.x"), -3, 1e-10);
  EXPECT_NEAR(probed(inside, "root.y"), 5, 1e-10);
  double moment = 1.37 * -5 - 0.81 * 3;
  for (const auto node : inside.model.dofs.nodes) {
    const auto& x = inside.model.mesh.points[static_cast<std::size_t>(node)];
    const auto dof = inside.model.dofs.dof(node, 0);
    moment += x[0] * inside.state().reaction[dof + 1] - x[1] * inside.state().reaction[dof];
  }
  EXPECT_NEAR(moment, 0, 1e-10);
}

TEST(EmbeddedPlace, IsRefusedWhereItCannotBe) {
  const auto fault = [](const std::string& relations, const std::string& more = "") {
    return test::fault_of([&] {
      test::Walk(fmt::format(
          R"(mesh: {{generate: [{}, {{name: far, rectangle: {{from: [5, 0], to: [6, 1]}}, divisions: [1, 1], sides: {{left: near}}}}]}}
physics: plane_stress
materials: {{any: {{young: 1e5, poisson: 0.3, density: 1}}}}
supports: [{{on: clamped, fix: [x, y]}}, {{on: far, fix: [x, y]}}]
relations: {}
time: {{scheme: hht, alpha: -0.1, step: 1, end: 1}}
{})",
          beam, relations, more));
    });
  };
  EXPECT_NE(fault("{p: {embedded: {at: [3, 0.5]}}}").find("lies in no cell"), std::string::npos);
  EXPECT_NE(fault("{p: {embedded: {on: near, in: beam}}}").find("lies in no cell of group 'beam'"),
            std::string::npos);
  EXPECT_NE(fault("{p: {embedded: {on: near, at: [1, 1]}}}").find("'on' and 'at'"), std::string::npos);
  EXPECT_NE(fault("{p: {embedded: {in: beam}}}").find("missing"), std::string::npos);
  EXPECT_NE(fault("{p: {embedded: {at: [1, 1], in: beem}}}").find("beam"), std::string::npos);
  EXPECT_NE(fault("{p: {embedded: {at: [1, 1]}}}", "loads: [{moment: {on: p, z: 1}}]\n").find("no rotation"),
            std::string::npos);
  EXPECT_NE(fault("{p: {embedded: {at: [1, 1]}}}", "masses: [{on: p, mass: 1, inertia: [1, 1, 1]}]\n")
                .find("no rotation"),
            std::string::npos);
  EXPECT_NE(fault("{p: {embedded: {at: [1, 1]}}}", "masses: [{on: p, mass: 0}]\n").find("above 0"),
            std::string::npos);
  EXPECT_NE(fault("{p: {embedded: {at: [1, 1]}}}", "masses: [{on: tip, mass: 1, inertia: [1, 1, 1]}]\n")
                .find("reference"),
            std::string::npos);
}

/// A rigid block whose reference has nearly all the mass falls and turns by gravity and a moment.
TEST(ReferenceMass, FallsAndTurnsAsARigidBody) {
  for (const std::string scheme :
       {"{scheme: newmark, step: 0.01, end: 0.1}", "{scheme: hht, alpha: -0.1, step: 0.01, end: 0.1}"}) {
    test::Walk walk(fmt::format(
        R"(mesh: {{generate: [{{name: block, box: {{from: [-1, -1, -1], to: [1, 1, 1]}}, divisions: [2, 2, 2]}}]}}
physics: solid
materials: {{light: {{young: 1e5, poisson: 0.3, density: 1e-12}}}}
relations: {{hub: {{rigid: {{on: block}}}}}}
masses: [{{on: hub, mass: 20, inertia: [3, 4, 5]}}]
loads: [{{gravity: {{y: -9.81}}}}, {{moment: {{on: hub, x: 0.3, z: 0.1}}}}]
time: {}
probes: {{fall: {{node: hub}}, turn: {{node: hub, field: rotation}}}}
)",
        scheme));
    ASSERT_TRUE(walk.to_end());
    EXPECT_NEAR(probed(walk, "fall.y"), -9.81 * 0.01 / 2, 1e-12) << scheme;
    EXPECT_NEAR(probed(walk, "turn.x"), 0.3 / 3 * 0.01 / 2, 1e-12) << scheme;
    EXPECT_NEAR(probed(walk, "turn.z"), 0.1 / 5 * 0.01 / 2, 1e-12) << scheme;
    const auto energy = walk.simulation.energy();
    EXPECT_NEAR(energy.kinetic, 0.5 * 20 * std::pow(0.981, 2) + 0.5 * (0.09 / 3 + 0.01 / 5) * 0.01, 1e-8)
        << scheme;
    EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest()) << scheme;
  }
}

struct Faces {
  std::string name;
  std::string bodies;
  std::string physics;
  std::string integration;
  std::string force; ///< on the roof
};

class ContactForces : public testing::TestWithParam<Faces> {};

/// Contact, load and springs hold the upper block in balance: displacements are small beside 1e-9 of its
/// size.
TEST_P(ContactForces, BalanceTheBlockThatTheyHold) {
  const auto& [name, bodies, physics, integration, force] = GetParam();
  const bool solid = physics == "solid";
  test::Walk walk(fmt::format(R"(mesh: {{generate: {}}}
physics: {}
materials: {{any: {{young: 1e9, poisson: 0.3}}}}
supports: [{{on: ground, fix: [x, y{}]}}]
loads: [{{surface_force: {{on: roof, {}}}}}]
contact: {{joint: {{master: table, slave: sole, friction: 0.5, integration: {}}}}}
newton: {{residual: 1e-12}}
time: {{scheme: static, step: 0.5, end: 1}}
probes:
  grip: {{contact: {{zone: joint, about: [0.3, 0.2{}]}}}}
  pushed: {{on: sole, field: contact_force}}
  inside: {{on: up, field: internal_force}}
  one: {{on: sole, field: contact_force, take: max}}
)",
                              bodies, physics, solid ? ", z" : "", force, integration,
                              solid ? ", -0.1" : ""));
  ASSERT_TRUE(walk.to_end());
  const VectorXd load = model::external_force(walk.model, 1);
  Vector3d sum = Vector3d::Zero();
  Vector3d moment = Vector3d::Zero();
  const Vector3d about(0.3, 0.2, solid ? -0.1 : 0);
  for (const auto node : walk.model.dofs.nodes) {
    Vector3d f = Vector3d::Zero();
    f.head(walk.model.dofs.components) =
        load.segment(walk.model.dofs.dof(node, 0), walk.model.dofs.components);
    sum += f;
    moment += (walk.model.mesh.points[static_cast<std::size_t>(node)] - about).cross(f);
  }
  const double size = sum.norm();
  for (int i = 0; i < walk.model.dofs.components; ++i) {
    const auto axis = std::string(1, "xyz"[i]);
    EXPECT_NEAR(probed(walk, "grip." + axis), -sum[i], 1e-8 * size);
    EXPECT_NEAR(probed(walk, "pushed." + axis), -sum[i], 1e-8 * size);
    EXPECT_NEAR(probed(walk, "inside." + axis), 0, 1e-8 * size) << "forces of a body on itself";
    if (solid)
      EXPECT_NEAR(probed(walk, "grip.m" + axis), -moment[i], 1e-7 * size);
  }
  EXPECT_NEAR(probed(walk, "grip.mz"), -moment[2], 1e-7 * size);
  EXPECT_GT(probed(walk, "one.y"), 0);
  // Node by node: what cells resist with is load, contact and reaction together.
  const VectorXd rest = results::internal_force(walk.model, walk.state()) - load -
                        results::contact_force(walk.model, walk.state()) - walk.state().reaction;
  EXPECT_LE(rest.lpNorm<Eigen::Infinity>(), 1e-10 * size);
}

std::string flat(const std::string& cells) {
  return fmt::format("[{{name: low, rectangle: {{from: [0, -1], to: [4, 0]}}, divisions: [6, 2], cells: {0}, "
                     "sides: {{bottom: "
                     "ground, top: table}}}}, {{name: up, rectangle: {{from: [1, 0], to: [3, 1]}}, "
                     "divisions: [4, 2], cells: "
                     "{0}, sides: {{bottom: sole, top: roof}}}}]",
                     cells);
}

std::string deep(const std::string& cells) {
  return fmt::format(
      "[{{name: low, box: {{from: [0, -1, -1], to: [4, 0, 2]}}, divisions: [4, 1, 3], cells: {0}, sides: "
      "{{bottom: ground, top: table}}}}, {{name: up, box: {{from: [1, 0, 0], to: [3, 1, 1]}}, divisions: [3, "
      "1, 2], cells: {0}, sides: {{bottom: sole, top: roof}}}}]",
      cells);
}

INSTANTIATE_TEST_SUITE_P(
    Zones, ContactForces,
    testing::Values(Faces{"Quad4Nodes", flat("quad4"), "plane_strain", "nodes", "y: '-x', x: 0.1"},
                    Faces{"Quad4Mortar", flat("quad4"), "plane_strain", "mortar", "y: '-x', x: 0.1"},
                    Faces{"Quad8Mortar", flat("quad8"), "plane_strain", "mortar", "y: '-x', x: 0.1"},
                    Faces{"Hexa8Mortar", deep("hexa8"), "solid", "mortar", "y: '-x-z', x: 0.1"},
                    Faces{"Hexa20Mortar", deep("hexa20"), "solid", "mortar", "y: '-x-z', x: 0.1"},
                    Faces{"Tetra10Mortar", deep("tetra10"), "solid", "mortar", "y: '-x-z', x: 0.1"}),
    [](const auto& info) { return info.param.name; });

TEST(ContactForces, AreRefusedOfAZoneThatThereIsNot) {
  const auto text = test::fault_of([] {
    test::Walk(fmt::format(
        "mesh: {{generate: {}}}\nphysics: plane_strain\nmaterials: {{any: {{young: 1, poisson: "
        "0}}}}\nsupports: [{{on: ground, fix: [x, y]}}]\ncontact: {{joint: {{master: table, slave: sole}}}}\n"
        "time: {{scheme: static, step: 1, end: 1}}\nprobes: {{p: {{contact: {{zone: joined, about: [0, "
        "0]}}}}}}\n",
        flat("quad4")));
  });
  EXPECT_NE(text.find("did you mean 'joint'"), std::string::npos) << text;
}

} // namespace
} // namespace rubato::simulation::embedded_test
