// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/points.hpp"

#include <gtest/gtest.h>

#include "patch/contact_blocks.hpp"
#include "support/model_of.hpp"
#include <cmath>

namespace rubato {
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

  model::Model model_;
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

} // namespace
} // namespace rubato
