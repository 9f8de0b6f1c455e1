// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/mesh/quality.hpp"
#include "rubato/mesh/refine.hpp"
#include "rubato/mesh/skin.hpp"

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace rubato::mesh::refine_test {
namespace {

using namespace test;
using Eigen::Vector3d;

/// The corners follow each other in the same circle, whichever comes first.
bool same_direction(std::span<const NodeIndex> a, std::span<const NodeIndex> b, int corner_count) {
  std::vector<NodeIndex> circle(a.begin(), a.begin() + corner_count);
  const auto start = std::ranges::find(circle, b[0]);
  if (start == circle.end())
    return false;
  std::rotate(circle.begin(), start, circle.end());
  return std::ranges::equal(circle, b.first(circle.size()));
}

class RefinedMesh : public testing::TestWithParam<CellType> {};

TEST_P(RefinedMesh, HasEqualChildrenThatFillTheParents) {
  const auto mesh = mesh_of(GetParam());
  const auto fine = refined(mesh, 2);
  EXPECT_EQ(count_of(fine, GetParam()), (mesh.dimension == 3 ? 8 : 4) * count_of(mesh, GetParam()));
  const double part = bulk_measure(mesh) / count_of(fine, GetParam());
  for (const auto cell : fine.cell_group("body")->items)
    EXPECT_NEAR(signed_measure(fine, cell), part, 1e-14);
  EXPECT_EQ(free_node_count(fine), 0);
}

TEST_P(RefinedMesh, HasAsManyNodesAsTheGridOfTwiceTheDivisions) {
  EXPECT_EQ(refined(mesh_of(GetParam()), 2).node_count(), mesh_of(GetParam(), 2).node_count());
  EXPECT_EQ(refined(mesh_of(GetParam()), 4).node_count(), mesh_of(GetParam(), 4).node_count());
}

TEST_P(RefinedMesh, SharesEveryInnerSideBetweenTwoCells) {
  const auto fine = refined(mesh_of(GetParam()), 2);
  const auto sides = side_multiplicities(fine);
  EXPECT_EQ(sides[2], 0);
  EXPECT_EQ(sides[0], side_multiplicities(mesh_of(GetParam(), 2))[0]);
}

TEST_P(RefinedMesh, InheritsGroupsAndKeepsOldNodes) {
  const auto mesh = mesh_of(GetParam());
  const auto fine = refined(mesh, 2);
  for (const auto& group : mesh.cell_groups)
    EXPECT_NEAR(group_measure(fine, group.name), group_measure(mesh, group.name), 1e-13) << group.name;
  EXPECT_EQ(fine.node_group("tip")->items, mesh.node_group("tip")->items);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_EQ(fine.points[i], mesh.points[i]);
    EXPECT_EQ(fine.node_numbers[i], mesh.node_numbers[i]);
  }
  for (const auto* side : {"left", "right", "bottom", "top"}) {
    const auto surface = oriented_faces(fine, fine.cell_group(side)->items);
    EXPECT_TRUE(surface.sound()) << side;
    for (const auto& face : surface.faces)
      EXPECT_TRUE(
          same_direction(face.nodes(), fine.nodes_of(face.face), cell::topology(face.type).corner_count))
          << side;
  }
}

TEST_P(RefinedMesh, HasMiddlesInTheMiddleOfStraightEdges) {
  const auto fine = refined(mesh_of(GetParam()), 2);
  for_each_cell(fine, [&](CellIndex, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    const auto at = [&](std::size_t i) { return fine.points[static_cast<std::size_t>(nodes[i])]; };
    for (std::size_t e = 0; shape.order == 2 && e < shape.edges.size(); ++e)
      EXPECT_LT((at(static_cast<std::size_t>(cell::mid_node(shape, e))) -
                 (at(shape.edges[e][0]) + at(shape.edges[e][1])) / 2)
                    .norm(),
                1e-14);
    if (shape.type == CellType::hexa27) {
      EXPECT_LT((at(26) - (at(0) + at(6)) / 2).norm(), 1e-14);
    }
    if (shape.type == CellType::tria7) {
      EXPECT_LT((at(6) - (at(0) + at(1) + at(2)) / 3).norm(), 1e-14);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(EveryType, RefinedMesh, testing::ValuesIn(all_types()), [](const auto& parameter) {
  return std::string(cell::topology(parameter.param).name);
});

TEST(Refine, KeepsTheCurveOfQuadraticCells) {
  // A parabola y = 1 + x²/4 along the top is what quadratic cells represent exactly.
  for (const auto type : {CellType::quad8, CellType::quad9, CellType::hexa20, CellType::hexa27}) {
    auto mesh = mesh_of(type);
    const auto bend = [](const Vector3d& x) {
      return Vector3d(x.x(), x.y() * (1 + x.x() * x.x() / 4), x.z());
    };
    for (auto& point : mesh.points)
      point = bend(point);
    const auto fine = refined(mesh, 4);
    for (const auto node : nodes_named(fine, "top")) {
      const auto& point = fine.points[static_cast<std::size_t>(node)];
      EXPECT_NEAR(point.y(), 1 + point.x() * point.x() / 4, 1e-13) << cell::topology(type).name;
    }
  }
}

TEST(Refine, KeepsCoincidentBodiesApart) {
  const auto fine = refined(generate(two_beams(CellType::hexa8)), 2);
  EXPECT_EQ(fine.node_count(), 1230);
  EXPECT_EQ(examine(fine).connected_bodies, 2);
}

TEST(Refine, DoesNotLetTetrahedraDegenerate) {
  const auto mesh = mesh_of(CellType::tetra4);
  const auto worst = [](const Mesh& m) { return examine(m).types.back().smallest_jacobian; };
  EXPECT_GT(worst(refined(mesh, 8)), 0.5 * worst(mesh));
}

TEST(Refine, IntoOnePartChangesNothing) {
  const auto mesh = mesh_of(CellType::penta15);
  EXPECT_EQ(refined(mesh, 1).blocks.back().nodes, mesh.blocks.back().nodes);
}

TEST(Refine, RefusesOtherThanPowersOfTwoPyramidsAndMeshesTooLarge) {
  const auto mesh = mesh_of(CellType::hexa8);
  for (const int parts : {-2, 0, 3, 6})
    EXPECT_THROW(refined(mesh, parts), InputError) << parts;
  EXPECT_THROW(refined(mesh, 1 << 20), InputError);
  Mesh pyramid;
  pyramid.blocks = {{CellType::pyra5, {0, 1, 2, 3, 4}, {1}}};
  EXPECT_THROW(refined(pyramid, 2), InputError);
}

} // namespace
} // namespace rubato::mesh::refine_test
