// SPDX-License-Identifier: LGPL-3.0-or-later
// Explicit motion of tied bodies: waves, forces, balances.
#include "rubato/constraint/reduction.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::explicit_ties_test {
namespace {

using deck::Setting;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// What bars have beside their mesh: the speed of waves along them is 10.
const std::string material_and_kick = R"(
materials: {steel: {young: 100, poisson: 0.3, density: 1}}
functions: {kick: {times: [0, 0.1, 0.2], values: [0, 1, 0]}}
supports: [{on: ground, fix: all}]
loads: [{surface_force: {on: tip, x: 1, y: 0.5, function: kick}}]
time: {scheme: central_difference, end: 0.6, record: 0.6}
)";

std::string flat(const std::string& name, double from, double to, int along, int across,
                 const std::string& cells, const std::string& sides) {
  return fmt::format(
      "    - {{name: {}, rectangle: {{from: [{}, 0], to: [{}, 1]}}, divisions: [{}, {}], cells: {}, "
      "sides: {{{}}}}}\n",
      name, from, to, along, across, cells, sides);
}

std::string solid(const std::string& name, double from, double to, int along, int across,
                  const std::string& cells, const std::string& sides) {
  return fmt::format(
      "    - {{name: {}, box: {{from: [{}, 0, 0], to: [{}, 1, 1]}}, divisions: [{}, {}, {}], cells: "
      "{}, sides: {{{}}}}}\n",
      name, from, to, along, across, across, cells, sides);
}

using Body = std::string (*)(const std::string&, double, double, int, int, const std::string&,
                             const std::string&);

std::string deck_of(Body body, const std::string& bodies, const std::string& more) {
  auto rest = material_and_kick;
  rest.replace(rest.find("all"), 3, body == flat ? "[x, y]" : "[x, y, z]");
  return "mesh:\n  generate:\n" + bodies + "physics: " + (body == flat ? "plane_strain" : "solid") + rest +
         more;
}

/// A bar of length 4 in one piece; `fine` cells across.
std::string whole_bar(Body body, const std::string& cells, int fine) {
  return deck_of(body, body("bar", 0, 4, 8 * fine, 2 * fine, cells, "left: ground, right: tip"), "");
}

/// Two halves, the second with so many cells across.
std::string tied_bar(Body body, const std::string& cells, int fine, int across) {
  return deck_of(body,
                 body("foot", 0, 2, 4 * fine, 2 * fine, cells, "left: ground, right: seam") +
                     body("head", 2, 4, 2 * across, across, cells, "left: joint, right: tip"),
                 "contact: {tie: {master: seam, slave: joint, tie: true}}\n");
}

void go(ExplicitMotion& motion, double end, int least = 1) {
  const int steps = static_cast<int>(std::ceil((end - motion.t()) / (0.9 * motion.spectrum().stable_step())));
  motion.advance(end, std::max(steps, least));
}

/// Where node stands in the other model.
mesh::NodeIndex twin(const test::ModelParts& one, mesh::NodeIndex node, const test::ModelParts& other) {
  const auto& x = one.mesh.points[static_cast<std::size_t>(node)];
  return *std::ranges::min_element(other.dofs.nodes, {}, [&](auto candidate) {
    return (other.mesh.points[static_cast<std::size_t>(candidate)] - x).norm();
  });
}

double largest_difference(const test::ModelParts& one, const VectorXd& u, const test::ModelParts& other,
                          const VectorXd& v) {
  double most = 0;
  for (const auto node : one.dofs.nodes)
    for (int c = 0; c < one.dofs.components; ++c)
      most =
          std::max(most, std::abs(u[one.dofs.dof(node, c)] - v[other.dofs.dof(twin(one, node, other), c)]));
  return most;
}

struct Bar {
  std::string name;
  Body body;
  std::string cells;
  int fine;
};

class TiedBars : public testing::TestWithParam<Bar> {};

