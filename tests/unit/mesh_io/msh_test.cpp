// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/msh.hpp"
#include "rubato/mesh/names.hpp"

#include <gtest/gtest.h>

#include "msh_making.hpp"
#include "one_cell.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <fstream>

namespace rubato::mesh::msh_test {
namespace {

using test::fault_of;
using test::MshKind;
using test::MshSample;
using test::two_cubes;

class MshFile : public testing::TestWithParam<MshKind> {
protected:
  Mesh read(const std::string& bytes) const {
    std::ofstream(folder_ / "a.msh", std::ios::binary) << bytes;
    return read_msh(folder_ / "a.msh");
  }
  Mesh read(const MshSample& sample) const { return read(msh_bytes(sample, GetParam())); }
  std::string fault(const std::string& bytes) const {
    return fault_of([&] { read(bytes); });
  }

  test::ScratchFolder folder_;
};

std::string with(std::string text, const std::string& part, const std::string& other) {
  const auto at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), other);
}

using Items = std::vector<std::int32_t>;

TEST_P(MshFile, IsReadWithItsNodesCellsAndGroups) {
  const auto mesh = read(two_cubes());
  EXPECT_EQ(mesh.dimension, 3);
  EXPECT_EQ(mesh.node_count(), 12);
  EXPECT_TRUE(std::ranges::is_sorted(mesh.node_numbers));
  EXPECT_EQ(mesh.points[static_cast<std::size_t>(nodes_named(mesh, "N1000").at(0))],
            Eigen::Vector3d(0, 0, 0));
  EXPECT_TRUE(nodes_named(mesh, "N7").empty());
  ASSERT_EQ(mesh.blocks.size(), 3U);
  EXPECT_EQ(mesh.blocks[2].type, CellType::hexa8);
  EXPECT_EQ(mesh.blocks[2].numbers, (std::vector<std::int64_t>{21, 22}));
  for (CellIndex cell = 0; cell < 2; ++cell)
    EXPECT_DOUBLE_EQ(test::measure(CellType::hexa8, test::points_of(mesh, mesh.blocks[2], cell)), 1.0);

  ASSERT_EQ(mesh.cell_groups.size(), 4U);
  for (const auto* name : {"both cubes", "steel"})
    EXPECT_EQ(mesh.cell_group(name)->items, (Items{2, 3})) << name;
  EXPECT_EQ(mesh.cell_group("edge")->items, (Items{0}));
  EXPECT_EQ(mesh.cell_group("surface_12")->items, (Items{1}));
  ASSERT_EQ(mesh.node_groups.size(), 1U);
  const auto tip = nodes_named(mesh, "tip");
  ASSERT_EQ(tip.size(), 1U);
  EXPECT_EQ(mesh.points[static_cast<std::size_t>(tip[0])], Eigen::Vector3d(2, 1, 1));
}

TEST_P(MshFile, KeepsCellsThatAreInNoGroup) {
  auto sample = two_cubes();
  sample.physicals.erase({3, 1});
  EXPECT_EQ(read(sample).cell_count(), 4);
  sample.physicals.clear();
  const auto mesh = read(sample);
  EXPECT_EQ(mesh.cell_count(), 4);
  EXPECT_TRUE(std::ranges::all_of(mesh.cell_groups, [](const Group& group) { return group.items.empty(); }));
}

TEST_P(MshFile, KeepsNamedGroupsThatAreEmpty) {
  auto sample = test::two_cubes();
  sample.names[{2, 77}] = "forgotten";
  sample.names[{0, 78}] = "nowhere";
  sample.names[{2, 79}] = "steel"; // a name that cells have
  const auto mesh = read(sample);
  ASSERT_NE(mesh.cell_group("forgotten"), nullptr);
  EXPECT_TRUE(mesh.cell_group("forgotten")->items.empty());
  ASSERT_NE(mesh.node_group("nowhere"), nullptr);
  EXPECT_TRUE(mesh.node_group("nowhere")->items.empty());
  EXPECT_EQ(std::ranges::count(mesh.cell_groups, "steel", &Group::name), 1);
  EXPECT_EQ(find_nodes(mesh, "forgotten").fault,
            "group 'forgotten' is empty, expected a group with nodes, or a node");
}

