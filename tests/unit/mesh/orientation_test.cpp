// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_nodes.hpp"
#include "rubato/mesh/interpolation.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/mesh/quality.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "bodies.hpp"
#include <random>

namespace rubato::mesh::orientation_test {
namespace {

using namespace test;
using Eigen::Vector3d;

/// The reference cell as a mesh of one cell.
Mesh reference_mesh(const cell::CellTopology& shape) {
  Mesh mesh;
  mesh.dimension = shape.dimension;
  mesh.blocks = {{shape.type, {}, {1}}};
  for (int i = 0; i < shape.node_count; ++i) {
    mesh.points.push_back(cell::reference_node(shape.type, i));
    mesh.node_numbers.push_back(i + 1);
    mesh.blocks[0].nodes.push_back(i);
  }
  return mesh;
}

void mirror_in_space(Mesh& mesh) {
  for (auto& point : mesh.points)
    point.x() = -point.x();
}

/// ∫ det J over [−1,1]³ by 2 × 2 × 2 Gauss points; central differences are exact for trilinear maps.
double gauss_volume(const Mesh& mesh) {
  const double g = 1 / std::sqrt(3.);
  double volume = 0;
  for (int point = 0; point < 8; ++point) {
    const Vector3d xi(point & 1 ? g : -g, point & 2 ? g : -g, point & 4 ? g : -g);
    Eigen::Matrix3d jacobian;
    for (int a = 0; a < 3; ++a)
      jacobian.col(a) = (position(CellType::hexa8, mesh.nodes_of(0), mesh.points, xi + Vector3d::Unit(a)) -
                         position(CellType::hexa8, mesh.nodes_of(0), mesh.points, xi - Vector3d::Unit(a))) /
                        2;
    volume += jacobian.determinant();
  }
  return volume;
}

TEST(SignedMeasure, IsThatOfTheReferenceCell) {
  const std::map<CellType, double> measures{
      {CellType::seg2, 2},       {CellType::tria3, 0.5}, {CellType::quad4, 4}, {CellType::tetra4, 1. / 6},
      {CellType::pyra5, 4. / 3}, {CellType::penta6, 1},  {CellType::hexa8, 8}};
  for (const auto& shape : cell::all_topologies()) {
    if (shape.type != CellType::point1) {
      EXPECT_NEAR(signed_measure(reference_mesh(shape), 0), measures.at(cell::linear_type(shape.type)), 1e-14)
          << shape.name;
    }
  }
}

TEST(SignedMeasure, OfAWarpedHexahedronIsTheIntegralOfItsJacobian) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  for (int sample = 0; sample < 10; ++sample) {
    auto mesh = reference_mesh(cell::topology(CellType::hexa8));
    for (auto& point : mesh.points)
      point += Vector3d(shift(random), shift(random), shift(random));
    EXPECT_NEAR(signed_measure(mesh, 0), gauss_volume(mesh), 1e-13);
  }
}

TEST(MirroredNumbering, IsItsOwnInverse) {
  for (const auto& shape : cell::all_topologies()) {
    const auto mirror = mirrored_numbering(shape.type);
    ASSERT_EQ(static_cast<int>(mirror.size()), shape.node_count) << shape.name;
    for (std::size_t i = 0; i < mirror.size(); ++i)
      EXPECT_EQ(mirror[mirror[i]], i) << shape.name;
  }
}

TEST(MendOrientation, MakesEveryMirroredCellPositiveWithMiddlesAndCentresInPlace) {
  for (const auto& shape : cell::all_topologies()) {
    if (shape.dimension < 2)
      continue;
    auto mesh = reference_mesh(shape);
    const double measure = signed_measure(mesh, 0);
    mirror_in_space(mesh);
    EXPECT_NEAR(signed_measure(mesh, 0), -measure, 1e-14) << shape.name;
    EXPECT_EQ(mend_orientation(mesh), std::vector<CellIndex>{0}) << shape.name;
    EXPECT_NEAR(signed_measure(mesh, 0), measure, 1e-14) << shape.name;

    const auto nodes = mesh.nodes_of(0);
    const auto at = [&](std::size_t local) { return mesh.points[static_cast<std::size_t>(nodes[local])]; };
    for (std::size_t e = 0; shape.order == 2 && e < shape.edges.size(); ++e)
      EXPECT_LT((at(static_cast<std::size_t>(cell::mid_node(shape, e))) -
                 (at(shape.edges[e][0]) + at(shape.edges[e][1])) / 2)
                    .norm(),
                1e-15)
          << shape.name;
    for (const auto& side : shape.sides)
      if (const auto centre = cell::centre_node(side)) {
        const Vector3d mean =
            (at(side.nodes[0]) + at(side.nodes[1]) + at(side.nodes[2]) + at(side.nodes[3])) / 4;
        EXPECT_LT((at(static_cast<std::size_t>(*centre)) - mean).norm(), 1e-15) << shape.name;
      }
  }
}

TEST(MendOrientation, TurnsOnlyTheInvertedCellsAndKeepsTheRest) {
  const auto good = mesh_of(CellType::hexa20);
  auto mesh = good;
  auto& hexahedra = mesh.blocks.back();
  const auto mirror = mirrored_numbering(CellType::hexa20);
  for (const std::size_t cell : {2U, 5U})
    for (std::size_t i = 0; i < 20; ++i)
      hexahedra.nodes[20 * cell + i] = good.blocks.back().nodes[20 * cell + mirror[i]];
  const auto first = mesh.cell_count() - hexahedra.cell_count();
  EXPECT_EQ(mend_orientation(mesh), (std::vector<CellIndex>{first + 2, first + 5}));
  EXPECT_EQ(hexahedra.nodes, good.blocks.back().nodes);
  EXPECT_EQ(mesh.blocks.front().nodes, good.blocks.front().nodes);
  EXPECT_TRUE(mend_orientation(mesh).empty());
}

TEST(MendOrientation, MakesPlaneCellsCounterClockwise) {
  auto mesh = mesh_of(CellType::tria7);
  mirror_in_space(mesh);
  EXPECT_TRUE(std::isnan(bulk_measure(mesh)));
  EXPECT_EQ(mend_orientation(mesh).size(), count_of(mesh, CellType::tria7));
  EXPECT_NEAR(bulk_measure(mesh), 2, 1e-14);
}

} // namespace
} // namespace rubato::mesh::orientation_test