TEST_P(TiedBars, MoveAsOneMeshWhereTheirMeshesMatch) {
  const auto& bar = GetParam();
  const auto tied = test::model_of(tied_bar(bar.body, bar.cells, bar.fine, 2 * bar.fine));
  const auto whole = test::model_of(whole_bar(bar.body, bar.cells, bar.fine));
  ExplicitMotion a(tied);
  ExplicitMotion b(whole);
  const int steps = static_cast<int>(std::ceil(0.6 / (0.9 * b.spectrum().stable_step())));
  a.advance(0.6, steps);
  b.advance(0.6, steps);
  const auto u = a.state().motion.u;
  const auto expected = b.state().motion.u;
  EXPECT_GT(expected.lpNorm<Eigen::Infinity>(), 1e-3);
  EXPECT_LT(largest_difference(tied, u, whole, expected), 1e-11 * expected.lpNorm<Eigen::Infinity>());
  EXPECT_NEAR(a.spectrum().stiffness, b.spectrum().stiffness, 0.011 * b.spectrum().stiffness);
}

TEST_P(TiedBars, CloseTheirEnergyAndKeepTheirTieOnMeshesThatDoNotMatch) {
  const auto& bar = GetParam();
  const auto tied = test::model_of(tied_bar(bar.body, bar.cells, bar.fine, 2 * bar.fine + 1));
  ExplicitMotion motion(tied);
  for (int part = 1; part <= 6; ++part) {
    go(motion, 0.1 * part);
    const auto energy = motion.energy();
    EXPECT_LT(std::abs(energy.balance()), 1e-12 * energy.largest());
    const auto u = motion.state().motion.u;
    const VectorXd kept = u + tied.reduction.correction(motion.t(), u);
    EXPECT_LT((kept - u).lpNorm<Eigen::Infinity>(), 1e-15 * u.lpNorm<Eigen::Infinity>());
  }
  EXPECT_EQ(motion.energy().support_work, 0);
}

INSTANTIATE_TEST_SUITE_P(Cells, TiedBars,
                         testing::Values(Bar{"Quad4", flat, "quad4", 2}, Bar{"Tria3", flat, "tria3", 2},
                                         Bar{"Quad8", flat, "quad8", 1}, Bar{"Hexa8", solid, "hexa8", 1},
                                         Bar{"Tetra4", solid, "tetra4", 1},
                                         Bar{"Hexa20", solid, "hexa20", 1}),
                         [](const auto& of) { return of.param.name; });

/// The mean displacement of the tip along the bar.
double tip(const test::ModelParts& model, const VectorXd& u) {
  double sum = 0;
  int count = 0;
  for (const auto node : model.dofs.nodes)
    if (std::abs(model.mesh.points[static_cast<std::size_t>(node)][0] - 4) < 1e-9) {
      sum += u[model.dofs.dof(node, 0)];
      ++count;
    }
  return sum / count;
}

/// At twelve instants.
VectorXd tip_history(const std::string& deck) {
  const auto model = test::model_of(deck);
  ExplicitMotion motion(model);
  VectorXd history(12);
  for (int i = 0; i < 12; ++i) {
    go(motion, 0.05 * (i + 1));
    history[i] = tip(model, motion.state().motion.u);
  }
  return history;
}

/// Meshes that do not match come to the motion of one mesh as both are refined.
TEST(TiedBar, ConvergesToTheBarOfOneMesh) {
  for (const auto body : {flat, solid}) {
    const auto cells = body == flat ? "quad4" : "hexa8";
    const auto whole = tip_history(whole_bar(body, cells, body == flat ? 8 : 4));
    std::vector<double> differences;
    for (const int fine : {1, 2})
      differences.push_back((tip_history(tied_bar(body, cells, fine, 3 * fine)) - whole).norm() /
                            whole.norm());
    RecordProperty(cells, fmt::format("{:.3g} {:.3g}", differences[0], differences[1]));
    EXPECT_LT(differences[1], 0.5 * differences[0]) << cells;
    EXPECT_LT(differences[1], 0.02) << cells;
  }
}

