// SPDX-License-Identifier: LGPL-3.0-or-later
// Names that MED files give nodes and cells, beside their numbers.
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/names.hpp"

#include <gtest/gtest.h>
#include <med.h>

#include "one_cell.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"

namespace rubato::mesh::med_names_test {
namespace {

using test::fault_of;
using test::ScratchFolder;

/// Adds names to the nodes of a MED file of one mesh, by the MED library alone.
void name_nodes(const std::filesystem::path& path, const std::vector<std::string>& names) {
  std::string texts;
  for (auto name : names) {
    name.resize(MED_SNAME_SIZE, ' ');
    texts += name;
  }
  const auto id = MEDfileOpen(path.c_str(), MED_ACC_RDWR);
  EXPECT_GE(MEDmeshEntityNameWr(id, "mesh", MED_NO_DT, MED_NO_IT, MED_NODE, MED_NONE,
                                static_cast<med_int>(names.size()), texts.c_str()),
            0);
  EXPECT_GE(MEDfileClose(id), 0);
}

Mesh square() {
  auto mesh = test::one_cell(CellType::quad4, 2);
  mesh.node_numbers = {1, 2, 3, 4};
  return mesh;
}

TEST(MedNames, AreWhatADeckMeans) {
  const ScratchFolder folder;
  write_med(folder / "named.med", square());
  name_nodes(folder / "named.med", {"N4", "N291", "tip", "N1"});
  const auto mesh = read_med(folder / "named.med");
  EXPECT_EQ(mesh.node_names, (std::vector<std::string>{"N4", "N291", "tip", "N1"}));
  EXPECT_EQ(mesh.node_numbers, (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(nodes_named(mesh, "N1"), std::vector<NodeIndex>{3});
  EXPECT_EQ(nodes_named(mesh, "N291"), std::vector<NodeIndex>{1});
  EXPECT_NE(find_nodes(mesh, "N3").fault.find("number 3 is 'tip' there"), std::string::npos);
}

TEST(MedNames, AreNoneWhereTheyAreAllBlank) {
  const ScratchFolder folder;
  write_med(folder / "blank.med", square());
  name_nodes(folder / "blank.med", {"", "", "", ""});
  const auto mesh = read_med(folder / "blank.med");
  EXPECT_TRUE(mesh.node_names.empty());
  EXPECT_EQ(nodes_named(mesh, "N2"), std::vector<NodeIndex>{1});
}

TEST(MedNames, OfSomeNodesLeaveTheirNumbersToTheOthers) {
  const ScratchFolder folder;
  write_med(folder / "some.med", square());
  name_nodes(folder / "some.med", {"", "N1", "", ""});
  const auto mesh = read_med(folder / "some.med");
  EXPECT_EQ(mesh.node_names, (std::vector<std::string>{"N1_", "N1", "N3", "N4"}));
}

TEST(MedNames, AreWrittenAndReadBack) {
  const ScratchFolder folder;
  auto mesh = square();
  mesh.node_names = {"N4", "N291", "sixteen letters.", "N1"};
  mesh.blocks.front().names = {"M12"};
  write_med(folder / "named.med", mesh);
  const auto read = read_med(folder / "named.med");
  EXPECT_EQ(read.node_names, mesh.node_names);
  EXPECT_EQ(read.node_numbers, mesh.node_numbers);
  EXPECT_EQ(read.blocks.front().names, mesh.blocks.front().names);
  EXPECT_EQ(read.blocks.front().numbers, mesh.blocks.front().numbers);

  mesh.node_names[2] = "seventeen letters";
  EXPECT_NE(fault_of([&] { write_med(folder / "long.med", mesh); }).find("at most 16 letters"),
            std::string::npos);
}

} // namespace
} // namespace rubato::mesh::med_names_test
