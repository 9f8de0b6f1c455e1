// SPDX-License-Identifier: LGPL-3.0-or-later
// Ties over a gap: the gap turns with the master.
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/energy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rubato::step::tie_gap_test {
namespace {

using deck::Setting;
using Eigen::Vector3d;

constexpr double young = 100;

/// Two blocks with a gap between them; the foot is turned by 90 degrees in 15 steps.
std::string turned_plane(const std::string& foot, const std::string& head, const std::string& tie) {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: foot, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [3, 2], cells: {}, sides: {{bottom: ground, top: under}}}}
    - {{name: head, rectangle: {{from: [0.1, 1.2], to: [1.2, 2]}}, divisions: [4, 2], cells: {}, sides: {{bottom: over}}}}
physics: plane_strain
materials: {{steel: {{young: 100, poisson: 0.3, density: 1, strain: green_lagrange}}}}
functions: {{ramp: {{times: [0, 1], values: [0, 1]}}}}
supports: [{{on: ground, rotate: {{about: [0, 0], angle: {{value: 1.5707963267948966, function: ramp}}}}}}]
contact: {{seam: {{{}}}}}
time: {{scheme: static, step: 0.06666666666666667, end: 1}}
)",
                     foot, head, tie);
}

std::string turned_solid(const std::string& foot, const std::string& head, const std::string& tie) {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: foot, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [2, 1, 2], cells: {}, sides: {{bottom: ground, top: under}}}}
    - {{name: head, box: {{from: [0, 1.2, 0.1], to: [1, 2, 1.1]}}, divisions: [3, 1, 1], cells: {}, sides: {{bottom: over}}}}
physics: solid
materials: {{steel: {{young: 100, poisson: 0.3, density: 1, strain: green_lagrange}}}}
functions: {{ramp: {{times: [0, 1], values: [0, 1]}}}}
supports: [{{on: ground, rotate: {{about: [0, 0, 0], axis: [1, 0.5, -2], angle: {{value: 1.5707963267948966, function: ramp}}}}}}]
contact: {{seam: {{{}}}}}
time: {{scheme: static, step: 0.06666666666666667, end: 1}}
)",
                     foot, head, tie);
}

/// The largest relative change of a distance between two nodes: 0 in a rigid motion.
double largest_stretch(const test::Walk& walk) {
  double largest = 0;
  const auto& mesh = walk.model.mesh;
  const auto place = [&](mesh::NodeIndex node) {
    Vector3d x = mesh.points[static_cast<std::size_t>(node)];
    for (int c = 0; c < walk.model.dofs.components; ++c)
      x[c] += walk.displacement(node, c);
    return x;
  };
  const auto& nodes = walk.model.dofs.nodes;
  for (const auto a : nodes)
    for (const auto b : nodes)
      if (a < b) {
        const double before =
            (mesh.points[static_cast<std::size_t>(a)] - mesh.points[static_cast<std::size_t>(b)]).norm();
        largest = std::max(largest, std::abs((place(a) - place(b)).norm() / before - 1));
      }
  return largest;
}

/// Of contact forces about the origin. `part`: where nodes are between the start of the last step and its
/// end; nothing: where they are undeformed.
Vector3d moment_of_contact(const test::Walk& walk, std::optional<double> part = 1) {
  Vector3d moment = Vector3d::Zero();
  for (const auto node : walk.model.dofs.nodes) {
    Vector3d x = walk.model.mesh.points[static_cast<std::size_t>(node)];
    Vector3d force = Vector3d::Zero();
    for (int c = 0; c < walk.model.dofs.components; ++c) {
      const auto dof = walk.model.dofs.dof(node, c);
      if (part)
        x[c] += *part * walk.displacement(node, c) + (1 - *part) * walk.before.motion.u[dof];
      force[c] = walk.state().contact_force[dof];
    }
    moment += contact::cross(x, force);
  }
  return moment;
}

constexpr const char* lower_is_master = "master: under, slave: over, tie: true";
constexpr const char* upper_is_master = "master: over, slave: under, tie: true";

TEST(TiesOverAGap, CostNothingWhereAllTurnsInThePlane) {
  for (const auto& [foot, head] : {std::pair{"quad4", "quad8"}, {"tria6", "quad4"}, {"quad9", "tria3"}})
    for (const std::string sides : {lower_is_master, upper_is_master})
      for (const char* integration : {"mortar", "nodes"}) {
        const bool linear = std::string(sides == lower_is_master ? head : foot).find_first_of("34") < 9;
        if (std::string(integration) == "nodes" && !linear)
          continue;
        for (const char* solver : {"auto", "full"}) {
          test::Walk walk(turned_plane(foot, head, sides + ", integration: " + integration),
                          {{"solver", solver}});
          ASSERT_TRUE(walk.to_end()) << foot << head << sides << integration << solver;
          EXPECT_EQ(walk.deepest_cut, 0);
          EXPECT_LT(largest_stretch(walk), 1e-9) << foot << head << sides << integration << solver;
        }
      }
}