/// What is between explicit steps and Newmark's of the same length, which has consistent masses and ties by
/// multipliers: relative, at twelve instants of the tip.
double distance_from_newmark(const std::string& deck) {
  const auto model = test::model_of(deck);
  ExplicitMotion motion(model);
  const int steps = static_cast<int>(std::ceil(0.05 / (0.9 * motion.spectrum().stable_step())));
  test::Walk walk(
      deck,
      {{"time.scheme", "newmark"}, {"time.record", ""}, {"time.step", fmt::format("{:.17g}", 0.05 / steps)}});
  VectorXd ours(12);
  VectorXd expected(12);
  for (int i = 0; i < 12; ++i) {
    motion.advance(0.05 * (i + 1), steps);
    ours[i] = tip(model, motion.state().motion.u);
    for (int k = 0; k < steps; ++k)
      EXPECT_TRUE(walk.advance());
    expected[i] = tip(walk.model, walk.state().motion.u);
  }
  return (ours - expected).norm() / expected.norm();
}

/// It falls with the mesh, as it does without a tie.
TEST(TiedBar, MovesAsByImplicitStepsOfTheSameLength) {
  for (const auto body : {flat, solid}) {
    const auto cells = body == flat ? "quad4" : "hexa8";
    std::vector<double> tied;
    std::vector<double> whole;
    for (const int fine : {1, 2}) {
      tied.push_back(distance_from_newmark(tied_bar(body, cells, fine, 3 * fine)));
      whole.push_back(distance_from_newmark(whole_bar(body, cells, fine)));
    }
    RecordProperty(
        cells, fmt::format("tied {:.3g} {:.3g} whole {:.3g} {:.3g}", tied[0], tied[1], whole[0], whole[1]));
    EXPECT_LT(tied[1], 0.5 * tied[0]) << cells;
    EXPECT_LT(tied[1], whole[1]) << cells;
  }
}

/// No force from outside: the momentum of two bodies of different speeds stays what it is, and so does the
/// moment of momentum about the axis across, but for the arms that change.
TEST(TiedBar, KeepsItsMomentum) {
  const std::vector<Setting> free{
      {"supports", ""}, {"loads", ""}, {"initial", "[{on: tip, velocity: {x: 1, y: -2}}]"}};
  for (const auto body : {flat, solid}) {
    const auto model = test::model_of(tied_bar(body, body == flat ? "quad4" : "hexa8", 1, 3), free);
    ExplicitMotion motion(model);
    const auto momentum = [&] {
      Vector3d sum = Vector3d::Zero();
      const auto v = motion.state().motion.v;
      for (const auto node : model.dofs.nodes)
        for (int c = 0; c < model.dofs.components; ++c)
          sum[c] += model.lumped_mass[model.dofs.dof(node, c)] * v[model.dofs.dof(node, c)];
      return sum;
    };
    const auto before = momentum();
    ASSERT_GT(before.norm(), 0.01);
    go(motion, 0.6);
    EXPECT_LT((momentum() - before).norm(), 1e-13 * before.norm());
    EXPECT_LT(std::abs(motion.energy().balance()), 1e-12 * motion.energy().largest());
  }
}

/// What the tie carries is what moves the head: its resultant is the change of the head's momentum less the
/// load, and no part of it is a reaction.
TEST(TiedBar, ShowsTheForceOfItsTie) {
  for (const auto body : {flat, solid}) {
    const auto model = test::model_of(tied_bar(body, body == flat ? "quad4" : "hexa8", 1, 3),
                                      {{"functions.kick", "{times: [0, 1], values: [1, 1]}"}});
    ExplicitMotion motion(model);
    go(motion, 0.3);
    const auto state = motion.state();
    Vector3d inertia = Vector3d::Zero();
    Vector3d reacting = Vector3d::Zero();
    for (const auto node : model.dofs.nodes)
      for (int c = 0; c < model.dofs.components; ++c) {
        const int dof = model.dofs.dof(node, c);
        const double x = model.mesh.points[static_cast<std::size_t>(node)][0];
        const bool is_head = x >= 2 - 1e-9 && std::ranges::find(model.zones.front().master.nodes, node) ==
                                                  model.zones.front().master.nodes.end();
        inertia[c] += is_head ? model.lumped_mass[dof] * state.motion.a[dof] : 0.0;
        reacting[c] += x > 1e-9 ? std::abs(state.reaction[dof]) : 0.0;
      }
    Vector3d tied = Vector3d::Zero();
    Vector3d of_multipliers = Vector3d::Zero();
    const auto& zone = model.zones.front();
    for (std::size_t i = 0; i < zone.points.size(); ++i) {
      const auto& outcome = state.zones.front().outcomes[i];
      tied += outcome.normal + outcome.tangential;
      for (int c = 0; c < model.dofs.components; ++c)
        of_multipliers[c] +=
            outcome.area *
            state.zones.front().multipliers[static_cast<Eigen::Index>(i) * model.dofs.components + c];
    }
    EXPECT_LT((of_multipliers - tied).norm(), 1e-12);
    const Vector3d load(1, 0.5, 0);
    EXPECT_GT(tied.norm(), 0.1);
    EXPECT_LT((tied + load - inertia).norm(), 1e-12 * load.norm());
    EXPECT_LT(reacting.norm(), 1e-12);
    EXPECT_GT(motion.points_in_contact(), 2);
  }
}

