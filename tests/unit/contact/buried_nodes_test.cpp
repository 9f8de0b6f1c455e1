// SPDX-License-Identifier: LGPL-3.0-or-later
// Master nodes behind the slave.
#include "rubato/contact/buried_nodes.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include <cmath>
#include <string>

namespace rubato::contact::buried_nodes_test {
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

std::vector<double> depths(const test::ModelParts& model, double x, double y, double least = 0) {
  Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.dofs.dof_count));
  for (const auto node : model.zones.front().slave.nodes) {
    u[model.dofs.dof(node, 0)] = x;
    u[model.dofs.dof(node, 1)] = y;
  }
  const auto& zone = model.zones.front();
  return BuriedNodes(zone, std::vector(zone.master.nodes.size(), least))
      .depths({&model.mesh, &model.dofs, &u, &u});
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

TEST(BuriedNodes, AreNotLookedAtNearASlaveNode) {
  const auto model = test::model_of(blocks("{master: over, slave: under}"));
  const auto found = depths(model, 0, -0.1, 0.2); // slave nodes at x = 0, 1, 2
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double away =
        std::abs(model.mesh.points[static_cast<std::size_t>(model.zones.front().master.nodes[i])].x() - 1);
    EXPECT_NEAR(found[i], std::hypot(away, 0.1) > 0.2 ? 0.1 : 0, 1e-14) << away;
  }
}

TEST(BuriedNodes, AreFoundWhereverTheyWereBefore) {
  const auto model = test::model_of(blocks("{master: over, slave: under}"));
  const auto& zone = model.zones.front();
  const std::vector<double> shallow(zone.master.nodes.size(), 0.2);
  BuriedNodes buried(zone, shallow);
  Eigen::VectorXd u = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.dofs.dof_count));
  for (const double x : {0.0, -0.7, 0.3, -1.2}) {
    for (const auto node : zone.slave.nodes) {
      u[model.dofs.dof(node, 0)] = x;
      u[model.dofs.dof(node, 1)] = -0.1;
    }
    const contact::Configuration configuration{&model.mesh, &model.dofs, &u, &u};
    EXPECT_EQ(buried.depths(configuration), BuriedNodes(zone, shallow).depths(configuration)) << x;
  }
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
} // namespace rubato::contact::buried_nodes_test
