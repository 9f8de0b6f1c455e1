// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/model.hpp"
#include "rubato/model/rigid_motions.hpp"
#include "rubato/model/soft_springs.hpp"

#include <gtest/gtest.h>

#include "unit/model/studies.hpp"
#include <algorithm>
#include <string>

namespace rubato::model::soft_springs_test {
namespace {

/// Two blocks 1 × 1 apart from each other; `stiffness` of each of the 9 nodes of the upper one
/// [force/length].
std::string blocks(double stiffness, const std::string& physics = "plane_strain",
                   const std::string& rest = "") {
  return R"(
mesh:
  generate:
    - {name: low, rectangle: {from: [1, 0], to: [2, 1]}, divisions: [2, 2], sides: {top: above, bottom: base}}
    - {name: high, rectangle: {from: [1, 1.1], to: [2, 2.1]}, divisions: [2, 2], sides: {bottom: under}}
physics: )" +
         physics + R"(
materials: {soft: {young: 1000, poisson: 0}}
supports: [{on: base, fix: [x, y]}]
springs: [{on: high, x: )" +
         std::to_string(stiffness) + ", y: " + std::to_string(stiffness / 2) + R"(}]
contact: {rest: {master: above, slave: under}}
time: {scheme: static, step: 1, end: 1}
)" + rest;
}

bool are_soft(const std::string& deck) {
  const auto model = test::located_model(deck);
  EXPECT_FALSE(model.springs.empty());
  const auto soft = std::ranges::count_if(model.springs, &Spring::soft);
  EXPECT_TRUE(soft == 0 || soft == static_cast<std::ptrdiff_t>(model.springs.size()));
  return soft != 0;
}

/// E = 1000, a hundredth of it times the thickness is 10.
TEST(SoftSprings, AreSofterTogetherThanAHundredthOfTheirBody) {
  EXPECT_TRUE(are_soft(blocks(9.9 / 9)));
  EXPECT_FALSE(are_soft(blocks(10.1 / 9)));
  EXPECT_TRUE(are_soft(blocks(19.9 / 9, "plane_stress", "thickness: 2\n")));
  EXPECT_FALSE(are_soft(blocks(20.1 / 9, "plane_stress", "thickness: 2\n")));
}

/// A full turn at the radius 2.
TEST(SoftSprings, OfAxisymmetryAreMeasuredByTheWayRound) {
  EXPECT_TRUE(are_soft(blocks(125.0 / 9, "axisymmetric")));
  EXPECT_FALSE(are_soft(blocks(126.0 / 9, "axisymmetric")));
}

TEST(SoftSprings, DoNotHoldTheirBodyBesideContact) {
  const auto model = test::located_model(blocks(1e-3));
  RigidMotions all(model);
  all.add_supports();
  EXPECT_EQ(all.held(), (std::vector<char>{1, 1}));
  RigidMotions firm(model);
  firm.add_firm_supports();
  EXPECT_EQ(firm.held(), (std::vector<char>{1, 0}));
  EXPECT_EQ(model.free_body_nodes.size(), 9U);
  EXPECT_TRUE(test::located_model(blocks(100)).free_body_nodes.empty());
}

TEST(SoftSprings, AreThoseOfBodiesInContactOnly) {
  auto deck = blocks(1e-3);
  const auto from = deck.find("contact:");
  deck.erase(from, deck.find("time:") - from);
  EXPECT_FALSE(are_soft(deck));
}

} // namespace
} // namespace rubato::model::soft_springs_test
