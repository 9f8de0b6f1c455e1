// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/skin.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "bodies.hpp"

namespace rubato::mesh::skin_test {
namespace {

using namespace test;
using Eigen::Vector3d;

Vector3d centre_of(const Mesh& mesh, std::span<const NodeIndex> nodes) {
  Vector3d sum = Vector3d::Zero();
  for (const auto node : nodes)
    sum += mesh.points[static_cast<std::size_t>(node)];
  return sum / static_cast<double>(nodes.size());
}

Vector3d corner_normal(const Mesh& mesh, const SurfaceFace& face) {
  const auto at = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(face.nodes()[i])]; };
  if (mesh.dimension == 2)
    return (at(1) - at(0)).cross(Vector3d::UnitZ());
  return (at(1) - at(0)).cross(at(2) - at(0));
}

/// Turns every face cell of the mesh round.
Mesh with_reversed_faces(Mesh mesh) {
  for (auto& block : mesh.blocks) {
    const auto& shape = cell::topology(block.type);
    if (shape.dimension != mesh.dimension - 1)
      continue;
    const auto mirror = mirrored_numbering(block.type);
    const auto before = block.nodes;
    for (std::size_t i = 0; i < before.size(); ++i)
      block.nodes[i] = before[i - i % mirror.size() + mirror[i % mirror.size()]];
  }
  return mesh;
}

class Skin : public testing::TestWithParam<CellType> {};

TEST_P(Skin, PointsOutOfTheOwners) {
  const auto mesh = mesh_of(GetParam());
  for (const auto& face : skin(mesh)) {
    EXPECT_EQ(face.face, SurfaceFace::none);
    const Vector3d out = centre_of(mesh, face.nodes()) - centre_of(mesh, mesh.nodes_of(face.owner));
    EXPECT_GT(corner_normal(mesh, face).dot(out), 0);
    EXPECT_EQ(cell::topology(GetParam()).sides[face.side].type, face.type);
  }
}

TEST_P(Skin, OfTouchingBodiesCoversBoth) {
  const auto mesh = generate(two_beams(GetParam()));
  double area = 0;
  for (const auto& face : skin(mesh))
    area += signed_measure(face.type, face.nodes(), mesh.points, mesh.dimension);
  EXPECT_NEAR(area, mesh.dimension == 3 ? 2 * 0.42 : 2 * 2.2, 1e-13);
}

TEST_P(Skin, FacesAreOrientedByTheOwnerWhateverTheirOwnDirection) {
  const auto mesh = with_reversed_faces(generate(two_beams(GetParam())));
  for (const auto& [name, up, owners] :
       {std::tuple{"slave", 1., "lower"}, std::tuple{"master", -1., "upper"}}) {
    const auto& items = mesh.cell_group(name)->items;
    const auto& body = mesh.cell_group(owners)->items;
    const auto surface = oriented_faces(mesh, items);
    ASSERT_TRUE(surface.sound());
    ASSERT_EQ(surface.faces.size(), items.size());
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto& face = surface.faces[i];
      EXPECT_EQ(face.face, items[i]);
      EXPECT_TRUE(std::ranges::binary_search(body, face.owner));
      EXPECT_NEAR(corner_normal(mesh, face).normalized().y(), up, 1e-14);
      EXPECT_TRUE(std::ranges::is_permutation(face.nodes(), mesh.nodes_of(face.face)));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryType, Skin, testing::ValuesIn(all_types()), [](const auto& parameter) {
  return std::string(cell::topology(parameter.param).name);
});

TEST(SkinCount, IsThatOfTheBoxAndOfAPartOfIt) {
  const auto mesh = mesh_of(CellType::hexa8);
  EXPECT_EQ(skin(mesh).size(), 2U * (6 + 6 + 4));
  const auto first = mesh.cell_group("body")->items.front();
  const std::vector<CellIndex> two{first, first + 1};
  EXPECT_EQ(skin(mesh, two).size(), 10U);
  EXPECT_TRUE(skin(mesh, mesh.cell_group("top")->items).empty()) << "faces are no bulk cells";
}

TEST(OrientedFaces, TellWhichCellsAreNoSkin) {
  auto mesh = mesh_of(CellType::quad4);
  const auto& quads = mesh.blocks.back();
  ASSERT_EQ(quads.type, CellType::quad4);
  // Between the first two quadrangles; across the first one; and a quadrangle itself.
  const auto quad = quads.cell(0);
  auto& segments = mesh.blocks.front();
  const auto inner = segments.cell_count();
  for (const auto node : {quad[1], quad[2], quad[0], quad[2]})
    segments.nodes.push_back(node);
  segments.numbers.insert(segments.numbers.end(), {901, 902});
  const std::vector<CellIndex> cells{0, inner, inner + 1, inner + 2};

  const auto surface = oriented_faces(mesh, cells);
  EXPECT_FALSE(surface.sound());
  EXPECT_EQ(surface.faces.size(), 1U);
  EXPECT_EQ(surface.inside, std::vector<CellIndex>{inner});
  EXPECT_EQ(surface.unowned, std::vector<CellIndex>{inner + 1});
  EXPECT_EQ(surface.not_faces, std::vector<CellIndex>{inner + 2});

  const auto sentences = faults_of(mesh, surface);
  ASSERT_EQ(sentences.size(), 3U);
  EXPECT_NE(sentences[1].find("number 902 of SEG2"), std::string::npos) << sentences[1];
}

TEST(OrientedFaces, TakeTheOwnersNodesWhenTheFaceCellIsLinear) {
  auto mesh = mesh_of(CellType::hexa20);
  const auto top = mesh.cell_group("top")->items.front();
  const auto eight = mesh.nodes_of(top);
  mesh.blocks.insert(mesh.blocks.begin(), {CellType::quad4, {eight.begin(), eight.begin() + 4}, {999}});
  const std::vector<CellIndex> cells{0};
  const auto surface = oriented_faces(mesh, cells);
  ASSERT_EQ(surface.faces.size(), 1U);
  EXPECT_EQ(surface.faces[0].type, CellType::quad8);
}

} // namespace
} // namespace rubato::mesh::skin_test
