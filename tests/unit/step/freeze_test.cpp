// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact with the geometry of the undeformed bodies.
#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include "support/simulated_blocks.hpp"
#include "support/walk.hpp"
#include <string>
#include <vector>

namespace rubato::step::freeze_test {
namespace {

using Eigen::VectorXd;

/// A short beam on a longer one that is held at both ends, pushed down and aside at its tip. Meshes do not
/// match.
const std::string beams = R"(
mesh:
  generate:
    - {name: lower, rectangle: {from: [0, 0], to: [4, 0.5]}, divisions: [11, 3],
       sides: {left: held, right: held, top: under}}
    - {name: upper, rectangle: {from: [1, 0.5], to: [3, 1]}, divisions: [7, 3], cells: quad8,
       sides: {top: roof, bottom: over}, points: {left_top: tip, right_top: end}}
physics: plane_strain
materials: {steel: {young: 100, poisson: 0.3, density: 1}}
supports: [{on: held, fix: [x, y]}, {on: end, fix: [x]}]
loads: [{surface_force: {on: roof, x: 0, y: -1}}]
contact: {seam: {master: under, slave: over, integration: mortar}}
time: {scheme: static, step: 1, end: 1}
newton: {residual: 1e-12}
)";

VectorXd displacement(const std::string& zone, double load) {
  test::Walk walk(beams, {{"contact.seam", "{master: under, slave: over, " + zone + "}"},
                          {"loads.0.surface_force.y", std::to_string(-load)}});
  EXPECT_TRUE(walk.to_end()) << zone;
  EXPECT_GT(walk.resultants().in_contact, 2) << zone;
  return walk.state().motion.u;
}

/// The smaller the displacements, the nearer the answer in motion is to the frozen one, which is a multiple
/// of its load.
TEST(FrozenContact, IsTheAnswerOfSmallDisplacements) {
  for (const std::string kind :
       {"integration: mortar", "integration: {gauss: 3}", "integration: {simpson: 2}"}) {
    const VectorXd frozen = displacement(kind + ", freeze: true", 1);
    const VectorXd larger = displacement(kind + ", freeze: true", 16);
    EXPECT_LT((larger - 16 * frozen).norm(), 1e-8 * larger.norm()) << kind;
    const VectorXd coarse = 100 * displacement(kind, 0.01) - frozen;
    const VectorXd fine = 1000 * displacement(kind, 0.001) - frozen;
    EXPECT_LT(coarse.norm(), 1e-2 * frozen.norm()) << kind;
    EXPECT_LT(fine.norm(), 0.15 * coarse.norm()) << kind;
  }
}

TEST(FrozenContact, IsTheSameByTheWholeSystem) {
  for (const std::string kind : {"integration: mortar", "integration: {gauss: 3}"}) {
    const auto changes = [&](const char* solver) {
      return std::vector<deck::Setting>{
          {"contact.seam", "{master: under, slave: over, freeze: true, " + kind + "}"}, {"solver", solver}};
    };
    test::Walk one(beams, changes("auto"));
    test::Walk other(beams, changes("full"));
    ASSERT_TRUE(one.to_end());
    ASSERT_TRUE(other.to_end());
    EXPECT_LT((one.state().motion.u - other.state().motion.u).norm(), 1e-9 * one.state().motion.u.norm());
  }
}

/// Moved obstacles take their places along.
TEST(FrozenContact, FollowsAnObstacleThatMoves) {
  for (const char* integration : {"nodes", "mortar"}) {
    test::Walk walk(R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [3, 3], sides: {bottom: ground, top: roof, left: left}}
physics: plane_strain
materials: {steel: {young: 100, poisson: 0}}
functions: {push: {times: [0, 1], values: [0, -0.1]}}
supports: [{on: ground, fix: y}, {on: left, fix: x}]
contact:
  press: {slave: roof, freeze: true, obstacle: {plane: {point: [0, 1], normal: [0, -1]}, move: {y: {value: 1, function: push}}}}
time: {scheme: static, step: 0.5, end: 1}
)",
                    {{"contact.press.integration", integration}});
    ASSERT_TRUE(walk.to_end());
    EXPECT_NEAR(walk.displacement(walk.node_at(1, 1), 1), -0.1, 1e-12) << integration;
    EXPECT_NEAR(walk.resultants().normal, 10, 1e-9) << integration;
  }
}

TEST(FrozenContact, GoesOnToTheSameBits) {
  const std::vector<deck::Setting> changes{{"contact.seam.freeze", "true"},
                                           {"contact.seam.friction", "0.3"},
                                           {"time", "{scheme: moreau_jean, step: 0.01, end: 0.2}"}};
  test::Walk whole(beams, changes);
  while (whole.state().t < 0.1)
    ASSERT_TRUE(whole.advance());
  const auto memento = whole.simulation.memento();
  ASSERT_TRUE(whole.to_end());
  test::Walk resumed(beams, changes);
  resumed.simulation.restore(memento);
  ASSERT_TRUE(resumed.to_end());
  test::expect_same(resumed.simulation, whole.simulation);
}

} // namespace
} // namespace rubato::step::freeze_test
