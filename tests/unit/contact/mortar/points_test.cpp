// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/points.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include "patch/contact_blocks.hpp"
#include "support/model_of.hpp"
#include <cmath>
#include <string>
#include <vector>

namespace rubato::points_test {
namespace {

using contact::mortar::least_kept_share;
using contact::mortar::Points;
using Eigen::VectorXd;

/// Two blocks of side 1; the upper one, the slave, with three faces.
class SlidingBlock : public testing::Test {
protected:
  SlidingBlock()
      : model_(test::model_of(test::deck_of({CellType::quad4, 3, 4, 0, ", integration: mortar"}))),
        start_(VectorXd::Zero(model_.dofs.dof_count)), points_(model_.zones.front()) {}

  /// Whether the slave's last node is kept with the upper block moved along the lower one so far that the
  /// given part of the node's weight is covered.
  bool keeps_last(double share) {
    const double covered = std::sqrt(share) / 3; // ∫H over the inner end of the node's only face
    VectorXd u = start_;
    for (const auto node : mesh::nodes_named(model_.mesh, "upper"))
      u[model_.dofs.dof(node, 0)] = 1.0 / 3 - covered;
    points_.update({&model_.mesh, &model_.dofs, &u, &start_, 1, start_t_});
    const auto& nodes = model_.zones.front().slave.nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (model_.mesh.points[static_cast<std::size_t>(nodes[i])].x() > 0.99)
        return points_.operators().nodes[i].kept();
    ADD_FAILURE() << "no last node";
    return false;
  }

  /// Kept with a little more, dropped with a little less.
  void expect_border_at(double share) {
    EXPECT_TRUE(keeps_last(1.01 * share)) << share;
    EXPECT_FALSE(keeps_last(0.99 * share)) << share;
  }

  test::BuiltModel model_;
  VectorXd start_;
  double start_t_ = 0;
  Points points_;
};

TEST_F(SlidingBlock, KeepsNodesFromATwentiethOfTheirWeightOn) {
  EXPECT_TRUE(keeps_last(0.5));
  EXPECT_TRUE(keeps_last(1.01 * least_kept_share));
  EXPECT_FALSE(keeps_last(0.99 * least_kept_share));
}

TEST_F(SlidingBlock, AsksAnotherShareOfANodeThatIterationsTakeToAndFro) {
  expect_border_at(least_kept_share);
  expect_border_at(least_kept_share);
  EXPECT_TRUE(keeps_last(0.99 * least_kept_share));
  for (const double share : {0.5 * least_kept_share, 0.1, 0.2, 0.4})
    expect_border_at(share);
  EXPECT_TRUE(keeps_last(0.01)); // nothing settles it
}

TEST_F(SlidingBlock, ForgetsInTheNextStepWhatItAsked) {
  expect_border_at(least_kept_share);
  expect_border_at(least_kept_share);
  EXPECT_TRUE(keeps_last(0.99 * least_kept_share));
  start_t_ = 0.5;
  expect_border_at(least_kept_share);
}

/// Two beams on one another, 4 long and 1 wide, the lower one the slave with four faces.
test::BuiltModel beams(const std::string& lower_support) {
  return test::model_of(R"(
physics: plane_stress
mesh:
  generate:
    - {name: lower, rectangle: {from: [0, -1], to: [4, 0]}, divisions: [4, 1], cells: quad8, sides: {left: lower_end, bottom: lower_foot, top: slave}}
    - {name: upper, rectangle: {from: [0, 0], to: [4, 1]}, divisions: [3, 1], cells: quad8, sides: {left: upper_end, bottom: master}}
materials: {steel: {young: 1000, poisson: 0.3}}
supports: [{on: upper_end, fix: [x, y]}, )" +
                        lower_support + R"(]
contact: {rest: {master: master, slave: slave}}
time: {scheme: static, step: 1, end: 1}
)");
}

struct KeptNodes {
  std::vector<double> dropped; ///< where [x]
  double weight = 0;
  double lost = 0;
};

KeptNodes kept_of(const test::ModelParts& model) {
  const VectorXd rest = VectorXd::Zero(model.dofs.dof_count);
  Points points(model.zones.front());
  points.update({&model.mesh, &model.dofs, &rest, &rest, 1, 0});
  KeptNodes found;
  found.lost = points.operators().lost_area;
  const auto& nodes = model.zones.front().slave.nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    found.weight += points.operators().nodes[i].weight;
    if (!points.operators().nodes[i].kept())
      found.dropped.push_back(model.mesh.points[static_cast<std::size_t>(nodes[i])].x());
  }
  return found;
}

TEST(ClampedEnds, LeaveTheirFunctionsToTheirNeighbours) {
  const auto found = kept_of(beams("{on: lower_end, fix: [x, y]}"));
  EXPECT_EQ(found.dropped, std::vector{0.0});
  EXPECT_NEAR(found.weight, 4, 1e-12);
  EXPECT_EQ(found.lost, 0);
}

TEST(ClampedEnds, KeepThemWhereASupportHoldsOneComponentOnly) {
  const auto found = kept_of(beams("{on: lower_end, fix: [x]}, {on: lower_foot, fix: [y]}"));
  EXPECT_TRUE(found.dropped.empty());
}

TEST(ClampedEnds, AreNotTheNodesOfASurfaceThatIsClampedWhole) {
  const auto found = kept_of(beams("{on: lower, fix: [x, y]}"));
  EXPECT_TRUE(found.dropped.empty());
  EXPECT_NEAR(found.weight, 4, 1e-12);
}

} // namespace
} // namespace rubato::points_test
