// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/mail.hpp"
#include "rubato/mesh/io/mail_cells.hpp"
#include "rubato/mesh/io/mesh_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "one_cell.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <fstream>
#include <numbers>

namespace rubato::mesh::mail_test {
namespace {

using test::fault_of;
using test::ScratchFolder;

class MailFile : public testing::Test {
protected:
  Mesh read(const std::string& text) const {
    std::ofstream(folder_ / "a.mail") << text;
    return read_mail(folder_ / "a.mail");
  }
  /// What reading the text is refused with, without the path of the file: "4:2: found …".
  std::string refusal(const std::string& text) const {
    const auto fault = fault_of([&] { read(text); });
    const auto prefix = (folder_ / "a.mail").string() + ":";
    EXPECT_TRUE(fault.starts_with(prefix)) << fault;
    return fault.substr(std::min(fault.size(), prefix.size()));
  }
  void expect_refusal(const std::string& text, const std::string& expected) const {
    const auto fault = refusal(text);
    EXPECT_TRUE(fault.starts_with(expected)) << fault;
  }

  ScratchFolder folder_;
};

const std::string square = R"(TITRE
 a square, 50 % of it shown: FINSF is no end here
FINSF
% nodes
COOR_2D  NBOBJ = 4  AUTEUR=me
 A 0. 0.   B 1 0
 C, .1E1, +10.D-1
 tip1
   0d0 1.E+0 % a line that goes on
FINSF
QUAD4
 M1 A B
    C tip1
FINSF
GROUP_NO NOM = bottom
 A B A
FINSF
GROUP_MA
 QUAD4 M1
FINSF
SEG2
 side B C
FINSF
GROUP_MA
empty
FINSF
FIN
what follows is not read
)";

TEST_F(MailFile, IsReadWithTheNamesOfItsNodesCellsAndGroups) {
  const auto mesh = read(square);
  EXPECT_EQ(mesh.dimension, 2);
  EXPECT_EQ(mesh.node_names, (std::vector<std::string>{"A", "B", "C", "tip1"}));
  EXPECT_EQ(mesh.node_numbers, (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(mesh.points[2], Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(mesh.points[3], Eigen::Vector3d(0, 1, 0));
  ASSERT_EQ(mesh.blocks.size(), 2U);
  EXPECT_EQ(mesh.blocks[0].type, CellType::seg2);
  EXPECT_EQ(mesh.blocks[0].names, std::vector<std::string>{"side"});
  EXPECT_EQ(mesh.blocks[0].numbers, std::vector<std::int64_t>{2});
  EXPECT_EQ(mesh.blocks[1].nodes, (std::vector<NodeIndex>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.node_group("bottom")->items, (std::vector<NodeIndex>{0, 1}));
  EXPECT_EQ(mesh.cell_group("QUAD4")->items, std::vector<CellIndex>{1});
  EXPECT_TRUE(mesh.cell_group("empty")->items.empty());
}

TEST_F(MailFile, MaySkipTheLinesThatItsHeadersAnnounce) {
  const auto mesh = read(R"(COOR_2D NBLIGE = 3 NOM = INDEFINI
  AUTEUR INTERFACE
  DATE 1/1/00
 N1 0 0
FINSF
POI1 NBLIGE=1
 M1 N1
FINSF
GROUP_NO NBLIGE=2 NOM=all
  words of a header
 N1
FINSF
FIN
)");
  EXPECT_EQ(mesh.node_names, std::vector<std::string>{"N1"});
  EXPECT_EQ(mesh.node_group("all")->items, std::vector<NodeIndex>{0});
}

TEST_F(MailFile, IsRecognisedByItsFirstWord) {
  std::ofstream(folder_ / "a.txt") << square;
  EXPECT_EQ(read_mesh(folder_ / "a.txt").node_count(), 4);
}

/// The points of a cell in its reference shape, in Code_Aster's order.
test::Points in_their_order(const mail::KnownType& type) {
  const auto ours = test::filled(type.ours, test::reference_corners(type.ours));
  auto theirs = ours;
  for (std::size_t i = 0; i < type.order.size(); ++i)
    theirs[type.order[i]] = ours[i];
  return theirs;
}

TEST(MailCells, StandInTheOrderOfTheCellTypes) {
  for (const auto& cell : cell::all_topologies())
    EXPECT_EQ(mail::all_types()[static_cast<std::size_t>(cell.type)].ours, cell.type);
  EXPECT_EQ(mail::type_named("POI1")->ours, CellType::point1);
  EXPECT_EQ(mail::type_named("PYRAM13")->ours, CellType::pyra13);
}

// Code_Aster documentation R3.01.01: between which corners each node stands, from 1.
TEST(MailCells, HaveTheNodesOfCodeAstersReferenceElements) {
  using Nodes = std::vector<std::vector<int>>;
  const auto expect = [](std::string_view name, int first, const Nodes& between) {
    const auto points = in_their_order(*mail::type_named(name));
    for (std::size_t i = 0; i < between.size(); ++i) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const int corner : between[i])
        sum += points[static_cast<std::size_t>(corner) - 1];
      const auto node = static_cast<std::size_t>(first) - 1 + i;
      EXPECT_LT((points[node] - sum / static_cast<double>(between[i].size())).norm(), 1e-15)
          << name << " node " << node + 1;
    }
    EXPECT_EQ(points.size(), static_cast<std::size_t>(first) - 1 + between.size()) << name;
  };
  expect("TETRA10", 5, {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}});
  expect("PYRAM13", 6, {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 5}, {3, 5}, {4, 5}});
  Nodes prism{{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 5}, {3, 6}, {4, 5}, {5, 6}, {6, 4}};
  expect("PENTA15", 7, prism);
  prism.insert(prism.end(), {{1, 2, 5, 4}, {2, 3, 6, 5}, {3, 1, 4, 6}});
  expect("PENTA18", 7, prism);
  Nodes box{{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 6}, {3, 7}, {4, 8}, {5, 6}, {6, 7}, {7, 8}, {8, 5}};
  expect("HEXA20", 9, box);
  box.insert(box.end(), {{1, 2, 3, 4},
                         {1, 2, 6, 5},
                         {2, 3, 7, 6},
                         {3, 4, 8, 7},
                         {4, 1, 5, 8},
                         {5, 6, 7, 8},
                         {1, 2, 3, 4, 5, 6, 7, 8}});
  expect("HEXA27", 9, box);
}

TEST_F(MailFile, HoldsEveryCellType) {
  for (const auto& type : mail::all_types()) {
    SCOPED_TRACE(type.name);
    const auto points = in_their_order(type);
    std::string nodes, cell = " M1";
    for (std::size_t i = 0; i < points.size(); ++i) {
      nodes +=
          fmt::format(" N{} {:.17g} {:.17g} {:.17g}\n", i + 1, points[i].x(), points[i].y(), points[i].z());
      cell += fmt::format("\n N{}", i + 1);
    }
    const auto mesh = read(fmt::format("COOR_3D\n{}FINSF\n{}\n{}\nFINSF\nFIN\n", nodes, type.name, cell));
    ASSERT_EQ(mesh.blocks.size(), 1U);
    EXPECT_EQ(mesh.blocks.front().type, type.ours);
    EXPECT_EQ(test::points_of(mesh, mesh.blocks.front(), 0),
              test::filled(type.ours, test::reference_corners(type.ours)));
  }
}

TEST_F(MailFile, IsWrittenAndReadBackWithEveryCellType) {
  for (const auto& cell : cell::all_topologies()) {
    SCOPED_TRACE(cell.name);
    auto mesh = test::one_cell(cell.type, 3);
    for (auto& point : mesh.points)
      point = std::numbers::pi * point + Eigen::Vector3d(-1e-300, 1. / 3, -1e300);
    write_mail(folder_ / "b.mail", mesh);
    const auto read = read_mail(folder_ / "b.mail");
    EXPECT_EQ(read.points, mesh.points);
    ASSERT_EQ(read.blocks.size(), 1U);
    EXPECT_EQ(read.blocks.front().type, cell.type);
    EXPECT_EQ(read.blocks.front().nodes, mesh.blocks.front().nodes);
    EXPECT_EQ(read.blocks.front().names, std::vector<std::string>{"M7"});
    EXPECT_EQ(read.node_names.front(), "N11");
    for (const auto& group : mesh.node_groups)
      EXPECT_EQ(read.node_group(group.name)->items, group.items);
    for (const auto& group : mesh.cell_groups)
      EXPECT_EQ(read.cell_group(group.name)->items, group.items);
  }
}

TEST_F(MailFile, IsWrittenInLinesOfAtMostEightyColumns) {
  auto mesh = test::one_cell(CellType::hexa27, 3);
  mesh.points.front() = {-1e-300, -1. / 3, -1e300};
  write_mail(folder_ / "b.mail", mesh);
  std::ifstream stream(folder_ / "b.mail");
  for (std::string line; std::getline(stream, line);)
    EXPECT_LE(line.size(), 80U) << line;
}

TEST_F(MailFile, IsNotWrittenWithNamesThatItCannotHold) {
  auto mesh = test::one_cell(CellType::quad4, 2);
  const auto refused = [&] { return fault_of([&] { write_mail(folder_ / "b.mail", mesh); }); };
  mesh.node_groups.front().name = "left side";
  EXPECT_TRUE(refused().starts_with("group 'left side' cannot be written")) << refused();
  mesh.node_groups.front().name = "left";
  mesh.node_numbers.front() = 12345678;
  EXPECT_TRUE(refused().starts_with("node 'N12345678' cannot be written")) << refused();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.mail"));
}

const std::string nodes = "COOR_2D\n N1 0 0\n N2 1 0\n N3 0 1\nFINSF\n";

TEST_F(MailFile, ThatEndsEarlyIsRefused) {
  expect_refusal(nodes, "6:1: found the end of the file, expected FIN before it");
  expect_refusal("COOR_2D\n N1 0 0\n", "3:1: found the end of the file in the block COOR_2D of line 1");
  expect_refusal("TITRE\n x\n", "3:1: found the end of the file in the block TITRE of line 1");
  expect_refusal(nodes + "TRIA3\n M1 N1 N2", "7:10: found the end of the file after 2 nodes of cell 'M1'");
  expect_refusal(nodes + "GROUP_NO\n", "7:1: found the end of the file, expected the name of the GROUP_NO");
  expect_refusal("COOR_2D\n N1 0", "2:6: found '', expected a number, coordinate 2 of node 'N1'");
  expect_refusal("", "1:1: found the end of the file, expected FIN before it");
  expect_refusal("FIN\n", "2:1: found no nodes (COOR_2D or COOR_3D) in the file");
  expect_refusal(nodes + "FIN\n", "7:1: found no cells in the file");
}

TEST_F(MailFile, WithWordsOutOfPlaceIsRefused) {
  expect_refusal(nodes + "TRIA33\n", "6:1: found 'TRIA33', expected FIN, or a block that this program knows; "
                                     "did you mean 'TRIA3'?");
  expect_refusal("COOR_1D\n", "1:1: found 'COOR_1D', expected FIN, or a block");
  expect_refusal(nodes + "COOR_3D\n", "6:1: found COOR_3D, expected COOR_2D as in line 1");
  expect_refusal("COOR_2D\n N1 0 x\n", "2:7: found 'x', expected a number, coordinate 2 of node 'N1'");
  expect_refusal("COOR_2D\n N1 0 nan\n", "2:7: found 'nan', expected a number");
  expect_refusal("COOR_2D N1 0 0\n", "1:9: found 'N1' on the line of COOR_2D, expected KEY = value there");
  expect_refusal("COOR_2D\n N1 0 0\nPOI1\n M1 N1\nFINSF\nFIN\n",
                 "3:1: found 'POI1' in the block COOR_2D of line 1, expected FINSF before it");
  expect_refusal("COOR_2D\n" + std::string(79, ' ') + "N1 0 0\n", "2:80: found 'N1' beyond column 80");
}

TEST_F(MailFile, WithAWrongNumberOfNodesInACellIsRefused) {
  expect_refusal(
      nodes + "TRIA3\n M1 N1 N2\nFINSF\nFIN\n",
      "8:1: found 'FINSF' after 2 nodes of cell 'M1', expected 3 nodes of each cell of the block TRIA3");
  expect_refusal(
      nodes + "TRIA3\n M1 N1 N2\n M2 N1 N2 N3\nFINSF\nFIN\n",
      "9:1: found 'FINSF' after 2 nodes of cell 'N1', expected 3 nodes of each cell of the block TRIA3");
  expect_refusal(nodes + "TRIA3\n M1 N1 N2\n M2 N1 N2 N3 N1\nFINSF\nFIN\n",
                 "8:2: found 'M2' in TRIA3 cell 'M1', expected the name of a node of the file");
}

TEST_F(MailFile, WithUnknownNamesIsRefused) {
  const auto cell = nodes + "TRIA3\n M1 N1 N2 N3\nFINSF\n";
  expect_refusal(
      nodes + "TRIA3\n M1 N1 N2 N33\nFINSF\nFIN\n",
      "7:11: found 'N33' in TRIA3 cell 'M1', expected the name of a node of the file; did you mean "
      "'N3'?");
  expect_refusal(cell + "GROUP_NO\n left N1\n M1\nFINSF\nFIN\n",
                 "11:2: found 'M1' in group 'left', expected");
  expect_refusal(
      cell + "GROUP_MA\n left N1\nFINSF\nFIN\n",
      "10:7: found 'N1' in group 'left', expected the name of a cell of the file; did you mean 'M1'?");
}

TEST_F(MailFile, WithANameGivenTwiceIsRefused) {
  expect_refusal("COOR_2D\n N1 0 0\n N1 1 0\nFINSF\nPOI1\n M1 N1\nFINSF\nFIN\n",
                 "3:2: found node 'N1' a second time, expected each name once: it stands in line 2 too");
  expect_refusal(nodes + "POI1\n M1 N1\nFINSF\nSEG2\n M1 N1 N2\nFINSF\nFIN\n",
                 "10:2: found cell 'M1' a second time");
  expect_refusal(nodes + "POI1\n M1 N1\nFINSF\nGROUP_MA NOM=a\nFINSF\nGROUP_MA NOM = a\n M1\nFINSF\nFIN\n",
                 "11:16: found group of cells 'a' a second time");
}

} // namespace
} // namespace rubato::mesh::mail_test
