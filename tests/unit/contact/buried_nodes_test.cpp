// SPDX-License-Identifier: LGPL-3.0-or-later
// Master nodes behind the slave.
#include "rubato/contact/buried_nodes.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include <string>

namespace rubato::contact {
namespace {

/// A block whose bottom is the slave, of two faces, and below it one of half its width, of four: with its top
/// at y = 0 and its nodes at x = 0.5, 0.625 to 1.
std::string blocks(const std::string& zone) {
  return R"(
mesh:
  generate:
    - {name: upper, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [2, 1], cells: quad4, sides: {bottom: under, top: roof}}
    - {name: lower, rectangle: {from: [0.5, -1], to: [1, 0]}, divisions: [4, 1], cells: quad4, sides: {top: over, bottom: ground}}
physics: plane_strain
materials: {steel: {young: 1, poisson: 0}}
supports: [{on: ground, fix: [x, y]}, {on: roof, fix: [x, y]}]
contact: {rest: )" +
         zone + R"(}
time: {scheme: static, step: 1, end: 1}
)";
}

std::vector<double> depths(const model::Model& model, double x, double y) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.dofs.dof_count));
  for (const auto node : model.zones.front().slave.nodes) {
    u[model.dofs.dof(node, 0)] = x;
    u[model.dofs.dof(node, 1)] = y;
  }
  return buried_depths(model.zones.front(), {&model.mesh, &model.dofs, &u, &u});
}

TEST(BuriedNodes, AreThoseBehindAFaceThatLooksAtThem) {
  const auto model = test::model_of(blocks("{master: over, slave: under}"));
  ASSERT_EQ(model.zones.front().master.nodes.size(), 5U);
  for (const double depth : depths(model, 0, 0.1))
    EXPECT_EQ(depth, 0) << "in front";
  for (const double depth : depths(model, 0, -0.1))
    EXPECT_NEAR(depth, 0.1, 1e-14);
}

TEST(BuriedNodes, AreNotBesideTheSlave) {
  const auto model = test::model_of(blocks("{master: over, slave: under}"));
  int buried = 0;
  for (const double depth : depths(model, 0.7, -0.1)) // it begins at x = 0.7
    if (depth > 0) {
      EXPECT_NEAR(depth, 0.1, 1e-14);
      ++buried;
    }
  EXPECT_EQ(buried, 3) << "x = 0.75, 0.875, 1";
}

TEST(BuriedNodes, DoNotLookTheSameWay) {
  const auto model = test::model_of(blocks("{master: ground, slave: under}"));
  for (const double depth : depths(model, 0, -1.5))
    EXPECT_EQ(depth, 0);
}

TEST(EdgesAroundNodes, AreTheShortest) {
  const auto model = test::model_of(blocks("{master: over, slave: under}"));
  EXPECT_EQ(edges_around(model.mesh, model.zones.front().slave), std::vector<double>(3, 1));
  for (const double edge : edges_around(model.mesh, model.zones.front().master))
    EXPECT_NEAR(edge, 0.125, 1e-14);
}

} // namespace
} // namespace rubato::contact