TEST_P(MshFile, MakesOneGroupOfThoseThatShareAName) {
  auto sample = two_cubes();
  sample.names[{1, 6}] = "steel";
  EXPECT_EQ(read(sample).cell_group("steel")->items, (Items{0, 2, 3}));
}

TEST_P(MshFile, MayHaveNodesWithParameters) {
  auto sample = two_cubes();
  sample.parametric = true;
  const auto mesh = read(sample);
  EXPECT_EQ(mesh.node_count(), 12);
  EXPECT_EQ(mesh.cell_count(), 4);
}

TEST_P(MshFile, MayHaveOtherSectionsAndDenseOrHugeTags) {
  auto sample = two_cubes();
  const auto other =
      std::string("$Periodic\n1\n0 2 1\n1\n1 2\n$EndPeriodic\n$Comments\n$ a $Nodes\n$EndComments\n");
  const auto text = msh_bytes(sample, GetParam());
  EXPECT_EQ(read(with(text, "$EndMeshFormat\n", "$EndMeshFormat\n\n" + other)).cell_count(), 4);
  EXPECT_EQ(read(text + other + "$NodeData\n1\n\"u\"\n$EndNodeData\n").cell_count(), 4);
  for (auto& [tag, point] : sample.nodes)
    tag += 2000000000;
  for (auto& cells : sample.cells)
    for (auto& nodes : cells.nodes)
      for (auto& node : nodes)
        node += 2000000000;
  EXPECT_EQ(read(sample).node_numbers.back(), 2000001000);
}

struct GmshCell {
  int number;
  CellType type;
  std::vector<std::vector<int>> middles; ///< the corners between which Gmsh's further nodes stand
};

/// The reference manual's "Node ordering".
std::vector<GmshCell> gmsh_cells() {
  const std::vector<std::vector<int>> tetra{{0, 1}, {1, 2}, {0, 2}, {0, 3}, {2, 3}, {1, 3}};
  const std::vector<std::vector<int>> pyra{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 4}, {2, 3}, {2, 4}, {3, 4}};
  const std::vector<std::vector<int>> penta{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 4},
                                            {2, 5}, {3, 4}, {3, 5}, {4, 5}};
  const std::vector<std::vector<int>> hexa{{0, 1}, {0, 3}, {0, 4}, {1, 2}, {1, 5}, {2, 3},
                                           {2, 6}, {3, 7}, {4, 5}, {4, 7}, {5, 6}, {6, 7}};
  auto penta18 = penta;
  penta18.insert(penta18.end(), {{0, 1, 4, 3}, {0, 2, 5, 3}, {1, 2, 5, 4}});
  auto hexa27 = hexa;
  hexa27.insert(hexa27.end(), {{0, 3, 2, 1},
                               {0, 1, 5, 4},
                               {0, 4, 7, 3},
                               {1, 2, 6, 5},
                               {2, 3, 7, 6},
                               {4, 5, 6, 7},
                               {0, 1, 2, 3, 4, 5, 6, 7}});
  const std::vector<std::vector<int>> quad{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  auto quad9 = quad;
  quad9.push_back({0, 1, 2, 3});
  return {{1, CellType::seg2, {}},
          {2, CellType::tria3, {}},
          {3, CellType::quad4, {}},
          {4, CellType::tetra4, {}},
          {5, CellType::hexa8, {}},
          {6, CellType::penta6, {}},
          {7, CellType::pyra5, {}},
          {8, CellType::seg3, {{0, 1}}},
          {9, CellType::tria6, {{0, 1}, {1, 2}, {2, 0}}},
          {16, CellType::quad8, quad},
          {10, CellType::quad9, quad9},
          {11, CellType::tetra10, tetra},
          {19, CellType::pyra13, pyra},
          {18, CellType::penta15, penta},
          {13, CellType::penta18, penta18},
          {17, CellType::hexa20, hexa},
          {12, CellType::hexa27, hexa27}};
}

