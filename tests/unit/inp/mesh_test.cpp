// SPDX-License-Identifier: LGPL-3.0-or-later
// Meshes of .inp files, and that they are the same once they are written to MED.
#include "rubato/cell/reference_cell.hpp"
#include "rubato/mesh/io/inp.hpp"
#include "rubato/mesh/io/inp_content.hpp"
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/quality.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "computed.hpp"
#include "small_files.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <map>
#include <set>

namespace rubato::mesh::mesh_test {
namespace {

using test::all_inp_files;
using test::inp_file;

Mesh parsed(const std::string& text) {
  return inp::mesh_of(inp::parse_content(text, "a.inp"));
}

/// Cells of each number, as type and numbers of nodes.
std::map<std::int64_t, std::pair<CellType, std::vector<std::int64_t>>> cells_of(const Mesh& mesh) {
  std::map<std::int64_t, std::pair<CellType, std::vector<std::int64_t>>> cells;
  for (const auto& block : mesh.blocks)
    for (CellIndex i = 0; i < block.cell_count(); ++i) {
      auto& [type, nodes] = cells[block.numbers[static_cast<std::size_t>(i)]];
      type = block.type;
      for (const auto node : block.cell(i))
        nodes.push_back(mesh.node_numbers[static_cast<std::size_t>(node)]);
    }
  return cells;
}

/// Members of each group by their numbers.
std::map<std::string, std::set<std::int64_t>> groups_of(const Mesh& mesh, bool of_nodes) {
  std::vector<std::int64_t> cell_numbers;
  for (const auto& block : mesh.blocks)
    cell_numbers.insert(cell_numbers.end(), block.numbers.begin(), block.numbers.end());
  const auto& numbers = of_nodes ? mesh.node_numbers : cell_numbers;
  std::map<std::string, std::set<std::int64_t>> groups;
  for (const auto& group : of_nodes ? mesh.node_groups : mesh.cell_groups)
    for (const auto item : group.items)
      groups[group.name].insert(numbers[static_cast<std::size_t>(item)]);
  return groups;
}

TEST(InpMesh, EqualsItsMedTwin) {
  const test::ScratchFolder folder;
  const auto files = all_inp_files();
  ASSERT_GE(files.size(), 40U);
  for (const auto& file : files) {
    const auto mesh = read_mesh(file);
    write_mesh(folder / "twin.med", mesh);
    const auto twin = read_mesh(folder / "twin.med");
    EXPECT_EQ(twin.dimension, mesh.dimension) << file;
    EXPECT_EQ(twin.node_numbers, mesh.node_numbers) << file;
    ASSERT_EQ(twin.points.size(), mesh.points.size()) << file;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      EXPECT_EQ(twin.points[i], mesh.points[i]) << file;
    EXPECT_EQ(cells_of(twin), cells_of(mesh)) << file;
    EXPECT_EQ(groups_of(twin, true), groups_of(mesh, true)) << file;
    EXPECT_EQ(groups_of(twin, false), groups_of(mesh, false)) << file;
  }
}

TEST(InpMesh, HasTheNodesOfEveryElementWhereItsCellHasThem) {
  // Exchanged nodes would turn cells inside out or bend their edges.
  for (const auto* name : {"c3d4", "c3d5", "c3d6", "c3d8", "c3d10", "c3d15", "c3d20", "c3d27", "cps3", "cps4",
                           "cps6", "cps8r"}) {
    const auto text = to_text(examine(read_inp(inp_file(name))));
    EXPECT_NE(text.find("nothing looks wrong"), std::string::npos) << name << "\n" << text;
  }
}

TEST(InpMesh, PutsTheInnerNodesOf27WhereTheyAreInWhateverOrder) {
  const auto content = inp::read_content(inp_file("c3d27"));
  const auto mesh = inp::mesh_of(content);
  const auto& block = mesh.blocks.back();
  ASSERT_EQ(block.type, CellType::hexa27);
  const auto& reference = cell::reference_cell(CellType::hexa27);
  // The first cell is the box [0,1]³, the reference cell [−1,1]³.
  for (std::size_t i = 0; i < 27; ++i) {
    const auto& point = mesh.points[static_cast<std::size_t>(block.cell(0)[i])];
    const Eigen::Vector3d expected = 0.5 * (reference.nodes[i].array() + 1);
    EXPECT_LT((point - expected).norm(), 1e-12) << i;
  }
}

TEST(InpMesh, HasTheFacesThatLabelsName) {
  const std::string box = "*NODE\n" + test::cube_nodes;
  struct Shape {
    const char* element;
    std::vector<std::set<std::int64_t>> faces; ///< S1 to S6
  };
  const std::vector<Shape> shapes{
      {"C3D8\n 1, 1, 2, 3, 4, 5, 6, 7, 8",
       {{1, 2, 3, 4}, {5, 6, 7, 8}, {1, 2, 5, 6}, {2, 3, 6, 7}, {3, 4, 7, 8}, {4, 1, 8, 5}}},
      {"C3D4\n 1, 1, 2, 3, 5", {{1, 2, 3}, {1, 2, 5}, {2, 3, 5}, {1, 3, 5}}},
      {"C3D6\n 1, 1, 2, 3, 5, 6, 7", {{1, 2, 3}, {5, 6, 7}, {1, 2, 5, 6}, {2, 3, 6, 7}, {3, 1, 7, 5}}},
      {"C3D5\n 1, 1, 2, 3, 4, 5", {{1, 2, 3, 4}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {4, 1, 5}}}};
  for (const auto& shape : shapes)
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
      const auto mesh = parsed(fmt::format("{}*ELEMENT, ELSET=E, TYPE={}\n*SURFACE, NAME=S\n E, S{}\n", box,
                                           shape.element, face + 1));
      const auto* const group = mesh.cell_group("S");
      ASSERT_NE(group, nullptr);
      ASSERT_EQ(group->items.size(), 1U);
      std::set<std::int64_t> nodes;
      for (const auto node : mesh.nodes_of(group->items[0]))
        nodes.insert(mesh.node_numbers[static_cast<std::size_t>(node)]);
      EXPECT_EQ(nodes, shape.faces[face]) << shape.element << " S" << face + 1;
    }
}

TEST(InpMesh, PlacesInstancesAndTellsTheirNumbersApart) {
  const auto mesh = read_inp(inp_file("instances"));
  EXPECT_EQ(mesh.node_count(), 16);
  // Turned by 180 degrees about x = 2, z between 0 and 1 after the move: node 2 of the second lies at x = 1.
  const auto nodes = find_nodes(mesh, "N12").nodes;
  ASSERT_EQ(nodes.size(), 1U);
  EXPECT_LT((mesh.points[static_cast<std::size_t>(nodes[0])] - Eigen::Vector3d(1, 0, 1)).norm(), 1e-12);
  // The label that both have is told by the instance, the others are as they are.
  EXPECT_NE(mesh.node_group("Block-1.Left"), nullptr);
  EXPECT_NE(mesh.node_group("Tip"), nullptr);
  EXPECT_NE(mesh.cell_group("Block-2.Right"), nullptr);
  EXPECT_EQ(mesh.node_group("Sides")->items.size(), 16U);
}

TEST(InpMesh, ReadsEveryFormOfLine) {
  const auto mesh = read_inp(inp_file("syntax"));
  const auto twin = read_inp(inp_file("c3d8"));
  ASSERT_EQ(mesh.points.size(), twin.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    EXPECT_EQ(mesh.points[i], twin.points[i]);
  EXPECT_EQ(mesh.cell_group("SKIN")->items.size(), 10U);
  EXPECT_EQ(mesh.node_group("TOP_NODES")->items.size(), 4U);
  EXPECT_EQ(mesh.node_group("Every Node")->items.size(), 12U);
  const auto groups = groups_of(mesh, true);
  const auto others = groups_of(twin, true);
  EXPECT_EQ(groups.at("x0"), others.at("X0"));
  EXPECT_EQ(groups.at("Y0"), others.at("Y0"));
  EXPECT_EQ(groups.at("Z0"), others.at("Z0"));
}

TEST(InpMesh, IsReadByItsFirstBytesToo) {
  const test::ScratchFolder folder;
  std::filesystem::copy_file(inp_file("c3d8"), folder / "mesh.txt");
  EXPECT_EQ(read_mesh(folder / "mesh.txt").node_count(), 12);
}

} // namespace
} // namespace rubato::mesh::mesh_test
