// SPDX-License-Identifier: LGPL-3.0-or-later
/// A block on a plane: forces that statics give without any mechanics of bodies.
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <string>
#include <utility>

namespace rubato::step::friction_test {
namespace {

using test::Walk;

constexpr double weight = 1000;
constexpr double mu = 0.3;

/// The push that the supports of the block's top feel [force].
double push(const Walk& walk) {
  double sum = 0;
  for (const auto node : mesh::nodes_named(walk.model.mesh, "top"))
    sum += walk.state().reaction[walk.model.dofs.dof(node, 0)];
  return sum;
}

TEST(BlockOnAPlane, SticksAndHandsOnTheWholePush) {
  Walk walk(test::block_on_plane, {{"supports.1.x.value", "1e-7"}});
  ASSERT_TRUE(walk.to_end());
  const auto foot = walk.resultants();
  EXPECT_GT(push(walk), 0);
  EXPECT_LT(push(walk), mu * weight);
  EXPECT_NEAR(foot.force[0], -push(walk), 1e-8 * weight);
  EXPECT_NEAR(foot.force[1], weight, 1e-8 * weight);
  EXPECT_NEAR(foot.friction, push(walk), 1e-5 * weight);
  EXPECT_EQ(foot.sticking, foot.in_contact);
  EXPECT_EQ(foot.in_contact, 5);
}

TEST(BlockOnAPlane, SlipsUnderFrictionTimesItsWeight) {
  Walk walk(test::block_on_plane, {{"supports.1.x.value", "1e-4"}});
  ASSERT_TRUE(walk.to_end());
  const auto foot = walk.resultants();
  EXPECT_NEAR(foot.force[0], -mu * weight, 1e-5 * weight);
  EXPECT_NEAR(foot.force[1], weight, 1e-8 * weight);
  EXPECT_NEAR(foot.friction, mu * foot.normal, 1e-9 * weight);
  EXPECT_NEAR(push(walk), mu * weight, 1e-5 * weight);
  EXPECT_EQ(foot.sticking, 0);
}

TEST(BlockOnAPlane, FeelsNoPushWithoutFriction) {
  Walk walk(test::block_on_plane, {{"contact.foot.friction", "0"}});
  ASSERT_TRUE(walk.to_end());
  EXPECT_NEAR(push(walk), 0, 1e-6 * weight);
  EXPECT_NEAR(walk.resultants().force[1], weight, 1e-8 * weight);
}

/// Gauss points hold the gap shut in the mean only.
TEST(BlockOnAPlane, CarriesItsWeightThroughGaussPoints) {
  Walk walk(test::block_on_plane,
            {{"contact.foot.friction", "0"}, {"contact.foot.integration", "{gauss: 2}"}});
  ASSERT_TRUE(walk.to_end());
  EXPECT_NEAR(push(walk), 0, 1e-4 * weight);
  double carried = 0;
  for (const auto node : mesh::nodes_named(walk.model.mesh, "ground"))
    carried += walk.state().reaction[walk.model.dofs.dof(node, 1)];
  EXPECT_NEAR(carried, weight, 1e-6 * weight);
}

/// Two units of length over faces of 5/13: the block crosses six of them and still stands on the plane.
class LargeSliding : public testing::TestWithParam<const char*> {};

TEST_P(LargeSliding, KeepsTheForcesOverManyMasterFaces) {
  Walk walk(test::block_on_plane,
            {{"supports.1.x.value", "2"}, {"time.step", "0.05"}, {"contact.foot.friction", GetParam()}});
  const double friction = std::stod(GetParam());
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance()) << "t = " << walk.state().t;
    const auto foot = walk.resultants();
    EXPECT_NEAR(foot.force[1], weight, 1e-8 * weight);
    EXPECT_NEAR(foot.force[0], -friction * weight, 1e-4 * weight);
  }
  EXPECT_NEAR(walk.displacement(walk.node_at(0, 0), 0), 2, 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Friction, LargeSliding, testing::Values("0", "0.3"),
                         [](const auto& instance) { return instance.index == 0 ? "none" : "some"; });

/// Sum of the contact forces of both sides and of their moments, at the places where the nodes are now, over
/// the sum of the forces' lengths.
struct Imbalance {
  double force = 0;
  double moment = 0;
};

Imbalance imbalance(const Walk& walk) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double moment = 0, scale = 0;
  for (const auto node : walk.model.dofs.nodes) {
    const auto dof = walk.model.dofs.dof(node, 0);
    const Eigen::Vector2d f = walk.state().contact_force.segment<2>(dof);
    const Eigen::Vector2d x = walk.model.mesh.points[static_cast<std::size_t>(node)].head<2>() +
                              walk.state().motion.u.segment<2>(dof);
    sum += f;
    moment += x[0] * f[1] - x[1] * f[0];
    scale += f.norm();
  }
  return {sum.norm() / scale, std::abs(moment) / scale};
}

