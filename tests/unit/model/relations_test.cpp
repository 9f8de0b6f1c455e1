// SPDX-License-Identifier: LGPL-3.0-or-later
// What supports along directions and relations leave of the displacements.
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "unit/model/studies.hpp"
#include <cmath>
#include <functional>

namespace rubato::model::relations_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// A block of 2 × 2 × 2 cells on [0, 1]³, its sides and corners named, and what is added to the deck.
std::string deck_of(const std::string& more, const std::string& cells = "hexa8") {
  return R"(mesh:
  generate:
    - {name: cube, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2], cells: )" +
         cells + R"(, sides: {left: left, right: right, bottom: floor, top: roof, back: back, front: front},
       edges: {right_top: ridge}, points: {right_top_back: tip, left_bottom_back: origin}}
physics: solid
materials: {any: {young: 100, poisson: 0.3, density: 1}}
time: {scheme: moreau_jean, step: 1, end: 4}
functions: {ramp: {times: [0, 4], values: [0, 4]}}
)" + more;
}

/// Displacements of unknowns without a pattern, at an instant.
VectorXd some_displacements(const Model& model, double t) {
  VectorXd q(model.reduction.unknown_count());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    q[i] = std::sin(3.0 * static_cast<double>(i) + 1);
  VectorXd u = model.reduction.scatter(q);
  model.reduction.impose(t, u);
  return u;
}

Vector3d at(const Model& model, const VectorXd& u, mesh::NodeIndex node) {
  return u.segment<3>(model.dofs.dof(node, 0));
}

void for_each_node(const Model& model, const std::function<bool(const Vector3d&)>& is_meant,
                   const std::function<void(mesh::NodeIndex, const Vector3d&)>& take) {
  int count = 0;
  for (const auto node : model.dofs.nodes)
    if (const auto& x = model.mesh.points[static_cast<std::size_t>(node)]; is_meant(x)) {
      take(node, x);
      ++count;
    }
  EXPECT_GT(count, 0);
}