TEST_P(MshFile, HasTheNodesOfEveryCellInOurOrder) {
  for (const auto& cell : gmsh_cells()) {
    SCOPED_TRACE(cell::topology(cell.type).name);
    auto points = test::reference_corners(cell.type);
    for (const auto& corners : cell.middles)
      points.push_back(test::mean_of(points, corners, static_cast<int>(corners.size())));
    MshSample sample;
    std::vector<std::int64_t> nodes;
    for (const auto& point : points) {
      nodes.push_back(static_cast<std::int64_t>(nodes.size()) + 1);
      sample.nodes.emplace_back(nodes.back(), point);
    }
    sample.cells = {{cell::topology(cell.type).dimension, 1, cell.number, {1}, {nodes}}};
    const auto mesh = read(sample);
    ASSERT_EQ(mesh.blocks.size(), 1U);
    ASSERT_EQ(mesh.blocks[0].type, cell.type);
    const auto expected = test::filled(cell.type, test::reference_corners(cell.type));
    const auto found = test::points_of(mesh, mesh.blocks[0], 0);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_LT((found[i] - expected[i]).norm(), 1e-15) << i;
  }
}

TEST_P(MshFile, IsRefusedWhereverItIsCut) {
  const auto bytes = msh_bytes(two_cubes(), GetParam());
  const auto last = bytes.rfind("$EndElements");
  for (std::size_t length = 0; length < last + 12; ++length) {
    const auto found = fault(bytes.substr(0, length));
    ASSERT_NE(found.find("mesh file '"), std::string::npos) << length << ": " << found;
  }
}

TEST_P(MshFile, IsRefusedWithANodeThatIsNotThere) {
  auto sample = two_cubes();
  sample.cells.back().nodes[1][3] = 4711;
  EXPECT_NE(fault(msh_bytes(sample, GetParam())).find("a cell has node 4711, which it does not give"),
            std::string::npos);
  sample = two_cubes();
  sample.nodes.back().first = sample.nodes.front().first;
  EXPECT_NE(fault(msh_bytes(sample, GetParam())).find("gives node 1000 two places"), std::string::npos);
}

TEST_P(MshFile, IsRefusedWithCellsUnknownHere) {
  auto sample = two_cubes();
  sample.cells.back().type = 92;
  EXPECT_NE(fault(msh_bytes(sample, GetParam())).find("cells of type 92 (third order"), std::string::npos);
}

