// SPDX-License-Identifier: LGPL-3.0-or-later
// The nodes of a contact surface, and what its faces have of values given there.
#include "rubato/contact/surface.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace rubato::contact::surface_test {
namespace {

using Eigen::Vector3d;

/// Places that no grid has: node i at (i, i²/10, 0).
mesh::Mesh scattered(int nodes) {
  mesh::Mesh mesh;
  for (int i = 0; i < nodes; ++i)
    mesh.points.emplace_back(i, i * i / 10.0, 0);
  return mesh;
}

Face triangle(mesh::NodeIndex a, mesh::NodeIndex b, mesh::NodeIndex c) {
  Face face;
  face.type = CellType::tria3;
  face.node_count = 3;
  face.nodes = {a, b, c};
  return face;
}

/// Two triangles with a common edge, and nodes of the mesh that belong to neither.
Surface two_triangles(const mesh::Mesh& mesh) {
  return make_surface(mesh, {triangle(8, 2, 5), triangle(5, 2, 1)});
}

TEST(ASurface, HasTheNodesOfItsFacesAscending) {
  const auto mesh = scattered(10);
  const auto surface = two_triangles(mesh);
  EXPECT_EQ(surface.nodes, (std::vector<mesh::NodeIndex>{1, 2, 5, 8}));
  EXPECT_EQ(surface.position_of(5), 2);
  EXPECT_EQ(surface.position_of(3), -1);
  EXPECT_EQ(surface.position_of(9), -1);
  EXPECT_EQ(surface.position_of(-1), -1);
  EXPECT_EQ(surface.faces_of_node, (std::vector<std::vector<int>>{{1}, {0, 1}, {0, 1}, {0}}));
}

TEST(ASurface, KnowsItsShortestAndItsLongestEdge) {
  const auto mesh = scattered(10);
  const auto surface = two_triangles(mesh);
  EXPECT_EQ(surface.shortest_edge, (mesh.points[2] - mesh.points[1]).norm());
  EXPECT_EQ(surface.longest_edge, (mesh.points[8] - mesh.points[2]).norm());
}

TEST(TheUndeformedPlacesOfASurface, AreThoseOfItsNodesByPosition) {
  const auto mesh = scattered(10);
  const auto& p = mesh.points;
  EXPECT_EQ(undeformed_places(mesh, two_triangles(mesh)), (std::vector{p[1], p[2], p[5], p[8]}));
}

TEST(TheValuesOfAFace, AreThoseOfItsNodesInTheirOrderInTheFace) {
  const auto mesh = scattered(10);
  const auto surface = two_triangles(mesh);
  const std::vector<Vector3d> values{{1, 10, 100}, {2, 20, 200}, {5, 50, 500}, {8, 80, 800}};
  const auto of_first = values_of(surface.faces[0], values);
  ASSERT_EQ(of_first.cols(), 3);
  EXPECT_EQ(of_first.col(0), values[3]);
  EXPECT_EQ(of_first.col(1), values[1]);
  EXPECT_EQ(of_first.col(2), values[2]);
}

/// Where a node stands in a surface twice, each face has the value at its own position.
TEST(TheValuesOfAFace, AreAskedForByPositionNotByNode) {
  auto face = triangle(7, 7, 7);
  face.positions = {2, 0, 1};
  const std::vector<Vector3d> values{{1, 0, 0}, {0, 2, 0}, {0, 0, 3}};
  const auto of_face = values_of(face, values);
  EXPECT_EQ(of_face.col(0), values[2]);
  EXPECT_EQ(of_face.col(1), values[0]);
  EXPECT_EQ(of_face.col(2), values[1]);
}

} // namespace
} // namespace rubato::contact::surface_test
