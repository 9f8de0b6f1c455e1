// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/convert.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/refine.hpp"

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace rubato::mesh::names_test {
namespace {

using Nodes = std::vector<NodeIndex>;

/// Five nodes on a line with numbers 1 to 5, two segments, groups of both kinds.
Mesh line() {
  Mesh mesh;
  mesh.dimension = 2;
  for (int i = 0; i < 5; ++i) {
    mesh.points.emplace_back(i, 0, 0);
    mesh.node_numbers.push_back(i + 1);
  }
  mesh.blocks = {{CellType::seg2, {0, 1, 1, 2}, {7, 8}, {}}};
  mesh.node_groups = {{"ends", {0, 4}}, {"nothing", {}}};
  mesh.cell_groups = {{"edge", {0, 1}}};
  return mesh;
}

/// The same with names that are none of the numbers' own.
Mesh named_line() {
  auto mesh = line();
  mesh.node_names = {"N291", "N5", "tip", "N1", "N40"};
  mesh.blocks.front().names = {"M1", "M2"};
  return mesh;
}

TEST(NodeNames, AreGroupsFirst) {
  EXPECT_EQ(find_nodes(line(), "ends").nodes, (Nodes{0, 4}));
  EXPECT_EQ(find_nodes(named_line(), "edge").nodes, (Nodes{0, 1, 2}));
  EXPECT_EQ(find_nodes(line(), "nothing").fault,
            "group 'nothing' is empty, expected a group with nodes, or a node");
}

TEST(NodeNames, AreNumbersWhereTheFileHasNoNames) {
  for (const auto* name : {"N5", "n5", "5"})
    EXPECT_EQ(find_nodes(line(), name).nodes, Nodes{4}) << name;
  EXPECT_EQ(find_nodes(line(), "N9").fault,
            "found 'N9', expected a group or a node ('N90') of the mesh; the mesh has "
            "the groups edge, ends, nothing");
}

TEST(NodeNames, AreTheFilesWhereItHasThem) {
  EXPECT_EQ(find_nodes(named_line(), "N291").nodes, Nodes{0});
  EXPECT_EQ(find_nodes(named_line(), "N5").nodes, Nodes{1});
  EXPECT_EQ(find_nodes(named_line(), "tip").nodes, Nodes{2});
}

TEST(NodeNames, NeverMeanAnotherNodeThanTheFileSays) {
  EXPECT_EQ(find_nodes(named_line(), "N3").fault, "found 'N3', expected a group or a node (by its name) of "
                                                  "the mesh (the file names its nodes: number 3 is "
                                                  "'tip' there); did you mean 'N5'?");
  EXPECT_EQ(find_nodes(named_line(), "3").nodes, Nodes{});
  EXPECT_NE(find_nodes(named_line(), "N490").fault.find("did you mean 'N40'?"), std::string::npos)
      << find_nodes(named_line(), "N490").fault;
}

TEST(NodeNames, ThatAreAmbiguousAreRefused) {
  auto mesh = named_line();
  mesh.node_names[3] = "tip";
  EXPECT_NE(find_nodes(mesh, "tip").fault.find("'tip', the name of 2 nodes"), std::string::npos);
  mesh = line();
  mesh.node_numbers[3] = 5;
  EXPECT_NE(find_nodes(mesh, "N5").fault.find("'N5', the number of 2 nodes"), std::string::npos);
  mesh = named_line();
  mesh.node_groups.push_back({"tip", {2}});
  EXPECT_EQ(find_nodes(mesh, "tip").nodes, Nodes{2});
  mesh.node_groups.back().items = {1, 2};
  EXPECT_NE(find_nodes(mesh, "tip").fault.find("the name of a group and of a node"), std::string::npos);
}

TEST(NodeNames, AreWhatMessagesCallNodesAndCells) {
  EXPECT_EQ(node_name(line(), 2), "N3");
  EXPECT_EQ(node_name(named_line(), 2), "tip");
  EXPECT_EQ(cell_name(line(), 1), "8");
  EXPECT_EQ(cell_name(named_line(), 1), "M2");
}

TEST(NamesOfTheRest, ComeFromNumbersAndRepeatNone) {
  auto mesh = named_line();
  mesh.node_names = {"", "N1", ""};
  mesh.blocks.push_back({CellType::seg3, {0, 1, 2}, {2}, {}});
  name_the_rest(mesh);
  EXPECT_EQ(mesh.node_names, (std::vector<std::string>{"N1_", "N1", "N3", "N4", "N5"}));
  EXPECT_EQ(mesh.blocks.back().names, std::vector<std::string>{"M2_"});
  mesh.node_names = {"", ""};
  name_the_rest(mesh);
  EXPECT_TRUE(mesh.node_names.empty());
}

/// Names that differ from the numbers, so that a mix-up shows.
Mesh named_body(CellType type) {
  auto mesh = test::mesh_of(type);
  for (const auto number : mesh.node_numbers)
    mesh.node_names.push_back("A" + std::to_string(1000 - number));
  for (auto& block : mesh.blocks)
    for (const auto number : block.numbers)
      block.names.push_back("C" + std::to_string(1000 - number));
  return mesh;
}

void expect_names_kept(const Mesh& now, const Mesh& before) {
  ASSERT_EQ(now.node_names.size(), now.points.size());
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    const auto found = nodes_named(now, before.node_names[i]);
    if (now.points.size() >= before.points.size()) {
      ASSERT_EQ(found.size(), 1U) << before.node_names[i];
    }
    for (const auto node : found)
      EXPECT_EQ(now.points[static_cast<std::size_t>(node)], before.points[i]);
  }
  for (NodeIndex node = 0; node < now.node_count(); ++node)
    EXPECT_EQ(nodes_named(now, node_name(now, node)), Nodes{node});
}

TEST(NodeNames, StayWithTheirNodesWhenAMeshIsConvertedOrRefined) {
  const auto linear = named_body(CellType::hexa8);
  const auto full = to_full_quadratic(linear);
  expect_names_kept(full, linear);
  EXPECT_EQ(full.blocks.back().names, linear.blocks.back().names);
  expect_names_kept(to_linear(full), full);
  expect_names_kept(refined(linear, 2), linear);
}

} // namespace
} // namespace rubato::mesh::names_test