TEST_P(MshFile, IsRefusedWithoutCells) {
  auto sample = two_cubes();
  sample.cells.resize(1);
  EXPECT_NE(fault(msh_bytes(sample, GetParam())).find("holds no cells"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Gmsh, MshFile, testing::ValuesIn(test::all_msh_kinds),
                         [](const auto& kind) { return kind.param.name(); });

class OddMshFile : public MshFile {};

TEST_P(OddMshFile, MayHaveLineEndsOfWindows) {
  auto text = msh_bytes(two_cubes(), GetParam());
  for (auto at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 2))
    text.insert(at, "\r");
  const auto mesh = read(text);
  EXPECT_EQ(mesh.cell_count(), 4);
  EXPECT_NE(mesh.cell_group("both cubes"), nullptr);
}

TEST_P(OddMshFile, SaysAtWhichLineItIsDamaged) {
  const auto text = msh_bytes(two_cubes(), GetParam());
  const auto found = fault(with(text, "1 1 0 ", "1 one 0 "));
  EXPECT_NE(found.find("found 'one', expected a coordinate"), std::string::npos) << found;
  EXPECT_NE(found.find("is truncated or damaged at line "), std::string::npos) << found;
  EXPECT_NE(fault(with(text, "$EndNodes", "17 0 0 0\n$EndNodes")).find("found '17', expected $EndNodes"),
            std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Text, OddMshFile, testing::Values(MshKind{2}, MshKind{4}),
                         [](const auto& kind) { return kind.param.name(); });

class OldMshFile : public MshFile {};

TEST_P(OldMshFile, HasACellOnceThatItSaysForEachOfItsGroups) {
  auto sample = two_cubes();
  sample.cells.push_back({2, 2, 3, {31}, {sample.cells[2].nodes[0]}}); // on another piece: a cell of its own
  sample.physicals[{2, 1}] = {12, 13, 14};
  sample.physicals[{2, 2}] = {12};
  EXPECT_EQ(read(sample).cell_group("surface_12")->items, (Items{1, 2}));
  EXPECT_EQ(read(sample).cell_group("surface_14")->items, (Items{1}));
}

TEST_P(OldMshFile, MaySayItTurnedTheOtherWay) {
  auto sample = two_cubes();
  auto turned = sample.cells[2];
  std::ranges::reverse(turned.nodes[0]);
  turned.tags = {13};
  turned.entity = 1;
  const auto once = msh_cells_2(sample, GetParam());
  const auto faces = read(sample).cell_group("surface_12")->items;
  sample.cells.push_back(turned);
  auto text = msh_bytes(sample, GetParam());
  if (!GetParam().binary) {
    text = with(text, "13 3 4 12 1 ", "13 3 4 -17 1 ");
    EXPECT_EQ(read(text).cell_group("surface_17")->items, faces);
    EXPECT_EQ(read(text).cell_count(), 4);
  }
}

INSTANTIATE_TEST_SUITE_P(Version2, OldMshFile, testing::Values(MshKind{2}, MshKind{2, true}),
                         [](const auto& kind) { return kind.param.name(); });

TEST(MshVersion4, MayBePartitioned) {
  // The second cube belongs to a part, 9, of the volume, 1, and its groups are those of the part.
  const std::string text = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "steel"
$EndPhysicalNames
$Entities
0 0 0 1
1 0 0 0 1 1 1 1 1 0
$EndEntities
$PartitionedEntities
2
1
7 1
0 0 0 2
8 3 1 1 1 0 0 0 1 1 1 1 1 0
9 3 1 2 1 2 0 0 0 1 1 1 1 -1 2 -3 4
$EndPartitionedEntities
$Nodes
1 5 1 5
3 1 0 5
1
2
3
4
5
0 0 0
1 0 0
0 1 0
0 0 1
0 0 -1
$EndNodes
$Elements
2 2 1 2
3 8 4 1
1 1 2 3 4
3 9 4 1
2 1 3 2 5
$EndElements
)";
  const test::ScratchFolder folder;
  std::ofstream(folder / "a.msh") << text;
  const auto mesh = read_msh(folder / "a.msh");
  EXPECT_EQ(mesh.cell_count(), 2);
  ASSERT_NE(mesh.cell_group("steel"), nullptr);
  EXPECT_EQ(mesh.cell_group("steel")->items, (Items{0, 1}));
}

TEST(MshVersion, OfOtherKindsIsRefusedWithTheCommandThatConvertsIt) {
  const test::ScratchFolder folder;
  const auto fault = [&](const std::string& text) {
    std::ofstream(folder / "a.msh") << text;
    return fault_of([&] { read_msh(folder / "a.msh"); });
  };
  for (const auto* text : {"$NOD\n1\n", "$MeshFormat\n4 0 8\n$EndMeshFormat\n", "$MeshFormat\n5.0 0 8\n"})
    EXPECT_NE(fault(text).find("-save -format msh41 -o new.msh"), std::string::npos) << fault(text);
  EXPECT_NE(fault("(0 \"fluent\")\n").find("is not a Gmsh mesh"), std::string::npos);
  EXPECT_NE(fault("").find("is not a Gmsh mesh"), std::string::npos);
  EXPECT_NE(fault("$MeshFormat\n2.2 7 8\n").find("found file type 7"), std::string::npos);
  EXPECT_NE(fault("$MeshFormat\n2.2 0 4\n").find("found data size 4"), std::string::npos);
  EXPECT_NE(fault_of([&] { read_msh(folder / "none.msh"); }).find("does not exist"), std::string::npos);
  EXPECT_NE(fault_of([&] { read_msh(folder.path()); }).find("is a directory"), std::string::npos);
}

} // namespace
} // namespace rubato::mesh::msh_test
