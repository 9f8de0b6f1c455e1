// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/convert.hpp"
#include "rubato/mesh/made_groups.hpp"
#include "rubato/mesh/sheet.hpp"
#include "rubato/mesh/skin.hpp"

#include <gtest/gtest.h>

#include "bodies.hpp"
#include "support/faults.hpp"

namespace rubato::mesh::made_groups_test {
namespace {

using namespace test;
using rubato::test::fault_of;
using study::GroupKind;
using study::GroupTake;
using study::MadeGroup;

MadeGroup made(const std::string& name, GroupKind kind, std::vector<std::string> of = {}) {
  MadeGroup group;
  group.name = name;
  group.kind = kind;
  group.of = std::move(of);
  return group;
}

MadeGroup box(const std::string& name, std::array<double, 3> from, std::array<double, 3> to) {
  auto group = made(name, GroupKind::box);
  group.from = from;
  group.to = to;
  return group;
}

MadeGroup plane(const std::string& name, std::array<double, 3> point, std::array<double, 3> normal) {
  auto group = made(name, GroupKind::plane);
  group.point = point;
  group.direction = normal;
  return group;
}

MadeGroup taking(MadeGroup group, GroupTake take) {
  group.take = take;
  return group;
}

MadeGroup facing(const std::string& name, std::array<double, 3> direction, double angle = 30) {
  auto group = made(name, GroupKind::normal);
  group.direction = direction;
  group.angle = angle;
  return group;
}

std::vector<NodeIndex> nodes(const Mesh& mesh, const std::string& group) {
  return mesh.node_group(group)->items;
}

std::vector<NodeIndex> nodes_of_cells(const Mesh& mesh, const std::string& group) {
  std::vector<NodeIndex> all;
  for (const auto cell : mesh.cell_group(group)->items)
    all.insert(all.end(), mesh.nodes_of(cell).begin(), mesh.nodes_of(cell).end());
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Mesh with(Mesh mesh, const std::vector<MadeGroup>& groups) {
  return with_groups(std::move(mesh), groups);
}

std::string refusal(const Mesh& mesh, const std::vector<MadeGroup>& groups) {
  return fault_of([&] { with_groups(mesh, groups); });
}

/// The body without the cells on its sides.
Mesh bare(CellType type) {
  const auto whole = mesh_of(type);
  auto builder = MeshBuilder(whole.dimension);
  for (const auto& point : whole.points)
    builder.add_node(point);
  for_each_cell(whole, [&](CellIndex, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    if (shape.dimension == whole.dimension)
      builder.add_to_cell_group("body", std::array{builder.add_cell(shape.type, nodes)});
  });
  return std::move(builder).build();
}

double area_of(const Mesh& mesh, const std::string& group) {
  double area = 0;
  for (const auto cell : mesh.cell_group(group)->items)
    area += signed_measure(mesh, cell);
  return area;
}

class MadeGroups : public testing::TestWithParam<CellType> {};

TEST_P(MadeGroups, AreTheSidesThatTheGeneratorNames) {
  const auto mesh =
      with(mesh_of(GetParam()),
           {facing("above", {0, 1, 0}), taking(plane("wall", {2, 0, 0}, {-3, 0, 0}), GroupTake::faces),
            plane("wall_nodes", {2, 0, 0}, {1, 0, 0}), made("all_round", GroupKind::skin, {"body"})});
  EXPECT_EQ(mesh.cell_group("above")->items, mesh.cell_group("top")->items);
  EXPECT_EQ(mesh.cell_group("wall")->items, mesh.cell_group("right")->items);
  EXPECT_EQ(nodes(mesh, "wall_nodes"), nodes_of_cells(mesh, "right"));
  EXPECT_EQ(mesh.cell_count(), mesh_of(GetParam()).cell_count());
  EXPECT_NEAR(area_of(mesh, "all_round"), mesh.dimension == 3 ? 22 : 6, 1e-12);
}

TEST_P(MadeGroups, MakeCellsOfFacesThatTheMeshHasNot) {
  const auto before = bare(GetParam());
  const auto mesh = with(
      before, {facing("above", {0, 1, 0}), taking(plane("top", {0, 1, 0}, {0, 1, 0}), GroupTake::faces)});
  EXPECT_EQ(mesh.cell_count(),
            before.cell_count() + static_cast<int>(mesh.cell_group("above")->items.size()));
  EXPECT_EQ(mesh.cell_group("above")->items, mesh.cell_group("top")->items);
  EXPECT_NEAR(area_of(mesh, "above"), mesh.dimension == 3 ? 6 : 2, 1e-12);
  const auto surface = oriented_faces(mesh, mesh.cell_group("above")->items);
  ASSERT_TRUE(surface.sound());
  for (const auto& face : surface.faces) {
    EXPECT_GT(normal_of(mesh, face).y(), 0);
    EXPECT_EQ(std::vector(face.nodes().begin(), face.nodes().end()),
              std::vector(mesh.nodes_of(face.face).begin(), mesh.nodes_of(face.face).end()));
  }
  EXPECT_EQ(nodes_of_cells(mesh, "body"), nodes_of_cells(before, "body"));
}

TEST_P(MadeGroups, TellCornersFromMiddles) {
  const auto mesh = mesh_of(GetParam());
  const auto order = cell::topology(GetParam()).order;
  std::vector<MadeGroup> groups{made("whole", GroupKind::nodes_of, {"top"}),
                                made("ends", GroupKind::corners_of, {"top"})};
  if (order == 1) {
    EXPECT_NE(refusal(mesh, {made("middles", GroupKind::middles_of, {"top"})}).find("cells are linear"),
              std::string::npos);
  } else {
    groups.push_back(made("middles", GroupKind::middles_of, {"top"}));
    groups.push_back(made("middles_of_nodes", GroupKind::middles_of, {"whole"}));
    groups.push_back(made("together", GroupKind::union_of, {"ends", "middles"}));
  }
  const auto found = with(mesh, groups);
  EXPECT_EQ(nodes(found, "whole"), nodes_of_cells(found, "top"));
  const auto linear = to_linear(mesh);
  EXPECT_EQ(nodes(found, "ends").size(), nodes_of_cells(linear, "top").size());
  if (order == 1)
    return;
  EXPECT_EQ(nodes(found, "together"), nodes(found, "whole"));
  EXPECT_EQ(nodes(found, "middles_of_nodes"), nodes(found, "middles"));
  EXPECT_EQ(nodes(found, "middles").size() + nodes(found, "ends").size(), nodes(found, "whole").size());
}

INSTANTIATE_TEST_SUITE_P(Of, MadeGroups, testing::ValuesIn(all_types()),
                         [](const auto& type) { return std::string(cell::topology(type.param).name); });

const auto cube = [] { return mesh_of(CellType::hexa8); };

TEST(GroupsOfGroups, AreUnionsIntersectionsAndDifferences) {
  const auto mesh =
      with(cube(),
           {made("edge", GroupKind::intersection, {"a", "b"}), made("both", GroupKind::union_of, {"a", "b"}),
            made("rest", GroupKind::difference, {"both", "edge", "tip"}),
            made("a", GroupKind::nodes_of, {"right"}), made("b", GroupKind::nodes_of, {"top"}),
            made("sides", GroupKind::difference, {"round", "top", "bottom"}),
            made("round", GroupKind::skin, {"all"})});
  EXPECT_EQ(nodes(mesh, "edge"), nodes_of_cells(mesh, "rim"));
  EXPECT_EQ(nodes(mesh, "both").size(), nodes(mesh, "a").size() + nodes(mesh, "b").size() - 3);
  EXPECT_EQ(nodes(mesh, "rest").size(), nodes(mesh, "both").size() - 3);
  EXPECT_NEAR(area_of(mesh, "sides"), 22 - 2 * 6, 1e-12);
}

TEST(GroupsOfShapes, TakeWhatIsInsideOrOnTheSurface) {
  auto ball = made("ball", GroupKind::sphere);
  ball.radius = 1;
  auto tube = made("tube", GroupKind::cylinder);
  tube.direction = {0, 0, 2};
  tube.radius = 2;
  tube.within = 1e-3;
  auto part_of_side = box("part", {0, 0, 0}, {2, 1, 1.5});
  part_of_side.of = {"right"};
  const auto mesh = with(cube(), {ball, tube, taking(box("half", {0, 0, 0}, {1, 1, 3}), GroupTake::cells),
                                  taking(part_of_side, GroupTake::cells),
                                  taking(box("corner", {-1, -1, -1}, {1, 0.4, 1.6}), GroupTake::faces)});
  EXPECT_EQ(nodes(mesh, "ball").size(), 5U); // (0, 0…1, 0), (1, 0, 0)
  EXPECT_EQ(nodes(mesh, "tube").size(), 3U); // (2, 0, z)
  EXPECT_EQ(mesh.cell_group("half")->items.size(), 6U);
  EXPECT_EQ(mesh.cell_group("part")->items.size(), 3U);
  EXPECT_EQ(mesh.cell_group("corner")->items.size(), 3U);
}

TEST(GroupsOfShapes, IncludeTheirBorderUpToRounding) {
  const auto mesh = with(cube(), {box("border", {2 + 1e-7, 0, 0}, {3, 1, 3})});
  EXPECT_EQ(nodes(mesh, "border"), nodes_of_cells(mesh, "right"));
}

TEST(GroupsAlongALine, HaveTheirNodesInOrder) {
  auto line = made("line", GroupKind::along, {"rim"});
  line.direction = {0, 0, -1};
  const auto mesh = with(cube(), {line, taking(facing("new", {0, 0, 1}), GroupTake::nodes)});
  const auto* group = mesh.node_group("line");
  ASSERT_EQ(group->in_order().size(), 3U);
  EXPECT_TRUE(std::ranges::is_sorted(group->items));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(mesh.points[static_cast<std::size_t>(group->in_order()[i])].z(),
              3 - 1.5 * static_cast<double>(i));
  EXPECT_EQ(mesh.cell_group("rim")->in_order().size(), 2U);
}

TEST(GroupsAlongALine, AreRefusedWhereTwoNodesAreEquallyFar) {
  auto line = made("line", GroupKind::along, {"rim"});
  line.direction = {1, 0, 0};
  EXPECT_NE(refusal(cube(), {line}).find("(2, 1, 0) and N"), std::string::npos) << refusal(cube(), {line});
}

TEST(SkinsOfParts, EndWhereOtherCellsBegin) {
  const auto mesh = with(cube(), {taking(box("part", {0, 0, 0}, {1, 1, 3}), GroupTake::cells),
                                  made("outside", GroupKind::skin, {"part"}),
                                  made("right_part", GroupKind::difference, {"body", "part"}),
                                  made("right_skin", GroupKind::skin, {"right_part"})});
  EXPECT_NEAR(area_of(mesh, "outside"), 3 + 2 * 1 + 2 * 3, 1e-12);
  EXPECT_NEAR(area_of(mesh, "right_skin"), 3 + 2 * 1 + 2 * 3, 1e-12);
}

TEST(MadeGroupNames, KeepNumbersAndNamesOfNodesAndCells) {
  auto mesh = bare(CellType::quad4);
  mesh.blocks.front().names.assign(6, "");
  for (std::size_t i = 0; i < 6; ++i)
    mesh.blocks.front().names[i] = "Q" + std::to_string(i);
  const auto found = with(mesh, {facing("above", {0, 1, 0})});
  EXPECT_EQ(found.node_numbers, mesh.node_numbers);
  EXPECT_EQ(found.blocks.back().names, mesh.blocks.back().names);
  EXPECT_EQ(found.blocks.back().numbers, mesh.blocks.back().numbers);
  EXPECT_EQ(found.blocks.front().numbers, (std::vector<std::int64_t>{7, 8}));
}

struct Refusal {
  std::string name;
  std::vector<MadeGroup> groups;
  std::string sentence;
};

std::ostream& operator<<(std::ostream& out, const Refusal& bad) {
  return out << bad.name;
}

class ImpossibleGroups : public testing::TestWithParam<Refusal> {};

TEST_P(ImpossibleGroups, AreRefusedWithAReason) {
  const auto sentence = refusal(cube(), GetParam().groups);
  EXPECT_NE(sentence.find(GetParam().sentence), std::string::npos) << sentence;
}

INSTANTIATE_TEST_SUITE_P(
    As, ImpossibleGroups,
    testing::Values(
        Refusal{"EmptyBox",
                {box("a", {2.5, 0, 0}, {3, 1, 1})},
                "mesh.groups.a: found no node there; N3 (2, 0, 0) is the nearest, 0.5 away"},
        Refusal{"EmptyPlane",
                {plane("a", {0, 0, 3.25}, {0, 0, 1})},
                "0.25 away; 'within' takes what is near the surface"},
        Refusal{"EmptyFaces",
                {taking(box("a", {0, 1.5, 0}, {2, 2, 3}), GroupTake::faces)},
                "mesh.groups.a: found no face there; the face of nodes"},
        Refusal{"EmptyCells",
                {taking(box("a", {0, 0, 0}, {0.5, 1, 3}), GroupTake::cells)},
                "found no cell there; cell "},
        Refusal{"NoFaceOfThisNormal",
                {facing("a", {1, 1, 0}, 20)},
                "found no face with this outward normal; that of the face of nodes"},
        Refusal{"NothingShared",
                {made("a", GroupKind::intersection, {"left", "right"})},
                "mesh.groups.a: found nothing that these groups share"},
        Refusal{"NothingLeft",
                {made("a", GroupKind::difference, {"left", "body", "left"})},
                "nothing is left of 'left'"},
        Refusal{"UnknownName",
                {made("a", GroupKind::union_of, {"left", "rigth"})},
                "mesh.groups.a.union.1: found 'rigth', expected a group or a node of the mesh; did you mean "
                "'right'?"},
        Refusal{"MixedKinds",
                {made("n", GroupKind::nodes_of, {"left"}), made("a", GroupKind::union_of, {"n", "left"})},
                "mesh.groups.a.union.1: found 'left', which holds cells, beside nodes"},
        Refusal{"NodesWhereCellsBelong",
                {made("n", GroupKind::nodes_of, {"left"}), made("a", GroupKind::skin, {"n"})},
                "mesh.groups.a.skin: found 'n', which holds nodes, expected a group of cells"},
        Refusal{"SkinOfFaces", {made("a", GroupKind::skin, {"left"})}, "expected a group of solid cells"},
        Refusal{
            "KnownName", {made("left", GroupKind::skin, {"body"})}, "the mesh has a group 'left' already"},
        Refusal{"NameOfANode", {made("N1", GroupKind::skin, {"body"})}, "a node of the mesh is called 'N1'"}),
    [](const auto& refusal) { return refusal.param.name; });

TEST(ImpossibleGroups, AreAllToldButNotThoseThatNeedThem) {
  const std::vector<MadeGroup> groups{made("a", GroupKind::skin, {"nowhere"}),
                                      made("b", GroupKind::nodes_of, {"a"}),
                                      box("c", {9, 9, 9}, {10, 10, 10})};
  try {
    with_groups(cube(), groups);
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 2U);
    EXPECT_EQ(error.faults()[0].path, "mesh.groups.a.skin");
    EXPECT_EQ(error.faults()[1].path, "mesh.groups.c");
  }
}

TEST(FacesByTheirNormal, AreRefusedWhereTheyBoundNoBody) {
  auto mesh = cube();
  auto builder = MeshBuilder::on_nodes_of(mesh);
  const auto face = builder.add_cell(CellType::tria3, std::array{0, 1, 2});
  builder.add_to_cell_group("sheet", std::array{face});
  auto group = facing("a", {0, 0, 1});
  group.of = {"sheet"};
  EXPECT_NE(refusal(std::move(builder).build(), {group}).find("which bounds no body"), std::string::npos);
}

} // namespace
} // namespace rubato::mesh::made_groups_test
