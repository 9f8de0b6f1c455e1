// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/convert.hpp"
#include "rubato/mesh/interpolation.hpp"
#include "rubato/mesh/skin.hpp"

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace rubato::mesh::convert_test {
namespace {

using namespace test;
using Eigen::Vector3d;

/// Both have the same cell groups up to the type of their cells, and the same node groups.
void expect_same_groups(const Mesh& a, const Mesh& b) {
  ASSERT_EQ(a.cell_groups.size(), b.cell_groups.size());
  for (const auto& group : a.cell_groups) {
    const auto* other = b.cell_group(group.name);
    ASSERT_NE(other, nullptr) << group.name;
    EXPECT_EQ(group.items.size(), other->items.size()) << group.name;
    EXPECT_NEAR(group_measure(a, group.name), group_measure(b, group.name), 1e-14) << group.name;
  }
  ASSERT_EQ(a.node_groups.size(), b.node_groups.size());
  for (const auto& group : a.node_groups)
    EXPECT_EQ(group.items.size(), b.node_group(group.name)->items.size()) << group.name;
}

TEST(Conversion, OfTheEightNodeBeamsCountsAsTheQuadraticOnes) {
  const auto linear = generate(two_beams(CellType::hexa8));
  const auto quadratic = to_quadratic(linear);
  EXPECT_EQ(quadratic.node_count(), 786);
  EXPECT_EQ(count_of(quadratic, CellType::hexa20), 80);
  EXPECT_EQ(count_of(quadratic, CellType::quad4), 0);
  expect_same_groups(linear, quadratic);

  const auto full = to_full_quadratic(quadratic);
  // Lattice of 41 × 5 × 3 nodes a beam.
  EXPECT_EQ(full.node_count(), 2 * 41 * 5 * 3);
  EXPECT_EQ(count_of(full, CellType::hexa27), 80);
  EXPECT_EQ(count_of(full, CellType::quad8), 0);
  EXPECT_EQ(free_node_count(full), 0);
  expect_same_groups(linear, full);
}

TEST(Conversion, SharesTheFaceNodesOfSolidsAndTheirSurfaceCells) {
  const auto mesh = to_full_quadratic(generate(two_beams(CellType::hexa20)));
  for (const auto* name : {"slave", "master", "clamped"}) {
    const auto surface = oriented_faces(mesh, mesh.cell_group(name)->items);
    ASSERT_TRUE(surface.sound()) << name;
    for (const auto& face : surface.faces) {
      EXPECT_EQ(face.type, CellType::quad9);
      EXPECT_TRUE(std::ranges::is_permutation(face.nodes(), mesh.nodes_of(face.face)));
    }
  }
}

TEST(Conversion, KeepsCoincidentBodiesApart) {
  const auto mesh = to_full_quadratic(generate(two_beams(CellType::quad4)));
  const auto slave = nodes_named(mesh, "slave");
  const auto master = nodes_named(mesh, "master");
  EXPECT_EQ(slave.size(), 41U);
  std::vector<NodeIndex> common;
  std::ranges::set_intersection(slave, master, std::back_inserter(common));
  EXPECT_TRUE(common.empty());
}

TEST(Conversion, KeepsNumbersAndNumbersNewNodesAfterTheLargest) {
  auto mesh = mesh_of(CellType::hexa8);
  for (auto& number : mesh.node_numbers)
    number *= 10;
  mesh.blocks.back().numbers.front() = 4711;
  const auto largest = mesh.node_numbers.back();
  const auto full = to_full_quadratic(mesh);
  EXPECT_TRUE(std::equal(mesh.node_numbers.begin(), mesh.node_numbers.end(), full.node_numbers.begin()));
  for (std::size_t i = mesh.points.size(); i < full.points.size(); ++i)
    EXPECT_EQ(full.node_numbers[i], largest + 1 + static_cast<std::int64_t>(i - mesh.points.size()));
  EXPECT_EQ(full.blocks.back().numbers, mesh.blocks.back().numbers);
}

TEST(Conversion, ThereAndBackIsTheSameMesh) {
  for (const auto type :
       {CellType::tria3, CellType::quad4, CellType::tetra4, CellType::penta6, CellType::hexa8}) {
    const auto mesh = mesh_of(type);
    for (const auto& other : {to_linear(to_quadratic(mesh)), to_linear(to_full_quadratic(mesh))}) {
      EXPECT_EQ(other.points, mesh.points);
      EXPECT_EQ(other.node_numbers, mesh.node_numbers);
      ASSERT_EQ(other.blocks.size(), mesh.blocks.size());
      for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
        EXPECT_EQ(other.blocks[b].nodes, mesh.blocks[b].nodes);
      expect_same_groups(mesh, other);
    }
  }
}

TEST(Conversion, ToLinearDropsMiddlesFromGroupsButKeepsNodesThatWereFree) {
  auto mesh = mesh_of(CellType::quad8);
  const auto middle = mesh.blocks.back().cell(0)[4];
  mesh.node_groups.push_back({"middle", {middle}});
  mesh.points.emplace_back(9, 9, 0);
  mesh.node_numbers.push_back(5000);
  const auto linear = to_linear(mesh);
  EXPECT_TRUE(linear.node_group("middle")->items.empty());
  EXPECT_EQ(linear.node_count(), 12 + 1);
  EXPECT_EQ(linear.node_numbers.back(), 5000);
}

TEST(Conversion, UsesTheMiddlesThatAreThere) {
  // A linear segment on the edge of a quadratic cell.
  auto mesh = mesh_of(CellType::quad8);
  const auto quad = mesh.blocks.back().cell(0);
  const auto middle = quad[4];
  mesh.blocks.insert(mesh.blocks.begin(), {CellType::seg2, {quad[0], quad[1]}, {999}});
  const auto quadratic = to_quadratic(mesh);
  EXPECT_EQ(quadratic.node_count(), mesh.node_count());
  EXPECT_EQ(quadratic.nodes_of(0)[2], middle);
}

TEST(Conversion, PutsFaceAndBodyNodesOnCurvedCellsByTheSerendipityRule) {
  auto mesh = mesh_of(CellType::hexa20);
  for (auto& point : mesh.points)
    point += 0.1 * Vector3d(point.y() * point.z(), point.x() * point.x(), point.z() * point.y());
  const auto full = to_full_quadratic(mesh);
  for_each_cell(full, [&](CellIndex, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    if (shape.type != CellType::hexa27)
      return;
    const auto at = [&](std::size_t i) { return full.points[static_cast<std::size_t>(nodes[i])]; };
    for (const auto& side : shape.sides) {
      Vector3d centre = Vector3d::Zero();
      for (std::size_t i = 0; i < 8; ++i)
        centre += (i < 4 ? -0.25 : 0.5) * at(side.nodes[i]);
      EXPECT_LT((at(side.nodes[8]) - centre).norm(), 1e-14);
    }
    const Vector3d body = position(CellType::hexa20, nodes.first(20), full.points, Vector3d::Zero());
    EXPECT_LT((at(26) - body).norm(), 1e-14);
  });
}

TEST(Conversion, LeavesTetrahedraAndPrismsAndTheirFacesQuadratic) {
  for (const auto& [from, to] :
       {std::pair{CellType::tetra4, CellType::tetra10}, std::pair{CellType::penta6, CellType::penta15}}) {
    const auto full = to_full_quadratic(mesh_of(from));
    EXPECT_GT(count_of(full, to), 0);
    EXPECT_EQ(count_of(full, CellType::quad9), 0);
    EXPECT_EQ(count_of(full, CellType::tria7), 0);
    for (const auto* side : {"left", "top", "front"})
      EXPECT_TRUE(oriented_faces(full, full.cell_group(side)->items).sound());
  }
}

TEST(Conversion, RefusesAHexahedronThatSharesAFaceWithAPrism) {
  MeshBuilder builder(3);
  for (const double z : {0., 1.})
    for (const auto& [x, y] :
         {std::pair{0., 0.}, std::pair{1., 0.}, std::pair{1., 1.}, std::pair{0., 1.}, std::pair{2., 0.5}})
      builder.add_node({x, y, z});
  builder.add_cell(CellType::hexa8, std::array<NodeIndex, 8>{0, 1, 2, 3, 5, 6, 7, 8});
  builder.add_cell(CellType::penta6, std::array<NodeIndex, 6>{1, 4, 2, 6, 9, 7});
  const auto mesh = std::move(builder).build();
  EXPECT_EQ(count_of(to_quadratic(mesh), CellType::penta15), 1);
  EXPECT_THROW(to_full_quadratic(mesh), InputError);
}

TEST(Conversion, DoesWhatTheDeckAsks) {
  const auto mesh = mesh_of(CellType::quad8);
  EXPECT_EQ(count_of(converted(mesh, study::MeshConversion::none), CellType::quad8), 6);
  EXPECT_EQ(count_of(converted(mesh, study::MeshConversion::linear), CellType::quad4), 6);
  EXPECT_EQ(count_of(converted(mesh, study::MeshConversion::quadratic), CellType::quad8), 6);
  EXPECT_EQ(count_of(converted(mesh, study::MeshConversion::full_quadratic), CellType::quad9), 6);
}

} // namespace
} // namespace rubato::mesh::convert_test
