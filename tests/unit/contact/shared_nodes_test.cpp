// SPDX-License-Identifier: LGPL-3.0-or-later
// Nodes with several points of contact: where their friction acts.
#include "rubato/contact/kinematics.hpp"
#include "rubato/contact/shared_nodes.hpp"
#include "rubato/contact/zone.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::contact::shared_nodes_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Kinematics facing_up(int components) {
  Kinematics k;
  k.stencil.components = components;
  k.normal = {0, 1, 0};
  k.tangents.col(0) = Vector3d(1, 0, 0);
  k.tangents.col(1) = components == 2 ? Vector3d(0, 0, 0) : Vector3d(0, 0, -1);
  return k;
}

Vector3d leaning(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::sin(angle), std::cos(angle), 0};
}

TEST(CommonDirections, AreAllWhereSurfacesAreOne) {
  for (const int components : {2, 3}) {
    EXPECT_EQ(common_directions(facing_up(components), {}).count, 2);
    EXPECT_EQ(common_directions(facing_up(components), std::vector{leaning(9), leaning(-9)}).count, 2);
  }
}

TEST(CommonDirections, AreNoneInThePlane) {
  for (const double degrees : {11., 90., 179. - 11, -45.})
    EXPECT_EQ(common_directions(facing_up(2), std::vector{leaning(degrees)}).count, 0) << degrees;
}

TEST(CommonDirections, AreThatOfTheEdgeInSpace) {
  for (const double degrees : {11., 60., 90., 150.}) {
    const auto found = common_directions(facing_up(3), std::vector{leaning(degrees), leaning(0)});
    ASSERT_EQ(found.count, 1) << degrees;
    EXPECT_NEAR(std::abs(found.only.dot(Vector2d::UnitY())), 1, 1e-15) << degrees;
  }
  EXPECT_EQ(common_directions(facing_up(3), std::vector{leaning(90), leaning(60)}).count, 1)
      << "three surfaces along one edge";
}

TEST(CommonDirections, AreNoneInACornerOfThreeSurfaces) {
  EXPECT_EQ(common_directions(facing_up(3), std::vector<Vector3d>{leaning(90), {0, 0, 1}}).count, 0);
}

const std::string two_zones = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [2, 2], cells: quad4, sides: {bottom: under, left: beside, top: roof}}
    - {name: floor, rectangle: {from: [-0.5, -0.5], to: [1.5, 0]}, divisions: [3, 1], cells: quad4, sides: {top: ground, bottom: base}}
    - {name: wall, rectangle: {from: [-0.5, 0], to: [0, 1.5]}, divisions: [1, 3], cells: quad4, sides: {right: face, left: back}}
physics: plane_strain
materials: {steel: {young: 1, poisson: 0.3, density: 1}}
supports: [{on: base, fix: [x, y]}, {on: back, fix: [x, y]}, {on: roof, fix: x}]
contact:
  below: {master: ground, slave: under, friction: 0.2}
  aside: {master: face, slave: beside}
time: {scheme: static, step: 1, end: 1}
)";

TEST(PointsOfSharedNodes, AreThoseOfTheNodeInTwoZones) {
  const auto model = test::model_of(two_zones);
  ASSERT_EQ(model.shared_nodes.size(), 1U);
  ASSERT_EQ(model.shared_nodes.front().size(), 2U);
  for (const auto& [zone, point] : model.shared_nodes.front()) {
    const auto node = model.zones[zone].points[point].nodes.front();
    EXPECT_TRUE(model.mesh.points[static_cast<std::size_t>(node)].isZero(0));
  }
  ASSERT_EQ(model.notes.size(), 1U);
  EXPECT_NE(model.notes.front().find("1 slave node of several contact zones with friction, the first N"),
            std::string::npos)
      << model.notes.front();
}

TEST(PointsOfSharedNodes, AreNoneWithoutFrictionAndInTies) {
  EXPECT_TRUE(test::model_of(two_zones, {{"contact.below.friction", "0"}}).shared_nodes.empty());
  EXPECT_TRUE(test::model_of(two_zones, {{"contact.aside.tie", "true"}}).shared_nodes.empty());
}

TEST(PointsOfSharedNodes, AreNotToldOfInExplicitRuns) {
  const auto model =
      test::model_of(two_zones, {{"time", "{scheme: central_difference, step: auto, end: 1e-3}"},
                                 {"contact.below.integration", "nodes"},
                                 {"contact.below.method", "penalty"},
                                 {"contact.aside.integration", "nodes"},
                                 {"contact.aside.method", "penalty"}});
  EXPECT_EQ(model.shared_nodes.size(), 1U);
  EXPECT_TRUE(model.notes.empty());
}

} // namespace
} // namespace rubato::contact::shared_nodes_test
