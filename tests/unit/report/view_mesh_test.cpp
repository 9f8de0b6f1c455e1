// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/generate.hpp"
#include "rubato/report/view_mesh.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "unit/mesh_io/one_cell.hpp"
#include <algorithm>
#include <set>

namespace rubato::report::view_mesh_test {
namespace {

Eigen::Vector3d corner(const mesh::Mesh& mesh, const ViewMesh& view, std::size_t i) {
  return mesh.points[static_cast<std::size_t>(view.nodes[view.corners[i]])];
}

/// Volume inside the triangles, or their area in a plane; negative when they turn the wrong way round.
double measure_of(const mesh::Mesh& mesh, const ViewMesh& view) {
  double sum = 0;
  for (std::size_t i = 0; i < view.corners.size(); i += 3) {
    const auto a = corner(mesh, view, i);
    const auto b = corner(mesh, view, i + 1);
    const auto c = corner(mesh, view, i + 2);
    sum += view.dimension == 2 ? 0.5 * (b - a).cross(c - a).z() : a.dot(b.cross(c)) / 6.0;
  }
  return sum;
}

study::Body grid(const std::string& name, int dimension, std::array<double, 3> from, CellType cells) {
  study::Body body;
  body.name = name;
  body.dimension = dimension;
  body.from = from;
  body.to = {from[0] + 1, from[1] + 1, from[2] + 1};
  body.divisions = {2, 2, 2};
  body.cells = cells;
  return body;
}

TEST(TheView, EnclosesTheVolumeOfEveryKindOfCell) {
  for (const auto& shape : cell::all_topologies()) {
    if (shape.dimension < 2)
      continue;
    const auto mesh = test::one_cell(shape.type, shape.dimension);
    const auto view = view_mesh(mesh);
    EXPECT_NEAR(measure_of(mesh, view), test::measure(shape.type, mesh.points), 1e-12) << shape.name;
    EXPECT_EQ(view.face_count, shape.dimension == 2 ? 1U : shape.sides.size()) << shape.name;
  }
}

TEST(TheView, HasEveryEdgeOnceInPiecesBetweenNodes) {
  for (const auto& shape : cell::all_topologies()) {
    if (shape.dimension < 2)
      continue;
    const auto view = view_mesh(test::one_cell(shape.type, shape.dimension));
    EXPECT_EQ(view.ends.size(), 2 * shape.edges.size() * static_cast<std::size_t>(shape.order)) << shape.name;
    std::set<std::pair<std::uint32_t, std::uint32_t>> pieces;
    for (std::size_t i = 0; i < view.ends.size(); i += 2)
      pieces.insert(std::minmax(view.ends[i], view.ends[i + 1]));
    EXPECT_EQ(2 * pieces.size(), view.ends.size()) << shape.name;
  }
}

TEST(TheView, LeavesOutWhatIsInsideOfBodies) {
  const auto box = grid("box", 3, {0, 0, 0}, CellType::hexa8);
  const auto mesh = mesh::generate(std::array{box});
  const auto view = view_mesh(mesh);
  EXPECT_EQ(mesh.node_count(), 27);
  EXPECT_EQ(view.nodes.size(), 26U);
  EXPECT_EQ(view.face_count, 24U);
  EXPECT_TRUE(std::ranges::is_sorted(view.nodes));
  EXPECT_TRUE(std::ranges::all_of(view.corners, [&](auto node) { return node < view.nodes.size(); }));
}

TEST(TheView, HasAllCellsOfAPlane) {
  const auto mesh = mesh::generate(std::array{grid("sheet", 2, {0, 0, 0}, CellType::quad9)});
  const auto view = view_mesh(mesh);
  EXPECT_EQ(view.nodes.size(), mesh.points.size());
  EXPECT_EQ(view.face_count, 4U);
  EXPECT_NEAR(measure_of(mesh, view), 1.0, 1e-12);
}

TEST(TheView, TellsBodiesApart) {
  const auto mesh = mesh::generate(
      std::array{grid("one", 3, {0, 0, 0}, CellType::hexa8), grid("other", 3, {1, 0, 0}, CellType::tetra4)});
  const auto view = view_mesh(mesh);
  EXPECT_EQ(view.body_count, 2);
  for (std::size_t i = 0; i < view.nodes.size(); ++i)
    EXPECT_EQ(view.bodies[i], view.nodes[i] < 27 ? 0 : 1);
}

TEST(TheView, OfAMeshOfPointsIsEmpty) {
  const auto view = view_mesh(test::one_cell(CellType::point1, 3));
  EXPECT_TRUE(view.nodes.empty());
  EXPECT_EQ(view.face_count, 0U);
  EXPECT_EQ(view.body_count, 0);
}

} // namespace
} // namespace rubato::report::view_mesh_test
