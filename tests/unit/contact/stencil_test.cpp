// SPDX-License-Identifier: LGPL-3.0-or-later
// A stencil's gather and scatter are transposes of one another, numbered anew too.
#include "rubato/contact/stencil.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rubato::contact::stencil_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Four nodes of three components; the stencil is on three of them.
struct FourNodes {
  domain::DofMap dofs{.components = 3, .first_dof = {0, 3, 6, 9}, .dof_count = 12, .nodes = {0, 1, 2, 3}};
  Stencil stencil{.nodes = {3, 0, 1}, .weights = Vector3d(1, -0.25, -0.75), .components = 3};
  VectorXd values = VectorXd::LinSpaced(12, 0.3, -1.7).array().square();
};

TEST(Stencil, GathersWeightedValuesOfItsNodes) {
  const FourNodes four;
  const auto at = [&](mesh::NodeIndex node) { return Vector3d(four.values.segment<3>(3 * node)); };
  const Vector3d expected = at(3) - 0.25 * at(0) - 0.75 * at(1);
  EXPECT_LT((four.stencil.gather(four.values, four.dofs) - expected).norm(), 1e-15);
  EXPECT_LT((four.stencil.sum(at) - expected).norm(), 1e-15);
  EXPECT_EQ(four.stencil.unknowns(), 9);
}

TEST(Stencil, ScattersWhatGatherIsTheTransposeOf) {
  const FourNodes four;
  const Vector3d force(0.7, -2, 3);
  VectorXd scattered = VectorXd::Zero(12);
  four.stencil.scatter(force, four.dofs, scattered);
  EXPECT_NEAR(scattered.dot(four.values), force.dot(four.stencil.gather(four.values, four.dofs)), 1e-14);
  EXPECT_EQ(scattered.segment<3>(6), Vector3d::Zero());
}

TEST(Stencil, OnDofsNumberedAnewLeavesOutThoseWithoutANumber) {
  const FourNodes four;
  // Node 0 has no number at all, node 3 none along y.
  const std::vector<int> number{-1, -1, -1, 4, 3, 2, -1, -1, -1, 0, -1, 1};
  NumberedStencil numbered;
  numbered.take(four.stencil, four.dofs, number);
  EXPECT_EQ(numbered.nodes.size(), 2U);
  const VectorXd values = VectorXd::LinSpaced(5, 1, 2);
  EXPECT_LT((numbered.gather(values) -
             Vector3d(values[0] - 0.75 * values[4], -0.75 * values[3], values[1] - 0.75 * values[2]))
                .norm(),
            1e-15);
  const Vector3d force(0.7, -2, 3);
  VectorXd one = VectorXd::Zero(5), other = VectorXd::Zero(5);
  numbered.scatter(force, one);
  four.stencil.scatter(force, four.dofs, number, other);
  EXPECT_EQ(one, other);
  EXPECT_NEAR(one.dot(values), force.dot(numbered.gather(values)), 1e-14);
}

TEST(NumberedStencil, HasNoNodesWithoutWeight) {
  FourNodes four;
  four.stencil.weights = Vector3d(1, 0, -1);
  NumberedStencil numbered;
  numbered.take(four.stencil, four.dofs, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11});
  EXPECT_EQ(numbered.nodes.size(), 2U);
}

} // namespace
} // namespace rubato::contact::stencil_test
