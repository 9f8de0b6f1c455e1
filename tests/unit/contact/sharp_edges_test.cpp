// SPDX-License-Identifier: LGPL-3.0-or-later
// The smooth parts of a surface, and the surface whose nodes at sharp edges stand in it once for each.
#include "rubato/contact/sharp_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>
#include <vector>

namespace rubato::contact::sharp_edges_test {
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

/// Heights of a line of nodes at x = 0, 1, …: a sheet that is bent along them; `order` gives its
/// slopes.
struct Folded {
  mesh::Mesh mesh;
  std::vector<Face> faces;
};

Folded folded(const std::vector<double>& heights, const std::vector<mesh::NodeIndex>& order) {
  Folded sheet;
  const auto count = static_cast<mesh::NodeIndex>(heights.size());
  for (const double y : {0.0, 1.0})
    for (mesh::NodeIndex i = 0; i < count; ++i)
      sheet.mesh.points.emplace_back(i, y, heights[static_cast<std::size_t>(i)]);
  for (const auto first : order) {
    Face face;
    face.type = CellType::quad4;
    face.node_count = 4;
    face.nodes = {first, first + 1, first + 1 + count, first + count};
    sheet.faces.push_back(face);
  }
  return sheet;
}

std::vector<std::size_t> parts_of(const Folded& sheet) {
  const auto surface = make_surface(sheet.mesh, sheet.faces);
  return smooth_parts(surface, undeformed_places(sheet.mesh, surface));
}

/// A roof: its ridge is as sharp as the slopes are steep.
TEST(ARoof, IsSplitAtItsRidgeIfThatIsSharp) {
  for (const auto& [height, nodes, parts] : {std::tuple(0.5, 6U, 1U), std::tuple(0.7, 8U, 2U)}) {
    const auto roof = folded({0, height, 0}, {0, 1});
    EXPECT_EQ(with_split_edges(make_surface(roof.mesh, roof.faces), roof.mesh.points).nodes.size(), nodes)
        << height;
    EXPECT_EQ(parts_of(roof).back() + 1, parts) << height;
  }
}

TEST(TheSmoothParts, OfACubeAreItsFaces) {
  const auto mesh = cube();
  EXPECT_EQ(smooth_parts(make_surface(mesh, skin()), mesh.points),
            (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

/// Sharp at nodes 2 and 5 of 0 to 7, and bent at others.
TEST(TheSmoothParts, AreNumberedInTheOrderOfTheirFirstFaces) {
  const std::vector<double> heights{0, 0.3, 0.5, -1, -2, -3, 0, 3};
  EXPECT_EQ(parts_of(folded(heights, {0, 1, 2, 3, 4, 5, 6})),
            (std::vector<std::size_t>{0, 0, 1, 1, 1, 2, 2}));
  EXPECT_EQ(parts_of(folded(heights, {6, 4, 1, 5, 0, 3, 2})),
            (std::vector<std::size_t>{0, 1, 2, 0, 2, 1, 1}));
}

/// Neighbours turn by 45° each, the first and the last of them by 135°.
TEST(TheSmoothParts, ReachAsFarAroundAsNeighboursAreSmooth) {
  mesh::Mesh mesh;
  std::vector<Face> faces;
  for (const double z : {0.0, 1.0})
    for (int i = 0; i < 5; ++i)
      mesh.points.emplace_back(std::cos(i * std::numbers::pi / 4), std::sin(i * std::numbers::pi / 4), z);
  for (const mesh::NodeIndex first : {3, 0, 2, 1}) {
    Face face;
    face.type = CellType::quad4;
    face.node_count = 4;
    face.nodes = {first, first + 1, first + 6, first + 5};
    faces.push_back(face);
  }
  const auto surface = make_surface(mesh, faces);
  EXPECT_EQ(smooth_parts(surface, mesh.points), std::vector<std::size_t>(4, 0));
}

/// In the plane edges are nodes.
TEST(TheSmoothParts, OfALineEndAtItsSharpCorners) {
  mesh::Mesh mesh;
  mesh.dimension = 2;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0.5, 0}, {2, 2, 0}};
  std::vector<Face> faces;
  for (const mesh::NodeIndex first : {0, 1, 2}) {
    Face face;
    face.node_count = 2;
    face.nodes = {first, first + 1};
    faces.push_back(face);
  }
  EXPECT_EQ(smooth_parts(make_surface(mesh, faces), mesh.points), (std::vector<std::size_t>{0, 0, 1}));
}

} // namespace
} // namespace rubato::contact::sharp_edges_test