/// Forces of their cells, which have no stiffness of the whole.
TEST(TiedBar, MovesAsOneMeshBeyondLinearElasticity) {
  const std::vector<std::vector<Setting>> materials{
      {{"materials.steel.strain", "green_lagrange"}},
      {{"materials.steel.law", "plastic"},
       {"materials.steel.strain", "logarithmic"},
       {"materials.steel.hardening", "{linear: {yield_stress: 0.3, modulus: 10}}"}}};
  for (const auto& changes : materials)
    for (const auto body : {flat, solid}) {
      const auto cells = body == flat ? "quad4" : "hexa8";
      const auto tied = test::model_of(tied_bar(body, cells, 1, 2), changes);
      const auto whole = test::model_of(whole_bar(body, cells, 1), changes);
      ExplicitMotion a(tied);
      ExplicitMotion b(whole);
      const int steps = static_cast<int>(std::ceil(0.6 / (0.8 * b.spectrum().stable_step())));
      a.advance(0.6, steps);
      b.advance(0.6, steps);
      const auto expected = b.state().motion.u;
      EXPECT_LT(largest_difference(tied, a.state().motion.u, whole, expected),
                1e-10 * expected.lpNorm<Eigen::Infinity>());
      EXPECT_NEAR(a.spectrum().stiffness, b.spectrum().stiffness, 0.011 * b.spectrum().stiffness);
      EXPECT_LT(std::abs(a.energy().balance()), 1e-11 * a.energy().largest());
    }
}

/// A plate over both halves of a bar: nodes of its sole are in two ties, and face nodes of a third one.
TEST(TiedBar, HoldsWhereTiesMeet) {
  for (const char* integration : {"mortar", "nodes"}) {
    const auto tie = [&](const std::string& master, const std::string& slave) {
      return fmt::format("{{master: {}, slave: {}, tie: true, integration: {}}}", master, slave, integration);
    };
    const auto deck =
        deck_of(flat,
                flat("foot", 0, 2, 4, 2, "quad4", "left: ground, right: seam, top: low_foot") +
                    flat("head", 2, 4, 6, 3, "quad4", "left: joint, right: tip, top: low_head") +
                    "    - {name: plate, rectangle: {from: [0.5, 1], to: [3.5, 1.4]}, divisions: [7, 1], "
                    "cells: quad4, "
                    "sides: {bottom: sole}}\n",
                "contact: {a: " + tie("seam", "joint") + ", b: " + tie("low_foot", "sole") +
                    ", c: " + tie("low_head", "sole") + "}\n");
    const auto model = test::model_of(deck);
    ExplicitMotion motion(model);
    go(motion, 0.6);
    const auto u = motion.state().motion.u;
    EXPECT_GT(u.lpNorm<Eigen::Infinity>(), 1e-3);
    EXPECT_LT(model.reduction.correction(0.6, u).lpNorm<Eigen::Infinity>(),
              1e-15 * u.lpNorm<Eigen::Infinity>());
    EXPECT_LT(std::abs(motion.energy().balance()), 1e-12 * motion.energy().largest()) << integration;
  }
}

