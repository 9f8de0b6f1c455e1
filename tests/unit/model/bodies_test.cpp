// SPDX-License-Identifier: LGPL-3.0-or-later
// Which nodes belong to one body.
#include "rubato/model/bodies.hpp"

#include <gtest/gtest.h>

#include "unit/model/meshes.hpp"
#include <array>
#include <vector>

namespace rubato::model::bodies_test {
namespace {

/// Squares on these lists of nodes, which lie anywhere, and edges that belong to no body.
Bodies bodies_of(int nodes, const std::vector<std::array<int, 4>>& squares,
                 const std::vector<std::array<int, 2>>& edges = {}) {
  mesh::MeshBuilder builder(2);
  for (int i = 0; i < nodes; ++i)
    builder.add_node(Eigen::Vector3d(i, 0, 0));
  for (const auto& square : squares)
    builder.add_cell(CellType::quad4, square);
  for (const auto& edge : edges)
    builder.add_cell(CellType::seg2, edge);
  const auto mesh = std::move(builder).build();
  std::vector<Fault> faults;
  return {mesh, make_bulk(test::plane_study({test::elastic("any")}), mesh, faults)};
}

std::vector<int> body_of_each_node(const Bodies& bodies, int nodes) {
  std::vector<int> of;
  for (int node = 0; node < nodes; ++node)
    of.push_back(bodies.of(node));
  return of;
}

TEST(Bodies, AreConnectedByOneSharedNode) {
  const auto bodies = bodies_of(7, {{0, 1, 2, 3}, {3, 4, 5, 6}});
  EXPECT_EQ(bodies.count(), 1);
  EXPECT_EQ(body_of_each_node(bodies, 7), (std::vector<int>(7, 0)));
}

TEST(Bodies, AreNumberedInTheOrderOfTheirFirstCells) {
  const auto bodies = bodies_of(12, {{4, 5, 6, 7}, {0, 1, 2, 3}, {8, 9, 10, 11}});
  EXPECT_EQ(bodies.count(), 3);
  EXPECT_EQ(body_of_each_node(bodies, 12), (std::vector<int>{1, 1, 1, 1, 0, 0, 0, 0, 2, 2, 2, 2}));
  EXPECT_EQ(bodies.first_node(0), 4);
  EXPECT_EQ(bodies.first_node(1), 0);
  EXPECT_EQ(bodies.first_node(2), 8);
}

TEST(Bodies, ThatALaterCellJoinsAreOne) {
  const auto bodies = bodies_of(12, {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}, {9, 6, 5, 2}});
  EXPECT_EQ(bodies.count(), 1);
  EXPECT_EQ(bodies.first_node(0), 0);
}

TEST(Bodies, AreNotConnectedByEdgesAndHaveNoNodesWithoutCells) {
  const auto bodies = bodies_of(10, {{0, 1, 2, 3}, {4, 5, 6, 7}}, {{3, 4}, {7, 9}});
  EXPECT_EQ(bodies.count(), 2);
  EXPECT_EQ(body_of_each_node(bodies, 10), (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1, -1, -1}));
}

} // namespace
} // namespace rubato::model::bodies_test
