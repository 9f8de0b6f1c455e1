// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/sheet.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace rubato::mesh::sheet_test {
namespace {

using Faces = std::vector<CellIndex>;

Mesh strip(const std::vector<std::array<NodeIndex, 2>>& segments, NodeIndex nodes) {
  MeshBuilder builder(2);
  for (NodeIndex i = 0; i < nodes; ++i)
    builder.add_node({static_cast<double>(i), 0, 0});
  for (const auto& ends : segments)
    builder.add_cell(CellType::seg2, ends);
  return std::move(builder).build();
}

Faces all_cells(const Mesh& mesh) {
  Faces cells;
  for (CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
    cells.push_back(cell);
  return cells;
}

TEST(Sheet, OfSegmentsLooksToOneSide) {
  const auto mesh = strip({{0, 1}, {2, 1}, {2, 3}, {4, 3}}, 5);
  const auto sheets = sheets_of(mesh, all_cells(mesh));
  EXPECT_TRUE(sheets.faults.empty());
  EXPECT_EQ(sheets.count, 1);
  for (const auto& face : sheets.faces)
    EXPECT_EQ(normal_of(mesh, face), normal_of(mesh, sheets.faces.front()));
}

TEST(Sheet, ThatDoesNotHangTogetherIsSeveral) {
  const auto mesh = strip({{0, 1}, {2, 3}, {3, 4}}, 5);
  const auto sheets = sheets_of(mesh, all_cells(mesh));
  EXPECT_EQ(sheets.count, 2);
  EXPECT_NE(sheets.sheet_of_face[0], sheets.sheet_of_face[1]);
  EXPECT_EQ(sheets.sheet_of_face[1], sheets.sheet_of_face[2]);
}

TEST(Sheet, WithThreeFacesAtABorderIsToldOf) {
  const auto mesh = strip({{0, 1}, {1, 2}, {1, 3}}, 4);
  const auto sheets = sheets_of(mesh, all_cells(mesh));
  ASSERT_EQ(sheets.faults.size(), 1U);
  EXPECT_EQ(sheets.faults.front(), "more than two faces meet at 1 of its nodes");
}

/// A band of quadrangles round an axis, closed with or without half a turn.
Mesh band(bool twisted) {
  constexpr int parts = 8;
  MeshBuilder builder(3);
  for (int i = 0; i < parts; ++i) {
    const double angle = 2 * std::numbers::pi * i / parts;
    for (const double z : {0.0, 1.0})
      builder.add_node({std::cos(angle), std::sin(angle), z});
  }
  for (int i = 0; i < parts; ++i) {
    const int next = (i + 1) % parts;
    const int swap = twisted && next == 0 ? 1 : 0;
    std::array<NodeIndex, 4> corners{2 * i, 2 * i + 1, 2 * next + 1 - swap, 2 * next + swap};
    if (i % 3 == 1)
      std::swap(corners[1], corners[3]);
    builder.add_cell(CellType::quad4, corners);
  }
  return std::move(builder).build();
}

TEST(Sheet, OfQuadranglesLooksOutOrIn) {
  const auto mesh = band(false);
  const auto sheets = sheets_of(mesh, all_cells(mesh));
  EXPECT_TRUE(sheets.faults.empty());
  const auto outwards = [&](const SurfaceFace& face) {
    return normal_of(mesh, face).dot(centre_of(mesh, face) - Eigen::Vector3d(0, 0, 0.5));
  };
  for (const auto& face : sheets.faces)
    EXPECT_GT(outwards(face) * outwards(sheets.faces.front()), 0);
}

TEST(Sheet, WithOneSideIsToldOf) {
  const auto mesh = band(true);
  const auto sheets = sheets_of(mesh, all_cells(mesh));
  ASSERT_EQ(sheets.faults.size(), 1U);
  EXPECT_NE(sheets.faults.front().find("has one side only"), std::string::npos);
}

TEST(Sheet, TurnedLooksToTheOtherSide) {
  for (const auto& mesh : {strip({{0, 1}}, 2), band(false)}) {
    auto face = sheets_of(mesh, all_cells(mesh)).faces.front();
    const Eigen::Vector3d before = normal_of(mesh, face);
    turn(face);
    EXPECT_LE((normal_of(mesh, face) + before).norm(), 1e-15);
  }
}

} // namespace
} // namespace rubato::mesh::sheet_test
