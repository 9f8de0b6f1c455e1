// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_nodes.hpp"
#include "rubato/cell/topology.hpp"
#include "rubato/mesh/interpolation.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <set>

namespace rubato::cell::topology_test {
namespace {

using Eigen::Vector3d;

Vector3d centre_of_corners(const cell::CellTopology& shape) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < shape.corner_count; ++i)
    sum += cell::reference_node(shape.type, i);
  return sum / shape.corner_count;
}

std::vector<Vector3d> nodes_of_side(const cell::CellTopology& shape, const cell::CellSide& side) {
  std::vector<Vector3d> nodes;
  for (const auto node : side.nodes)
    nodes.push_back(cell::reference_node(shape.type, node));
  return nodes;
}

Vector3d normal_of(const cell::CellSide& side, const std::vector<Vector3d>& x) {
  if (cell::topology(side.type).dimension == 1)
    return (x[1] - x[0]).cross(Vector3d::UnitZ());
  return (x[1] - x[0]).cross(x[2] - x[0]);
}

TEST(CellTypes, StandInTheOrderOfTheEnumeration) {
  for (std::size_t i = 0; i < cell::all_topologies().size(); ++i)
    EXPECT_EQ(static_cast<std::size_t>(cell::all_topologies()[i].type), i);
}

TEST(CellTypes, AreFoundByNameInAnyCase) {
  for (const auto& shape : cell::all_topologies())
    EXPECT_EQ(cell::cell_type_named(shape.name), shape.type);
  EXPECT_EQ(cell::cell_type_named("hexa20"), CellType::hexa20);
  EXPECT_FALSE(cell::cell_type_named("HEXA21").has_value());
}

TEST(CellTypes, HaveSidesWhoseNormalsPointOut) {
  for (const auto& shape : cell::all_topologies())
    for (const auto& side : shape.sides) {
      const auto x = nodes_of_side(shape, side);
      EXPECT_GT(normal_of(side, x).dot(x[0] - centre_of_corners(shape)), 0) << shape.name;
    }
}

TEST(CellTypes, HaveSidesWithEveryNodeOfTheSidesType) {
  for (const auto& shape : cell::all_topologies())
    for (const auto& side : shape.sides) {
      EXPECT_EQ(static_cast<int>(side.nodes.size()), cell::topology(side.type).node_count) << shape.name;
      EXPECT_EQ(cell::topology(side.type).dimension, shape.dimension - 1) << shape.name;
      EXPECT_EQ(cell::topology(side.type).order, shape.order) << shape.name;
    }
}

TEST(CellTypes, HaveSidesWhoseMiddleNodesLieInTheMiddleOfTheirCorners) {
  for (const auto& shape : cell::all_topologies())
    for (const auto& side : shape.sides) {
      const auto& face = cell::topology(side.type);
      const auto x = nodes_of_side(shape, side);
      if (face.order != 2)
        continue;
      for (std::size_t e = 0; e < face.edges.size(); ++e) {
        const Vector3d middle = (x[face.edges[e][0]] + x[face.edges[e][1]]) / 2;
        EXPECT_LT((x[static_cast<std::size_t>(cell::mid_node(face, e))] - middle).norm(), 1e-15)
            << shape.name;
      }
      if (side.type == CellType::quad9) {
        EXPECT_LT((x[8] - (x[0] + x[1] + x[2] + x[3]) / 4).norm(), 1e-15) << shape.name;
      }
    }
}

TEST(CellTypes, HaveSidesThatCloseTheCell) {
  // Each edge of a solid is run through once in each direction by its outward faces.
  for (const auto& shape : cell::all_topologies()) {
    if (shape.dimension != 3)
      continue;
    std::set<std::pair<int, int>> directed;
    for (const auto& side : shape.sides)
      for (const auto& [a, b] : cell::topology(side.type).edges)
        EXPECT_TRUE(directed.emplace(side.nodes[a], side.nodes[b]).second) << shape.name;
    EXPECT_EQ(directed.size(), 2 * shape.edges.size()) << shape.name;
    for (const auto& [a, b] : shape.edges)
      EXPECT_TRUE(directed.contains({a, b}) && directed.contains({b, a})) << shape.name;
  }
}

TEST(CellTypes, KnowTheirLinearQuadraticAndFullKin) {
  EXPECT_EQ(cell::linear_type(CellType::hexa27), CellType::hexa8);
  EXPECT_EQ(cell::linear_type(CellType::penta18), CellType::penta6);
  EXPECT_EQ(cell::quadratic_type(CellType::pyra5), CellType::pyra13);
  EXPECT_EQ(cell::quadratic_type(CellType::hexa27), CellType::hexa27);
  EXPECT_EQ(cell::full_quadratic_type(CellType::tria3, 2), CellType::tria7);
  EXPECT_EQ(cell::full_quadratic_type(CellType::tria3, 3), CellType::tria6);
  EXPECT_EQ(cell::full_quadratic_type(CellType::penta6, 3), CellType::penta15);
  EXPECT_EQ(cell::full_quadratic_type(CellType::hexa20, 3), CellType::hexa27);
}

} // namespace
} // namespace rubato::cell::topology_test