TEST(TiedBar, OfRingsIsAsOneMesh) {
  const auto rings = [](const std::string& bodies, const std::string& more) {
    return "mesh:\n  generate:\n" + bodies + R"(physics: axisymmetric
materials: {steel: {young: 100, poisson: 0.3, density: 1}}
functions: {kick: {times: [0, 0.1, 0.2], values: [0, 1, 0]}}
supports: [{on: ground, fix: y}]
loads: [{surface_force: {on: tip, y: 1, x: 0.3, function: kick}}]
time: {scheme: central_difference, end: 0.6, record: 0.6}
)" + more;
  };
  const auto tied = test::model_of(rings("    - {name: low, rectangle: {from: [0, 0], to: [1, 1]}, "
                                         "divisions: [3, 3], sides: {bottom: ground, top: "
                                         "seam}}\n"
                                         "    - {name: high, rectangle: {from: [0, 1], to: [1, 2]}, "
                                         "divisions: [3, 3], sides: {bottom: joint, top: "
                                         "tip}}\n",
                                         "contact: {tie: {master: seam, slave: joint, tie: true}}\n"));
  const auto whole =
      test::model_of(rings("    - {name: all, rectangle: {from: [0, 0], to: [1, 2]}, divisions: [3, 6], "
                           "sides: {bottom: ground, top: tip}}\n",
                           ""));
  ExplicitMotion a(tied);
  ExplicitMotion b(whole);
  const int steps = static_cast<int>(std::ceil(0.6 / (0.9 * b.spectrum().stable_step())));
  a.advance(0.6, steps);
  b.advance(0.6, steps);
  const auto expected = b.state().motion.u;
  EXPECT_LT(largest_difference(tied, a.state().motion.u, whole, expected),
            1e-11 * expected.lpNorm<Eigen::Infinity>());
}

/// A step of the length that it gives is stable, and hardly a longer one is; ties never shorten it.
TEST(TiedBar, StaysBoundedAtItsStableStepAndNotBeyond) {
  const auto model = test::model_of(tied_bar(flat, "quad4", 1, 3));
  for (const double factor : {1.0, 1.02}) {
    ExplicitMotion motion(model);
    const double h = factor * motion.spectrum().stable_step();
    motion.advance(4000 * h, 4000);
    EXPECT_EQ(motion.state().motion.u.lpNorm<Eigen::Infinity>() < 10, factor == 1.0) << factor;
  }
}

/// Nodes of the seam lie on a table, too.
TEST(TiedBar, RubsOverATableWithNodesOfItsTie) {
  auto deck =
      deck_of(flat,
              flat("foot", 0, 2, 4, 2, "quad4", "left: ground, right: seam, bottom: sole_a") +
                  flat("head", 2, 4, 6, 3, "quad4", "left: joint, right: tip, bottom: sole_b"),
              "contact:\n  tie: {master: seam, slave: joint, tie: true}\n"
              "  a: {obstacle: {plane: {point: [0, -0.001], normal: [0, 1]}}, slave: sole_a, friction: 0.3, "
              "method: penalty, integration: nodes}\n"
              "  b: {obstacle: {plane: {point: [0, -0.001], normal: [0, 1]}}, slave: sole_b, friction: 0.3, "
              "method: penalty, integration: nodes}\n");
  const auto model =
      test::model_of(deck, {{"loads.0.surface_force.y", "-3"}, {"loads.0.surface_force.x", "5"}});
  ExplicitMotion motion(model);
  for (int part = 1; part <= 6; ++part)
    go(motion, 0.1 * part);
  const auto energy = motion.energy();
  EXPECT_GT(energy.friction, 0);
  EXPECT_LT(std::abs(energy.balance()), 1e-12 * energy.largest());
  EXPECT_LT(std::abs(energy.impact), 1e-2 * energy.largest());
}

TEST(TiedBar, GoesOnFromItsMemoryToTheLastBit) {
  const auto model = test::model_of(tied_bar(solid, "hexa8", 1, 3));
  ExplicitMotion motion(model);
  go(motion, 0.2);
  const auto start = motion.memory();
  go(motion, 0.6);
  ExplicitMotion resumed(model);
  resumed.restore(start);
  go(resumed, 0.6);
  EXPECT_EQ(resumed.state().motion.u, motion.state().motion.u);
  EXPECT_EQ(resumed.state().contact_force, motion.state().contact_force);
  EXPECT_EQ(resumed.energy().kinetic, motion.energy().kinetic);
}

} // namespace
} // namespace rubato::step::explicit_ties_test
