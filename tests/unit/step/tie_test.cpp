// SPDX-License-Identifier: LGPL-3.0-or-later
// Tied surfaces, in statics and in motion.
#include "rubato/contact/zone.hpp"
#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/simulated_blocks.hpp"
#include "support/walk.hpp"
#include <string>
#include <vector>

namespace rubato::step::tie_test {
namespace {

using deck::Setting;
using Eigen::VectorXd;

/// A column of two blocks, held at its foot and pulled aside at its head.
const std::string column = R"(
mesh:
  generate:
    - {name: foot, rectangle: {from: [0, 0], to: [1, 2]}, divisions: [4, 6], cells: quad8, sides: {bottom: ground, top: under}}
    - {name: head, rectangle: {from: [0, 2], to: [1, 4]}, divisions: [4, 6], cells: quad8, sides: {top: roof, bottom: over}}
physics: plane_strain
materials: {steel: {young: 100, poisson: 0.3, density: 1}}
functions: {kick: {times: [0, 0.5, 1], values: [0, 1, 0]}}
supports: [{on: ground, fix: [x, y]}]
loads: [{surface_force: {on: roof, x: 0.01, y: 0.02}}]
contact: {seam: {master: under, slave: over, tie: true}}
time: {scheme: static, step: 1, end: 1}
)";
const std::string in_one_piece = R"(
mesh:
  generate:
    - {name: column, rectangle: {from: [0, 0], to: [1, 4]}, divisions: [4, 12], cells: quad8, sides: {bottom: ground, top: roof}}
physics: plane_strain
materials: {steel: {young: 100, poisson: 0.3, density: 1}}
functions: {kick: {times: [0, 0.5, 1], values: [0, 1, 0]}}
supports: [{on: ground, fix: [x, y]}]
loads: [{surface_force: {on: roof, x: 0.01, y: 0.02}}]
time: {scheme: static, step: 1, end: 1}
)";

double largest(const test::Walk& walk) {
  return walk.state().motion.u.lpNorm<Eigen::Infinity>();
}

/// At all nodes of the first one.
double difference(const test::Walk& one, const test::Walk& other) {
  double most = 0;
  for (const auto node : one.model.dofs.nodes) {
    const auto& x = one.model.mesh.points[static_cast<std::size_t>(node)];
    const auto there = other.node_at(x[0], x[1]);
    for (int c = 0; c < 2; ++c)
      most = std::max(most, std::abs(one.displacement(node, c) - other.displacement(there, c)));
  }
  return most;
}

TEST(TiedBodies, AreOneWhereTheirMeshesMatch) {
  test::Walk whole(in_one_piece);
  ASSERT_TRUE(whole.to_end());
  for (const char* solver : {"auto", "full"}) {
    test::Walk tied(column, {{"solver", solver}});
    ASSERT_TRUE(tied.to_end()) << solver;
    EXPECT_EQ(tied.reports.size(), 1U);
    EXPECT_LT(difference(tied, whole), 1e-9 * largest(whole)) << solver;
  }
}

TEST(TiedBodies, MoveAsOneByEveryScheme) {
  for (const char* time :
       {"{scheme: newmark, step: 0.1, end: 2}", "{scheme: hht, alpha: -0.1, step: 0.1, end: 2}",
        "{scheme: moreau_jean, step: 0.1, end: 2}",
        "{scheme: moreau_jean, contact_mass: consistent, theta: 0.6, step: 0.1, end: 2}"}) {
    const std::vector<Setting> changes{{"time", time}, {"loads.0.surface_force.function", "kick"}};
    test::Walk whole(in_one_piece, changes);
    test::Walk tied(column, changes);
    EnergyAccount account(tied.model, tied.scheme, tied.state());
    tied.accepted = [&] { account.enter(tied.before, tied.state()); };
    ASSERT_TRUE(whole.to_end()) << time;
    ASSERT_TRUE(tied.to_end()) << time;
    EXPECT_LT(difference(tied, whole), 1e-8 * largest(whole)) << time;
    const auto& ledger = account.ledger();
    EXPECT_NEAR(ledger.balance(), 0, 1e-10 * ledger.largest()) << time;
    EXPECT_NEAR(ledger.friction, 0, 1e-10 * ledger.largest()) << time;
    EXPECT_NEAR(ledger.impact, 0, 1e-10 * ledger.largest()) << time;
  }
}

TEST(TiedBodies, AreNearlyOneThoughTheirMeshesDoNotMatch) {
  test::Walk whole(in_one_piece);
  ASSERT_TRUE(whole.to_end());
  test::Walk tied(column, {{"mesh.generate.1.divisions", "[5, 7]"}});
  ASSERT_TRUE(tied.to_end());
  const auto tip = [](const test::Walk& walk) { return walk.displacement(walk.node_at(0, 4), 0); };
  EXPECT_NEAR(tip(tied), tip(whole), 2e-3 * largest(whole));
}