TEST(TiesOverAGap, CostNothingWhereAllTurnsInSpace) {
  for (const auto& [foot, head] : {std::pair{"hexa8", "hexa20"}, {"tetra10", "hexa8"}, {"hexa27", "tetra4"}})
    for (const std::string sides : {lower_is_master, upper_is_master}) {
      test::Walk walk(turned_solid(foot, head, sides));
      ASSERT_TRUE(walk.to_end()) << foot << head << sides;
      EXPECT_LT(largest_stretch(walk), 1e-9) << foot << head << sides;
    }
  for (const std::string sides : {lower_is_master, upper_is_master}) {
    test::Walk walk(turned_solid("hexa8", "tetra4", sides + ", integration: nodes"),
                    {{"mesh.generate.1.box", "{from: [0, 1.2, 0], to: [1, 2, 1]}"}});
    ASSERT_TRUE(walk.to_end()) << sides;
    EXPECT_LT(largest_stretch(walk), 1e-9) << sides;
  }
}

/// A slender column of two pieces with a gap of 0.4 between them, held at its foot, its head pulled aside.
constexpr double piece = 5, gap = 0.4, pull = 1e-4;
const std::string column = R"(
mesh:
  generate:
    - {name: foot, rectangle: {from: [0, 0], to: [1, 5]}, divisions: [2, 10], cells: quad8, sides: {bottom: ground, top: under}}
    - {name: head, rectangle: {from: [0, 5.4], to: [1, 10.4]}, divisions: [2, 10], cells: quad8, sides: {top: roof, bottom: over}}
physics: plane_stress
materials: {steel: {young: 100, poisson: 0, density: 1}}
supports: [{on: ground, fix: [x, y]}]
loads: [{surface_force: {on: roof, x: 1e-4}}]
contact: {seam: {master: under, slave: over, tie: true}}
time: {scheme: static, step: 1, end: 1}
)";

/// Timoshenko's beam with a rigid part in its middle: E = 100, G = 50, b = h = 1.
double tip_of_column() {
  const double inertia = 1. / 12, shear_modulus = 50, shear_area = 5. / 6;
  const double top = piece + gap, whole = 2 * piece + gap;
  const double bending = (std::pow(piece, 3) + std::pow(whole, 3) - std::pow(top, 3)) / (3 * young * inertia);
  return pull * (bending + 2 * piece / (shear_modulus * shear_area));
}

double tip(const test::Walk& walk) {
  return walk.displacement(walk.node_at(0.5, 2 * piece + gap), 0);
}

TEST(TiesOverAGap, CarryTheMomentOfAShearForce) {
  for (const std::string sides : {lower_is_master, upper_is_master})
    for (const char* solver : {"auto", "full"})
      for (const char* strain : {"small", "green_lagrange"}) {
        test::Walk walk(
            column,
            {{"contact.seam", "{" + sides + "}"}, {"solver", solver}, {"materials.steel.strain", strain}});
        ASSERT_TRUE(walk.to_end()) << sides << solver << strain;
        EXPECT_NEAR(tip(walk), tip_of_column(), 3e-3 * tip_of_column()) << sides << solver << strain;
        const bool linear = std::string(strain) == "small";
        EXPECT_LT(moment_of_contact(walk, linear ? std::nullopt : std::optional(1.0)).norm(),
                  1e-9 * pull * gap)
            << sides << solver << strain;
        if (linear)
          EXPECT_EQ(walk.reports.size(), 1U);
      }
}

TEST(TiesOverAGap, CarryTheMomentByNodes) {
  for (const std::string sides : {lower_is_master, upper_is_master}) {
    test::Walk walk(column, {{"contact.seam", "{" + sides + ", integration: nodes}"},
                             {"mesh.generate.0.cells", "quad4"},
                             {"mesh.generate.1.cells", "quad4"},
                             {"materials.steel.formulation", "enhanced"}});
    ASSERT_TRUE(walk.to_end()) << sides;
    EXPECT_NEAR(tip(walk), tip_of_column(), 1e-2 * tip_of_column()) << sides;
    EXPECT_LT(moment_of_contact(walk, std::nullopt).norm(), 1e-9 * pull * gap) << sides;
  }
}

/// A gap keeps its length where the surfaces on both sides turn alike.
TEST(TiesOverAGap, KeepTheWidthOfTheGap) {
  test::Walk walk(column, {{"loads.0.surface_force.x", "0"}, {"loads.0.surface_force.y", "0.01"}});
  ASSERT_TRUE(walk.to_end());
  const auto above = walk.node_at(0.5, piece + gap), below = walk.node_at(0.5, piece);
  EXPECT_NEAR(walk.displacement(above, 1), walk.displacement(below, 1), 1e-12);
}

