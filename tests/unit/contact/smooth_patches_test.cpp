// SPDX-License-Identifier: LGPL-3.0-or-later
// A surface whose nodes at sharp edges stand in it once for every smooth side.
#include "rubato/contact/smooth_patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;

/// The skin of the unit cube: node i stands at its bits.
mesh::Mesh cube() {
  mesh::Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  return mesh;
}

std::vector<Face> skin() {
  std::vector<Face> faces;
  for (const auto& nodes : std::array<std::array<mesh::NodeIndex, 4>, 6>{
           {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}}) {
    Face face;
    face.type = CellType::quad4;
    face.node_count = 4;
    std::ranges::copy(nodes, face.nodes.begin());
    faces.push_back(face);
  }
  return faces;
}

TEST(ACubeWithSplitEdges, HasEveryNodeOnceAFace) {
  const auto mesh = cube();
  const auto split = with_split_edges(make_surface(mesh, skin()), mesh.points);
  ASSERT_EQ(split.nodes.size(), 24U);
  EXPECT_TRUE(std::ranges::is_sorted(split.nodes));
  std::set<int> positions;
  for (std::size_t f = 0; f < split.faces.size(); ++f)
    for (std::size_t i = 0; i < 4; ++i) {
      const int position = split.faces[f].positions[i];
      EXPECT_TRUE(positions.insert(position).second);
      EXPECT_EQ(split.nodes[static_cast<std::size_t>(position)], split.faces[f].nodes[i]);
      EXPECT_EQ(split.faces_of_node[static_cast<std::size_t>(position)], std::vector{static_cast<int>(f)});
    }
}

/// A roof: its ridge is as sharp as the slopes are steep.
TEST(ARoof, IsSplitAtItsRidgeIfThatIsSharp) {
  for (const auto& [height, nodes] : {std::pair(0.5, 6U), std::pair(0.7, 8U)}) {
    mesh::Mesh mesh;
    for (const double y : {0.0, 1.0})
      for (const double x : {-1.0, 0.0, 1.0})
        mesh.points.emplace_back(x, y, x == 0 ? height : 0);
    std::vector<Face> faces;
    for (const mesh::NodeIndex first : {0, 1}) {
      Face face;
      face.type = CellType::quad4;
      face.node_count = 4;
      face.nodes = {first, first + 1, first + 4, first + 3};
      faces.push_back(face);
    }
    EXPECT_EQ(with_split_edges(make_surface(mesh, faces), mesh.points).nodes.size(), nodes) << height;
  }
}

} // namespace
} // namespace rubato::contact