TEST(TiedBodies, MayBeTiedNodeByNode) {
  const std::vector<Setting> linear{{"mesh.generate.0.cells", "quad4"}};
  test::Walk whole(in_one_piece, linear);
  test::Walk tied(column, {{"mesh.generate.0.cells", "quad4"},
                           {"mesh.generate.1.cells", "quad4"},
                           {"contact.seam.integration", "nodes"}});
  ASSERT_TRUE(whole.to_end());
  ASSERT_TRUE(tied.to_end());
  EXPECT_LT(difference(tied, whole), 1e-9 * largest(whole));
}

/// The gap turns with the master: to first order u_above = u_below + θ × gap, θ the slope of the master.
TEST(TiedBodies, KeepTheGapOfTheirMeshes) {
  for (const char* integration : {"mortar", "nodes"}) {
    test::Walk tied(column, {{"mesh.generate.1.rectangle", "{from: [0, 2.1], to: [1, 4.1]}"},
                             {"mesh.generate.0.cells", "quad4"},
                             {"mesh.generate.1.cells", "quad4"},
                             {"contact.seam.integration", integration}});
    ASSERT_TRUE(tied.to_end());
    const auto above = tied.node_at(0.5, 2.1);
    const auto below = tied.node_at(0.5, 2), left = tied.node_at(0.25, 2), right = tied.node_at(0.75, 2);
    const double slope = (tied.displacement(right, 1) - tied.displacement(left, 1)) / 0.5;
    EXPECT_NEAR(tied.displacement(above, 1), tied.displacement(below, 1), 1e-3 * largest(tied));
    EXPECT_NEAR(tied.displacement(above, 0), tied.displacement(below, 0) - 0.1 * slope,
                1e-2 * 0.1 * std::abs(slope));
    EXPECT_GT(std::abs(slope), 0.1 * largest(tied));
  }
}

TEST(TiedBodies, TellPressuresAlongTheNormal) {
  test::Walk tied(column, {{"loads.0.surface_force.x", "0"}});
  ASSERT_TRUE(tied.to_end());
  const auto sum = tied.resultants();
  EXPECT_EQ(sum.in_contact, 9);
  EXPECT_NEAR(tied.state().zones.front().outcomes[4].pressure, -0.02, 2e-3);
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (const auto& outcome : tied.state().zones.front().outcomes)
    force += outcome.normal + outcome.tangential;
  EXPECT_LT((force - Eigen::Vector3d(0, -0.02, 0)).norm(), 1e-10);
}

TEST(TiedBodies, StandBesideContactOfOtherBodies) {
  const std::string third = R"(
    - {name: cap, rectangle: {from: [0.2, 4], to: [0.8, 5]}, divisions: [3, 3], sides: {top: crown, bottom: sole}}
physics)";
  auto deck = column;
  deck.replace(deck.find("physics"), 7, third.substr(1));
  for (const char* integration : {"mortar", "nodes"}) {
    test::Walk walk(deck,
                    {{"loads", "[{surface_force: {on: crown, x: 0.001, y: -0.1}}]"},
                     {"contact.lid", std::string("{master: roof, slave: sole, friction: 0.5, integration: ") +
                                         integration + "}"}});
    ASSERT_TRUE(walk.to_end()) << integration;
    EXPECT_NEAR(walk.resultants(1).normal, 0.06, 1e-3) << integration;
  }
}

TEST(TiedBodies, GoOnToTheSameBits) {
  const std::vector<Setting> changes{{"time", "{scheme: moreau_jean, step: 0.1, end: 1}"}};
  test::Walk whole(column, changes);
  while (whole.state().t < 0.45)
    ASSERT_TRUE(whole.advance());
  const auto memento = whole.simulation.memento();
  ASSERT_TRUE(whole.to_end());
  test::Walk resumed(column, changes);
  resumed.simulation.restore(memento);
  ASSERT_TRUE(resumed.to_end());
  test::expect_same(resumed.simulation, whole.simulation);
}

std::string fault_of(const std::vector<Setting>& changes, const std::string& deck = column) {
  try {
    test::model_of(deck, changes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(TiedBodies, HaveToFaceEachOther) {
  EXPECT_NE(fault_of({{"mesh.generate.1.rectangle", "{from: [0, 3], to: [1, 5]}"}})
                .find("contact.seam.tie: nothing of the slave 'over' faces the master 'under' within 0.25"),
            std::string::npos);
  EXPECT_NE(
      fault_of({{"supports.0.on", "over"}}).find("supports hold every node of the slave 'over' along x"),
      std::string::npos);
  const std::string boxes = R"(
mesh:
  generate:
    - {name: foot, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [1, 1, 1], cells: tetra10, sides: {bottom: ground, top: under}}
    - {name: head, box: {from: [0, 1, 0], to: [1, 2, 1]}, divisions: [1, 1, 1], cells: tetra10, sides: {bottom: over}}
physics: solid
materials: {steel: {young: 100, poisson: 0.3}}
supports: [{on: ground, fix: [x, y, z]}]
contact: {seam: {master: under, slave: over, tie: true, integration: nodes}}
time: {scheme: static, step: 1, end: 1}
)";
  EXPECT_NE(
      fault_of({}, boxes).find("contact.seam.tie: found a tie by nodes, but nodes of 'over' share pressures, "
                               "expected integration: mortar"),
      std::string::npos);
}

} // namespace
} // namespace rubato::step::tie_test