TEST(ContactForces, OfTheTwoSidesBalanceInForceAndMoment) {
  Walk walk(test::block_on_plane, {{"supports.1.x.value", "1"}, {"time.step", "0.1"}});
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    EXPECT_LT(imbalance(walk).force, 1e-14);
    EXPECT_LT(imbalance(walk).moment, 1e-12);
  }
}

/// A slave node beside the end of the master is held by the end: the two forces have an arm as long as the
/// distance between them, at most half a face.
TEST(ContactForces, BalanceInForceAlwaysAndInMomentButForPointsBesideTheMastersEnd) {
  Walk walk(test::two_beams);
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    EXPECT_LT(imbalance(walk).force, 1e-14);
    EXPECT_LT(imbalance(walk).moment, 0.05 / 2);
  }
}

/// A block that a pressure holds on its ground, dragged at its top.
const std::string pressed_block = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0.2, 0], to: [0.8, 0.3]}, divisions: [12, 6], sides: {bottom: under, top: roof}}
    - {name: ground, rectangle: {from: [0, -0.3], to: [1, 0]}, divisions: [17, 5], sides: {top: above, bottom: base}}
physics: plane_strain
materials: {steel: {young: 2e11, poisson: 0.3}}
functions: {push: {times: [0, 1, 2], values: [0, 0, 1]}}
supports: [{on: base, fix: [x, y]}, {on: roof, x: {value: 1e-6, function: push}}]
loads: [{pressure: {on: roof, value: 1e7}}]
contact: {rest: {master: above, slave: under, integration: nodes, friction: 1, method: penalty, friction_method: penalty}}
time: {scheme: static, step: 1, end: 2}
)";

/// Springs that saturate within 1e-8 of the block stick all the same, and carry what those of 1e-7 carry.
TEST(StiffFrictionByPenalty, SettlesInStatics) {
  for (const char* friction : {"0.1", "1", "10"}) {
    double dragged = 0;
    for (const char* stiffness : {"1e5", "1e7", "1e8"}) {
      Walk walk(pressed_block,
                {{"contact.rest.friction", friction},
                 {"contact.rest.coefficients", "{tangential: " + std::string(stiffness) + "}"}});
      ASSERT_TRUE(walk.to_end()) << "friction " << friction << ", " << stiffness;
      EXPECT_EQ(walk.reports.size(), 2u) << "friction " << friction << ", " << stiffness;
      for (const auto& report : walk.reports)
        EXPECT_LE(report.iterations, 15) << "friction " << friction << ", " << stiffness;
      const auto foot = walk.resultants();
      EXPECT_NEAR(foot.force[1], 0.6e7, 1e-5 * 0.6e7);
      if (std::string(stiffness) == "1e8") {
        EXPECT_NEAR(foot.force[0], dragged, 0.05 * std::abs(dragged)) << friction;
      }
      dragged = foot.force[0];
    }
  }
}

/// What nothing but contact holds is placed by differences of a free motion much longer than gaps: their last
/// digits, times the springs, are what the residual can come to.
TEST(FrictionByPenalty, SettlesUnderABodyThatOnlyContactHolds) {
  std::string deck = pressed_block;
  for (const auto& [plane, space] :
       {std::pair{"rectangle: {from: [0.2, 0], to: [0.8, 0.3]}, divisions: [12, 6]",
                  "box: {from: [0.2, 0, 0.2], to: [0.8, 0.3, 0.8]}, divisions: [6, 3, 6]"},
        std::pair{"rectangle: {from: [0, -0.3], to: [1, 0]}, divisions: [17, 5]",
                  "box: {from: [0, -0.3, 0], to: [1, 0, 1]}, divisions: [11, 3, 11]"},
        std::pair{"plane_strain", "solid"}, std::pair{"fix: [x, y]}", "fix: [x, y, z]}"},
        std::pair{"{on: roof, x:", "{on: roof, fix: z, x:"}})
    deck.replace(deck.find(plane), std::string(plane).size(), space);
  Walk walk(deck);
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 2u);
  EXPECT_NEAR(walk.resultants().force[1], 0.36e7, 1e-6 * 0.36e7);
}

} // namespace
} // namespace rubato::step::friction_test
