// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_nodes.hpp"
#include "rubato/mesh/interpolation.hpp"
#include "rubato/mesh/quality.hpp"

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace rubato::mesh::quality_test {
namespace {

using namespace test;
using Eigen::Vector3d;

double jacobian_of(CellType type, const std::vector<Vector3d>& points) {
  std::vector<NodeIndex> nodes(points.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  return scaled_jacobian(type, nodes, points, cell::topology(type).dimension).value();
}

std::vector<Vector3d> reference_points(CellType type) {
  std::vector<Vector3d> points(static_cast<std::size_t>(cell::topology(type).node_count));
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = cell::reference_node(type, static_cast<int>(i));
  return points;
}

TEST(ScaledJacobian, IsOneForTheIdealCell) {
  const double h = std::sqrt(3.) / 2;
  const std::vector<Vector3d> triangle{{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}};
  EXPECT_NEAR(jacobian_of(CellType::tria3, triangle), 1, 1e-14);
  EXPECT_NEAR(jacobian_of(CellType::tetra4, {{1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1}}), 1, 1e-14);
  EXPECT_NEAR(
      jacobian_of(CellType::penta6, {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, h, 1}}),
      1, 1e-14);
  EXPECT_NEAR(
      jacobian_of(CellType::pyra5, {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, std::sqrt(2.)}}),
      1, 1e-14);
  for (const auto type : {CellType::quad4, CellType::quad8, CellType::quad9, CellType::hexa8,
                          CellType::hexa20, CellType::hexa27})
    EXPECT_NEAR(jacobian_of(type, reference_points(type)), 1, 1e-14) << cell::topology(type).name;
}

TEST(ScaledJacobian, IsTheSineOfTheSharpestAngleOfAParallelogram) {
  EXPECT_NEAR(jacobian_of(CellType::quad4, {{0, 0, 0}, {5, 0, 0}, {6, 1, 0}, {1, 1, 0}}), std::sqrt(0.5),
              1e-14);
}

TEST(ScaledJacobian, IsNegativeForMirroredCells) {
  for (const auto type : all_types()) {
    auto points = reference_points(type);
    EXPECT_GT(jacobian_of(type, points), 0) << cell::topology(type).name;
    for (auto& point : points)
      point.x() = -point.x();
    EXPECT_LT(jacobian_of(type, points), 0) << cell::topology(type).name;
    EXPECT_GE(jacobian_of(type, points), -1) << cell::topology(type).name;
  }
}

TEST(ScaledJacobian, SeesAMiddleNodeBeyondTheQuarterPoint) {
  auto points = reference_points(CellType::hexa20);
  points[8].x() = -0.6; // of edge 0–1, the quarter point being −0.5
  EXPECT_LT(jacobian_of(CellType::hexa20, points), 0);
}

TEST(ScaledJacobian, IsPositiveForASurfaceInSpaceWhateverItsDirection) {
  const std::vector<Vector3d> points{{0, 0, 0}, {0, 0, 1}, {0, 1, 1}, {0, 1, 0}};
  const std::vector<NodeIndex> nodes{0, 1, 2, 3};
  EXPECT_NEAR(scaled_jacobian(CellType::quad4, nodes, points, 3).value(), 1, 1e-14);
  EXPECT_FALSE(scaled_jacobian(CellType::seg2, nodes, points, 3).has_value());
}

TEST(MeshReport, OfASoundMeshFindsNothingWrong) {
  for (const auto type : all_types()) {
    const auto mesh = mesh_of(type);
    const auto report = examine(mesh);
    EXPECT_TRUE(report.looks_right()) << to_text(report);
    EXPECT_EQ(report.nodes, mesh.node_count());
    EXPECT_EQ(report.connected_bodies, 1);
    EXPECT_EQ(report.upper, Vector3d(2, 1, mesh.dimension == 3 ? 3 : 0));
    EXPECT_NEAR(report.bulk_measure, mesh.dimension == 3 ? 6 : 2, 1e-13);
    EXPECT_NEAR(report.shortest_edge, 1. / 3, 1e-15);
    EXPECT_EQ(report.coincident_between_bodies, 0);
  }
}

TEST(MeshReport, CountsCellsGroupsAndTheirDimensions) {
  const auto report = examine(mesh_of(CellType::hexa8));
  ASSERT_EQ(report.types.size(), 3U);
  EXPECT_EQ(report.types[2].type, CellType::hexa8);
  EXPECT_EQ(report.types[2].count, 12);
  EXPECT_NEAR(report.types[2].mean_jacobian, 1, 1e-14);
  EXPECT_FALSE(report.types[0].has_jacobian);
  const auto group = [&](const std::string& name) {
    return *std::ranges::find(report.groups, name, &GroupSummary::name);
  };
  EXPECT_EQ(group("body").dimension, 3);
  EXPECT_EQ(group("top").dimension, 2);
  EXPECT_EQ(group("top").count, 4U);
  EXPECT_EQ(group("rim").dimension, 1);
  EXPECT_EQ(group("tip").kind, GroupSummary::Kind::nodes);
}

TEST(MeshReport, NotesCoincidentNodesOfDifferentBodiesAsFine) {
  const auto report = examine(generate(two_beams(CellType::quad4)));
  EXPECT_TRUE(report.looks_right());
  EXPECT_EQ(report.connected_bodies, 2);
  EXPECT_EQ(report.coincident_between_bodies, 21);
  EXPECT_NE(to_text(report).find("21 coincident nodes of different bodies: fine for contact"),
            std::string::npos);
}

TEST(MeshReport, FindsFreeAndDuplicateNodes) {
  auto mesh = mesh_of(CellType::quad4);
  mesh.points.push_back(mesh.points[3]);
  mesh.node_numbers.push_back(777);
  const auto report = examine(mesh);
  EXPECT_FALSE(report.looks_right());
  EXPECT_EQ(report.free_nodes.first, std::vector<std::string>{"777"});
  EXPECT_EQ(report.duplicate_nodes.first, std::vector<std::string>{"777"});
}

TEST(MeshReport, FindsInvertedCellsAndTheWorstOne) {
  auto mesh = mesh_of(CellType::hexa8);
  auto& hexahedra = mesh.blocks.back();
  hexahedra.numbers[4] = 4711;
  constexpr std::size_t first_node = 32; // of the fifth hexahedron
  std::swap(hexahedra.nodes[first_node], hexahedra.nodes[first_node + 1]);
  const auto report = examine(mesh);
  EXPECT_EQ(report.inverted_cells.first, std::vector<std::string>{"4711"});
  EXPECT_EQ(report.types.back().worst_cell, "4711");
  EXPECT_NE(to_text(report).find("1 inverted or flat cells: 4711"), std::string::npos) << to_text(report);
}

/// A corner is drawn towards the diagonal across it, where the cell is flat.
TEST(MeshReport, FindsNearlyFlatCells) {
  for (const double part : {0.005, 0.02, 0.5}) {
    auto mesh = mesh_of(CellType::quad4);
    const auto cell = mesh.blocks.back().cell(0);
    const auto at = [&](std::size_t i) -> Vector3d& {
      return mesh.points[static_cast<std::size_t>(cell[i])];
    };
    const Vector3d middle = 0.5 * (at(1) + at(3));
    at(0) = middle + part * (at(0) - middle);
    const auto report = examine(mesh);
    EXPECT_EQ(report.inverted_cells.count, 0) << part;
    EXPECT_EQ(report.flat_cells.count, part < 0.1 ? 1 : 0) << part;
    EXPECT_EQ(report.looks_right(), part > 0.1) << part;
    EXPECT_EQ(to_text(report).find("1 nearly flat cells (scaled Jacobian below 0.1): ") != std::string::npos,
              part < 0.1);
  }
}

TEST(MeshReport, CallsCellsThatARunMendsReversedAndNotInverted) {
  for (const auto type : {CellType::quad8, CellType::hexa20}) {
    SCOPED_TRACE(cell::topology(type).name);
    auto mesh = mesh_of(type);
    const auto before = examine(mesh);
    EXPECT_EQ(before.reversed_cells.count, 0);
    for (auto& point : mesh.points)
      point.x() = -point.x();
    const auto report = examine(mesh);
    EXPECT_EQ(report.reversed_cells.count, mesh.blocks.back().cell_count());
    EXPECT_EQ(report.inverted_cells.count, 0);
    EXPECT_TRUE(report.looks_right());
    EXPECT_DOUBLE_EQ(report.bulk_measure, before.bulk_measure);
    EXPECT_GT(report.types.back().smallest_jacobian, 0);
    EXPECT_NE(to_text(report).find("reversed cells, mended in a run: "), std::string::npos)
        << to_text(report);
  }
}

TEST(MeshReport, CallsNodesAndCellsByTheNamesOfTheFile) {
  auto mesh = mesh_of(CellType::quad4);
  mesh.points.emplace_back(5, 5, 0);
  mesh.node_numbers.push_back(777);
  mesh.node_names.resize(mesh.points.size(), "other");
  mesh.node_names.back() = "free";
  auto& cells = mesh.blocks.back();
  cells.names.assign(static_cast<std::size_t>(cells.cell_count()), "Q");
  const auto report = examine(mesh);
  EXPECT_EQ(report.free_nodes.first, std::vector<std::string>{"free"});
  EXPECT_EQ(report.types.back().worst_cell, "Q");
  EXPECT_NE(to_text(report).find("nodes have names in the file"), std::string::npos);
}

TEST(MeshReport, SaysInWhichPlaneAMeshOfFacesAloneStands) {
  auto mesh = mesh_of(CellType::quad4);
  mesh.dimension = 3;
  for (auto& point : mesh.points)
    std::swap(point.y(), point.z());
  EXPECT_NE(
      to_text(examine(mesh)).find("no solid cells to compute on (all nodes share one y; the plane of a"),
      std::string::npos);
}

TEST(MeshReport, FindsNodesThatAreNowhere) {
  auto mesh = mesh_of(CellType::quad4);
  mesh.points[2].y() = std::numeric_limits<double>::quiet_NaN();
  const auto report = examine(mesh);
  EXPECT_EQ(report.lost_nodes.first, std::vector<std::string>{"3"});
  EXPECT_FALSE(report.looks_right());
}

TEST(MeshReport, FindsEmptyAndMixedGroups) {
  auto mesh = mesh_of(CellType::quad4);
  mesh.cell_groups.push_back({"nothing", {}});
  mesh.cell_groups.push_back({"both", {0, mesh.cell_count() - 1}});
  const auto report = examine(mesh);
  EXPECT_EQ(report.empty_groups, std::vector<std::string>{"nothing"});
  EXPECT_TRUE(report.groups.back().mixed);
  EXPECT_NE(to_text(report).find("empty groups: nothing"), std::string::npos);
}

TEST(MeshReport, FindsLooseCellsAndFacesInsideNoBody) {
  auto mesh = mesh_of(CellType::quad4);
  const auto quad = mesh.blocks.back().cell(0);
  auto& segments = mesh.blocks.front();
  segments.nodes.insert(segments.nodes.end(), {quad[0], quad[2]});
  segments.numbers.push_back(901);
  mesh.points.emplace_back(5, 5, 0);
  mesh.points.emplace_back(6, 5, 0);
  mesh.node_numbers.insert(mesh.node_numbers.end(), {801, 802});
  segments.nodes.insert(segments.nodes.end(), {mesh.node_count() - 2, mesh.node_count() - 1});
  segments.numbers.push_back(902);
  const auto report = examine(mesh);
  EXPECT_EQ(report.unowned_faces.first, std::vector<std::string>{"901"});
  EXPECT_EQ(report.loose_cells.first, std::vector<std::string>{"902"});
}

TEST(MeshReport, OfAnEmptyMeshSaysThatThereIsNothingToComputeOn) {
  const auto report = examine(Mesh{});
  EXPECT_FALSE(report.looks_right());
  EXPECT_NE(to_text(report).find("no solid cells"), std::string::npos);
}

TEST(Findings, ShowOnlyTheFirstFewNumbers) {
  auto mesh = mesh_of(CellType::quad4);
  for (int i = 0; i < 20; ++i) {
    mesh.points.emplace_back(i, 7, 0);
    mesh.node_numbers.push_back(1000 + i);
  }
  const auto report = examine(mesh);
  EXPECT_EQ(report.free_nodes.count, 20);
  EXPECT_EQ(report.free_nodes.first.size(), Findings::shown);
  EXPECT_NE(to_text(report).find("…"), std::string::npos);
}

} // namespace
} // namespace rubato::mesh::quality_test