std::string told_by(const std::string& deck) {
  try {
    test::located_model(deck);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(ObliqueSupports, HoldNodesAlongADirection) {
  const auto model = test::located_model(
      deck_of("supports: [{on: right, along: [3, 0, 4], value: {value: 0.5, function: ramp}}]"));
  const auto u = some_displacements(model, 2);
  for_each_node(
      model, [](const Vector3d& x) { return x[0] == 1; },
      [&](auto node, const Vector3d&) {
        EXPECT_NEAR(at(model, u, node).dot(Vector3d(0.6, 0, 0.8)), 1, 1e-15);
      });
  EXPECT_EQ(model.reduction.unknown_count(), 81 - 9);
}

TEST(ObliqueSupports, HoldFacesAlongTheirNormals) {
  for (const auto* cells : {"hexa8", "hexa20", "hexa27", "tetra10"}) {
    const auto model =
        test::located_model(deck_of("supports: [{on: roof, along: normal, value: \"x*t\"}]", cells));
    const auto u = some_displacements(model, 3);
    for_each_node(
        model, [](const Vector3d& x) { return x[1] == 1; },
        [&](auto node, const Vector3d& x) { EXPECT_NEAR(at(model, u, node)[1], 3 * x[0], 1e-14); });
  }
}

/// A plane that stands at 45°, and what its faces meet at the edges.
TEST(ObliqueSupports, HoldEdgesAlongTheNormalsOfBothSides) {
  const auto model =
      test::located_model(deck_of("supports: [{on: right, along: normal}, {on: roof, along: normal}]"));
  const auto u = some_displacements(model, 0);
  for_each_node(
      model, [](const Vector3d& x) { return x[0] == 1 && x[1] == 1; },
      [&](auto node, const Vector3d&) {
        EXPECT_NEAR(at(model, u, node)[0], 0, 1e-15);
        EXPECT_NEAR(at(model, u, node)[1], 0, 1e-15);
      });
}

TEST(Relations, KeepAnEquation) {
  const auto model = test::located_model(
      deck_of("relations: {lever: {equation: {terms: [{on: tip, x: 1, y: -2}, {on: origin, z: 4}], value: "
              "{value: 0.5, function: ramp}}}}"));
  const auto u = some_displacements(model, 2);
  const auto tip = at(model, u, model.mesh.node_group("tip")->items.front());
  const auto origin = at(model, u, model.mesh.node_group("origin")->items.front());
  EXPECT_NEAR(tip[0] - 2 * tip[1] + 4 * origin[2], 1, 1e-15);
}

TEST(Relations, KeepAGroupTogetherInTheComponentsThatAreNamed) {
  const auto model = test::located_model(deck_of("relations: {flat: {equal: {on: roof, in: [y, z]}}}"));
  const auto u = some_displacements(model, 0);
  const auto tip = at(model, u, model.mesh.node_group("tip")->items.front());
  bool differs = false;
  for_each_node(
      model, [](const Vector3d& x) { return x[1] == 1; },
      [&](auto node, const Vector3d&) {
        EXPECT_NEAR(at(model, u, node)[1], tip[1], 1e-15);
        EXPECT_NEAR(at(model, u, node)[2], tip[2], 1e-15);
        differs = differs || at(model, u, node)[0] != tip[0];
      });
  EXPECT_TRUE(differs);
}

/// All three pairs of faces: edges and corners have equations that follow from others.
TEST(Relations, PairOppositeFacesNodeByNode) {
  const auto model = test::located_model(deck_of(
      "relations: {x: {pairs: {on: right, with: left, difference: {x: {value: 0.1, function: ramp}}}}, y: "
      "{pairs: {on: roof, with: floor}}, z: {pairs: {on: front, with: back}}}"));
  const auto u = some_displacements(model, 3);
  for_each_node(
      model, [](const Vector3d& x) { return x[0] == 1; },
      [&](auto node, const Vector3d& x) {
        for_each_node(
            model, [&](const Vector3d& other) { return other == Vector3d(0, x[1], x[2]); },
            [&](auto partner, const Vector3d&) {
              EXPECT_LE((at(model, u, node) - at(model, u, partner) - Vector3d(0.3, 0, 0)).norm(), 1e-14);
            });
      });
  EXPECT_EQ(model.reduction.unknown_count(), 8 * 3) << "2 × 2 × 2 nodes are left";
  ASSERT_FALSE(model.notes.empty());
  EXPECT_EQ(model.notes.front(), "relations.y.pairs: 9 of its equations follow from supports and relations "
                                 "before and are left out");
}

/// u = u_ref + θ × (x − x_ref) at every node, by the reference's own motion.
TEST(Relations, MoveRigidGroupsWithTheirReference) {
  for (const auto* more : {"relations: {hub: {rigid: {on: right}}}",
                           "relations: {hub: {rigid: {on: right, at: [2, 0.5, 3]}}}"}) {
    const auto model = test::located_model(deck_of(more));
    EXPECT_EQ(model.reduction.unknown_count(), 81 - 27 + 6);
    const auto& hub = model.references.front();
    const auto u = some_displacements(model, 0);
    const VectorXd motion = hub.motion * VectorXd(u(hub.dofs));
    for_each_node(
        model, [](const Vector3d& x) { return x[0] == 1; },
        [&](auto node, const Vector3d& x) {
          const Vector3d wanted =
              motion.head<3>() + Vector3d(motion.tail<3>()).cross(Vector3d(x - hub.place));
          EXPECT_LE((at(model, u, node) - wanted).norm(), 1e-13);
        });
  }
}

TEST(Relations, HoldAndTurnReferences) {
  for (const auto* kind : {"rigid", "distributed"}) {
    const auto model = test::located_model(deck_of(
        fmt::format("relations: {{hub: {{{}: {{on: right}}}}}}\nsupports: [{{on: hub, fix: [x, y], turn: "
                    "{{z: {{value: 0.01, function: ramp}}, x: 0}}}}]",
                    kind)));
    const auto& hub = model.references.front();
    const auto u = some_displacements(model, 2);
    const VectorXd motion = hub.motion * VectorXd(u(hub.dofs));
    EXPECT_NEAR(motion[0], 0, 1e-15) << kind;
    EXPECT_NEAR(motion[1], 0, 1e-15) << kind;
    EXPECT_NEAR(motion[3], 0, 1e-14) << kind;
    EXPECT_NEAR(motion[5], 0.02, 1e-15) << kind;
    EXPECT_NE(motion[2], 0) << kind;
  }
}

/// Forces and moments on a reference have the resultant that they say.
TEST(Relations, HandForcesAndMomentsOnToTheGroup) {
  const auto model = test::located_model(deck_of("relations: {hub: {distributed: {on: right, at: [1, 0.7, "
                                                 "0.2]}}}\nloads: [{nodal_force: {on: hub, x: 3, y: "
                                                 "-1}}, {moment: {on: hub, x: 2, z: -5}}]"));
  const auto force = external_force(model, 1);
  Vector3d moment = Vector3d::Zero();
  for (const auto node : model.dofs.nodes)
    moment += (model.mesh.points[static_cast<std::size_t>(node)] - Vector3d(1, 0.7, 0.2))
                  .cross(Vector3d(at(model, force, node)));
  EXPECT_LE((test::resultant(model, force) - Vector3d(3, -1, 0)).norm(), 1e-14);
  EXPECT_LE((moment - Vector3d(2, 0, -5)).norm(), 1e-14);
}

TEST(Relations, RefuseWhatCannotHoldTogether) {
  EXPECT_EQ(
      told_by(deck_of("relations: {hub: {rigid: {on: right}}}\nsupports: [{on: right, fix: x}, {on: hub, "
                      "turn: {y: 0.1}}]")),
      "deck.yaml:10:53: supports.1.turn.y contradicts the support of node N3 (1, 0, 0) in x at node N3 (1, "
      "0, "
      "0) in x: -0.1 is left at t = 0; expected relations that can hold together");
}

TEST(Relations, RefuseGroupsThatDoNotMatch) {
  EXPECT_EQ(told_by(deck_of("relations: {p: {pairs: {on: right, with: roof}}}")),
            "deck.yaml:9:42: node N3 (1, 0, 0) of 'right' has no partner in 'roof': shifted by (-0.5, 0.5, "
            "0), from "
            "the mean of one group to that of the other, it is 0.5 from the nearest, N8 (0.5, 1, 0)");
  EXPECT_EQ(told_by(deck_of("relations: {p: {pairs: {on: right, with: ridge}}}")),
            "deck.yaml:9:42: 'ridge' has 3 nodes and 'right' 9, expected as many");
  EXPECT_EQ(told_by(deck_of("relations: {roof: {rigid: {on: right}}}")),
            "deck.yaml:9:19: 'roof' is a name of the mesh already, expected another name for the reference");
  EXPECT_EQ(told_by(deck_of("relations: {e: {equation: {terms: [{on: right, x: 1}]}}}")),
            "deck.yaml:9:41: group 'right' has 9 nodes, expected one; 'equal' and 'pairs' relate groups");
}

TEST(Relations, OfALineTellNoRotation) {
  const std::string line = "relations: {hub: {rigid: {on: ridge}}}\n";
  EXPECT_EQ(test::located_model(deck_of(line)).reduction.unknown_count(), 81 - 9 + 5);
  EXPECT_EQ(told_by(deck_of(line + "loads: [{moment: {on: hub, z: 1}}]")),
            "deck.yaml:10:23: the nodes of 'hub' lie on a line or in a point, which take no moment");
  EXPECT_EQ(
      told_by(deck_of(line + "supports: [{on: hub, turn: {z: 1}}]")),
      "deck.yaml:10:28: the nodes of 'hub' lie on a line or in a point and tell no rotation, expected a "
      "displacement");
}

TEST(Relations, AskForReferencesByTheirNames) {
  const std::string hub = "relations: {hub: {rigid: {on: right}}}\n";
  EXPECT_EQ(told_by(deck_of(hub + "loads: [{moment: {on: hup, z: 1}}]")),
            "deck.yaml:10:23: loads.0.moment.on: found 'hup', which is no reference of a rigid, distributed "
            "or embedded relation; did you mean 'hub'?");
  EXPECT_EQ(told_by(deck_of(hub + "supports: [{on: roof, turn: {z: 1}}]")),
            "deck.yaml:10:29: supports.0.turn: found 'roof', which is no reference of a rigid, distributed "
            "or embedded "
            "relation; "
            "expected one of hub");
  EXPECT_EQ(told_by(deck_of(hub + "probes: {r: {node: tip, field: rotation}}")),
            "deck.yaml:10:20: probes.r.node: found 'tip', which is no reference of a rigid, distributed or "
            "embedded "
            "relation; "
            "expected one of hub");
  EXPECT_EQ(
      told_by(deck_of(hub + "probes: {r: {node: hub, field: stress}}")),
      "deck.yaml:10:32: probes.r.field: found stress, but 'hub' is a reference, which has displacement, "
      "velocity, acceleration and rotation; its group has the others");
}

/// A body is held by its supports and relations together, and bodies that are tied are held together.
TEST(Relations, HoldBodies) {
  const std::string two = R"(mesh:
  generate:
    - {name: a, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [1, 1, 1], cells: hexa8, sides: {left: wall, right: a_end}}
    - {name: b, box: {from: [1, 0, 0], to: [2, 1, 1]}, divisions: [1, 1, 1], cells: hexa8, sides: {left: b_begin, right: b_end}}
physics: solid
materials: {any: {young: 100, poisson: 0.3}}
time: {scheme: static, step: 1, end: 1}
)";
  const std::string glue = "relations: {glue: {pairs: {on: b_begin, with: a_end}}}\n";
  EXPECT_EQ(told_by(two + glue + "supports: [{on: wall, fix: [x, y, z]}]"), "nothing");
  EXPECT_NE(told_by(two + "supports: [{on: wall, fix: [x, y, z]}]"), "nothing");
  EXPECT_NE(told_by(two + glue + "supports: [{on: wall, fix: [x, y]}]"), "nothing");
  const std::string hinge = "relations: {glue: {pairs: {on: b_begin, with: a_end, in: [x, y]}}}\n";
  EXPECT_NE(told_by(two + hinge + "supports: [{on: wall, fix: [x, y, z]}]"), "nothing");
  EXPECT_EQ(told_by(two + hinge + "supports: [{on: wall, fix: [x, y, z]}, {on: b_end, along: [0, 0.1, 1]}]"),
            "nothing");
}

} // namespace
} // namespace rubato::model::relations_test