/// A pair that tumbles freely after its support is gone; rows of the middle of a step do no work.
TEST(TiesOverAGap, TakeNoEnergyFromBodiesThatTumble) {
  test::Walk walk(
      turned_plane("quad4", "quad4", lower_is_master),
      {{"time", "{scheme: energy_momentum, step: 0.02, end: 6}"},
       {"supports", "[{on: ground, rotate: {about: [0, 0], angle: {acceleration: 1}}, until: 1}]"}});
  EnergyAccount account(walk.model, walk.scheme, walk.state());
  walk.accepted = [&] { account.enter(walk.before, walk.state()); };
  ASSERT_TRUE(walk.to_end());
  const auto& ledger = account.ledger();
  EXPECT_NEAR(ledger.balance(), 0, 1e-10 * ledger.largest());
  EXPECT_NEAR(ledger.friction, 0, 1e-10 * ledger.largest());
  EXPECT_NEAR(ledger.impact, 0, 1e-10 * ledger.largest());
}

/// u = θ × X of all nodes fulfils the relations that explicit runs make of ties.
TEST(TiesOverAGap, AreRelationsThatALinearisedRotationFulfils) {
  const std::string explicit_run = "{scheme: central_difference, step: auto, end: 1e-3}";
  const Vector3d turn(0.3, -0.2, 0.7);
  for (const std::string sides : {lower_is_master, upper_is_master})
    for (const char* integration : {", integration: mortar", ", integration: nodes"})
      for (const bool plane : {true, false}) {
        const auto deck = plane ? turned_plane("quad4", "tria3", sides + integration)
                                : turned_solid("hexa8", "tetra4", sides + integration);
        const auto model =
            test::model_of(deck, {{"time", explicit_run}, {"supports", "[{on: ground, fix: y}]"}});
        std::vector<double> u(static_cast<std::size_t>(model.dofs.dof_count), 0);
        for (const auto node : model.dofs.nodes) {
          const auto moved = contact::cross(plane ? Vector3d(0, 0, 0.7) : turn,
                                            model.mesh.points[static_cast<std::size_t>(node)]);
          for (int c = 0; c < model.dofs.components; ++c)
            u[static_cast<std::size_t>(model.dofs.dof(node, c))] = moved[c];
        }
        int related = 0;
        for (const auto& dependent : model.reduction.dependents()) {
          double sum = 0;
          for (const auto* terms : {&dependent.of, &dependent.prescribed})
            for (const auto& term : *terms)
              sum += term.coefficient * u[static_cast<std::size_t>(term.dof)];
          EXPECT_NEAR(sum, u[static_cast<std::size_t>(dependent.dof)], 1e-12);
          ++related;
        }
        EXPECT_GT(related, 0);
        EXPECT_TRUE(std::ranges::any_of(model.notes, [](const std::string& note) {
          return note.find("contact.seam.tie: surfaces are tied over a gap of up to 0.2") == 0;
        }));
      }
}

TEST(TiesOverAGap, DoNotHoldBodiesAgainstTurning) {
  const auto deck = turned_plane("quad4", "quad4", lower_is_master);
  try {
    test::model_of(deck, {{"supports", "[{on: N1, fix: [x, y]}]"}});
    FAIL() << "nothing holds the pair against turning";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("turning"), std::string::npos) << error.what();
  }
}

/// In parts of the force and the gap, at the end of a rotation that accelerates. `middle`: where in the last
/// step the forces act.
double moment_in_motion(const std::string& scheme, double step, double middle) {
  test::Walk walk(turned_plane("quad4", "quad4", lower_is_master),
                  {{"time", fmt::format("{{scheme: {}, step: {}, end: 1}}", scheme, step)},
                   {"supports", "[{on: ground, rotate: {about: [0, 0], angle: {acceleration: 1}}}]"}});
  EXPECT_TRUE(walk.to_end()) << scheme;
  return moment_of_contact(walk, middle).norm() / (0.2 * walk.state().contact_force.norm());
}

TEST(TiesOverAGap, HaveNoMomentInMotion) {
  for (const char* scheme : {"newmark", "hht, alpha: -0.05"})
    EXPECT_LT(moment_in_motion(scheme, 0.02, 1), 1e-12) << scheme;
}

/// Laws of velocities hold the rate of the gap vector by rows of the predicted middle of the step.
TEST(TiesOverAGap, HaveAMomentThatFallsWithTheSquareOfTheStepByLawsOfVelocities) {
  for (const char* scheme : {"moreau_jean", "moreau_jean, contact_mass: consistent", "energy_momentum"}) {
    const double coarse = moment_in_motion(scheme, 0.02, 0.5), fine = moment_in_motion(scheme, 0.01, 0.5);
    EXPECT_LT(coarse, 5e-4) << scheme;
    EXPECT_LT(fine, 0.3 * coarse) << scheme;
  }
}

} // namespace
} // namespace rubato::step::tie_gap_test
