// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/mesh/generate.hpp"
#include "rubato/mesh/skin.hpp"

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace rubato::mesh::generate_test {
namespace {

using namespace test;

int parts_of_grid_cell(CellType type) {
  switch (cell::linear_type(type)) {
  case CellType::tria3:
  case CellType::penta6:
    return 2;
  case CellType::tetra4:
    return 6;
  default:
    return 1;
  }
}

std::string message_of(const std::vector<study::Body>& bodies, int refine = 1) {
  try {
    generate(bodies, refine);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

class GeneratedMesh : public testing::TestWithParam<CellType> {};

TEST_P(GeneratedMesh, FillsTheBodyWithPositiveCells) {
  const bool solid = cell::topology(GetParam()).dimension == 3;
  const auto mesh = mesh_of(GetParam());
  EXPECT_EQ(count_of(mesh, GetParam()), 6 * (solid ? 2 : 1) * parts_of_grid_cell(GetParam()));
  EXPECT_NEAR(bulk_measure(mesh), solid ? 6 : 2, 1e-13);
  EXPECT_EQ(mesh.dimension, cell::topology(GetParam()).dimension);
}

TEST_P(GeneratedMesh, SharesEveryInnerSideBetweenTwoCells) {
  const bool solid = cell::topology(GetParam()).dimension == 3;
  const auto mesh = mesh_of(GetParam(), 2);
  const auto sides = side_multiplicities(mesh);
  EXPECT_EQ(sides[2], 0);
  EXPECT_EQ(sides[0], static_cast<int>(skin(mesh).size()));
  double outer = 0;
  for (const auto& face : skin(mesh))
    outer += signed_measure(face.type, face.nodes(), mesh.points, mesh.dimension);
  EXPECT_NEAR(outer, solid ? 22 : 6, 1e-13);
}

TEST_P(GeneratedMesh, HasNoFreeNodesAndConsecutiveNumbers) {
  const auto mesh = mesh_of(GetParam());
  EXPECT_EQ(free_node_count(mesh), 0);
  for (std::size_t i = 0; i < mesh.node_numbers.size(); ++i)
    EXPECT_EQ(mesh.node_numbers[i], static_cast<std::int64_t>(i) + 1);
  std::int64_t number = 0;
  for (const auto& block : mesh.blocks)
    for (const auto cell_number : block.numbers)
      EXPECT_EQ(cell_number, ++number);
}

TEST_P(GeneratedMesh, CoversEachNamedSideWithOutwardCellsOfTheRightPlaceAndType) {
  const auto mesh = mesh_of(GetParam());
  const bool solid = mesh.dimension == 3;
  const std::map<std::string, double> measures =
      solid ? std::map<std::string, double>{{"left", 3}, {"right", 3}, {"bottom", 6},
                                            {"top", 6},  {"back", 2},  {"front", 2}}
            : std::map<std::string, double>{{"left", 1}, {"right", 1}, {"bottom", 2}, {"top", 2}};
  const std::map<std::string, std::pair<int, double>> planes{{"left", {0, 0}},   {"right", {0, 2}},
                                                             {"bottom", {1, 0}}, {"top", {1, 1}},
                                                             {"back", {2, 0}},   {"front", {2, 3}}};
  for (const auto& [name, measure] : measures) {
    EXPECT_NEAR(group_measure(mesh, name), measure, 1e-14) << name;
    const auto& items = mesh.cell_group(name)->items;
    const auto surface = oriented_faces(mesh, items);
    EXPECT_TRUE(surface.sound()) << name;
    ASSERT_EQ(surface.faces.size(), items.size());
    for (const auto& face : surface.faces) {
      EXPECT_EQ(face.type, mesh.type_of(face.face));
      EXPECT_TRUE(std::ranges::equal(face.nodes(), mesh.nodes_of(face.face))) << "not outward on " << name;
      for (const auto node : face.nodes())
        EXPECT_DOUBLE_EQ(mesh.points[static_cast<std::size_t>(node)][planes.at(name).first],
                         planes.at(name).second);
    }
  }
}

TEST_P(GeneratedMesh, NamesEdgesAndCorners) {
  const auto mesh = mesh_of(GetParam());
  const auto* tip = mesh.node_group("tip");
  ASSERT_NE(tip, nullptr);
  ASSERT_EQ(tip->items.size(), 1U);
  const Eigen::Vector3d corner(2, 1, mesh.dimension == 3 ? 3 : 0);
  EXPECT_EQ(mesh.points[static_cast<std::size_t>(tip->items[0])], corner);
  if (mesh.dimension != 3)
    return;
  EXPECT_NEAR(group_measure(mesh, "rim"), 3, 1e-14);
  for (const auto node : nodes_named(mesh, "rim"))
    EXPECT_EQ(mesh.points[static_cast<std::size_t>(node)].head<2>(), Eigen::Vector2d(2, 1));
  EXPECT_EQ(mesh.type_of(mesh.cell_group("rim")->items[0]),
            cell::topology(GetParam()).order == 1 ? CellType::seg2 : CellType::seg3);
}

TEST_P(GeneratedMesh, KeepsTheNodesOfTouchingBodiesApart) {
  const auto bodies = two_beams(GetParam());
  const auto mesh = generate(bodies);
  const auto one = generate({&bodies[0], 1});
  EXPECT_EQ(mesh.node_count(), 2 * one.node_count());
  const auto slave = nodes_named(mesh, "slave");
  const auto master = nodes_named(mesh, "master");
  ASSERT_EQ(slave.size(), master.size());
  std::vector<NodeIndex> common;
  std::ranges::set_intersection(slave, master, std::back_inserter(common));
  EXPECT_TRUE(common.empty());
  for (const auto* name : {"slave", "master"})
    EXPECT_TRUE(oriented_faces(mesh, mesh.cell_group(name)->items).sound());
}

INSTANTIATE_TEST_SUITE_P(EveryType, GeneratedMesh, testing::ValuesIn(all_types()), [](const auto& parameter) {
  return std::string(cell::topology(parameter.param).name);
});

TEST(Generate, CountsAsTheTwoBeamStudiesDo) {
  const auto plane = generate(two_beams(CellType::quad4));
  EXPECT_EQ(plane.node_count(), 126);
  EXPECT_EQ(count_of(plane, CellType::quad4), 80);
  const auto solid = generate(two_beams(CellType::hexa8));
  EXPECT_EQ(solid.node_count(), 252);
  EXPECT_EQ(solid.cell_group("slave")->items.size(), 20U);
  EXPECT_EQ(generate(two_beams(CellType::hexa20)).node_count(), 786);
  EXPECT_EQ(generate(two_beams(CellType::hexa8), 2).node_count(), 1230);
  EXPECT_EQ(generate(two_beams(CellType::hexa8), 4).node_count(), 7290);
}

TEST(Generate, UnitesGroupsOfTheSameName) {
  const auto mesh = generate(two_beams(CellType::quad4));
  EXPECT_EQ(std::ranges::count(mesh.cell_groups, "clamped", &Group::name), 1);
  EXPECT_EQ(mesh.cell_group("clamped")->items.size(), 4U);
  EXPECT_TRUE(std::ranges::is_sorted(mesh.cell_group("clamped")->items));
}

TEST(Generate, MixesBodiesOfDifferentCells) {
  auto bodies = two_beams(CellType::hexa27);
  bodies[1].cells = CellType::tetra4;
  const auto mesh = generate(bodies);
  EXPECT_NEAR(group_measure(mesh, "lower"), 0.01, 1e-15);
  EXPECT_NEAR(group_measure(mesh, "upper"), 0.01, 1e-15);
  EXPECT_EQ(mesh.type_of(mesh.cell_group("slave")->items[0]), CellType::quad9);
  EXPECT_EQ(mesh.type_of(mesh.cell_group("master")->items[0]), CellType::tria3);
}

TEST(Generate, TakesTheWordsOfAPlaceInAnyOrder) {
  auto body = body_of(CellType::hexa8);
  body.points = {{"front_right_top", "tip"}};
  EXPECT_EQ(generate({&body, 1}).node_group("tip")->items, mesh_of(CellType::hexa8).node_group("tip")->items);
}

TEST(Generate, SuggestsTheNearestSide) {
  auto body = body_of(CellType::quad4);
  body.sides["lefft"] = "x";
  EXPECT_EQ(message_of({body}),
            "mesh.generate.0.sides.lefft: body 'body' has no side 'lefft': did you mean 'left'?");
}

TEST(Generate, RefusesPlacesThatAreNone) {
  auto body = body_of(CellType::quad4);
  body.sides = {{"front", "x"}};
  EXPECT_NE(message_of({body}).find("has no side 'front'"), std::string::npos);
  body = body_of(CellType::hexa8);
  body.edges = {{"left_right", "x"}};
  EXPECT_NE(message_of({body}).find("has no edge 'left_right'"), std::string::npos);
  body.edges = {{"left", "x"}};
  EXPECT_NE(message_of({body}).find("has no edge 'left'"), std::string::npos);
  body = body_of(CellType::quad4);
  body.edges = {{"left_top", "x"}};
  EXPECT_NE(message_of({body}).find("names edges"), std::string::npos);
}

TEST(Generate, ReportsEveryFaultTogether) {
  auto body = body_of(CellType::hexa8);
  body.to[0] = body.from[0];
  body.divisions[1] = 0;
  body.cells = CellType::pyra5;
  body.points = {{"tip", "x"}};
  try {
    generate({&body, 1});
    FAIL() << "a bad body was meshed";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 4U) << error.what();
  }
}

TEST(Generate, RefusesNothingToMeshBadRefinementMixedDimensionsAndMeshesTooLarge) {
  EXPECT_NE(message_of({}).find("no body"), std::string::npos);
  EXPECT_NE(message_of({body_of(CellType::quad4)}, 0).find("refine is 0"), std::string::npos);
  EXPECT_NE(message_of({body_of(CellType::quad4), body_of(CellType::hexa8)}).find("dimension"),
            std::string::npos);
  EXPECT_NE(message_of({body_of(CellType::hexa8)}, 1 << 20).find("nodes"), std::string::npos);
}

} // namespace
} // namespace rubato::mesh::generate_test
