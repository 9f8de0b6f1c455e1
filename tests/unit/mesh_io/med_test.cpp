// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/med.hpp"

#include <gtest/gtest.h>

#include "one_cell.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <fstream>

namespace rubato::mesh::med_test {
namespace {

using test::fault_of;
using test::ScratchFolder;

void expect_same_groups(const std::vector<Group>& a, const std::vector<Group>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].name, b[i].name);
    EXPECT_EQ(a[i].items, b[i].items) << a[i].name;
  }
}

void expect_same(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.dimension, b.dimension);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.node_numbers, b.node_numbers);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].type, b.blocks[i].type);
    EXPECT_EQ(a.blocks[i].nodes, b.blocks[i].nodes);
    EXPECT_EQ(a.blocks[i].numbers, b.blocks[i].numbers);
  }
  expect_same_groups(a.node_groups, b.node_groups);
  expect_same_groups(a.cell_groups, b.cell_groups);
}

/// Two triangles, a quadrangle and two edges; groups that overlap, and one name for nodes and cells.
Mesh small_mesh() {
  Mesh mesh;
  mesh.dimension = 2;
  for (int i = 0; i < 6; ++i)
    mesh.points.emplace_back(i % 3, i / 3, 0.0);
  mesh.node_numbers = {1, 2, 3, 4, 5, 60};
  mesh.blocks = {{CellType::seg2, {0, 1, 1, 2}, {20, 21}},
                 {CellType::tria3, {0, 1, 4, 0, 4, 3}, {1, 2}},
                 {CellType::quad4, {1, 2, 5, 4}, {3}}};
  mesh.node_groups = {{"left", {0, 3}}, {"lower", {0, 1, 2}}};
  mesh.cell_groups = {{"all", {2, 3, 4}}, {"lower", {0, 1}}, {"triangles", {2, 3}}};
  return mesh;
}

TEST(MedFile, KeepsEveryCellTypeWithItsGroupsAndNumbers) {
  const ScratchFolder folder;
  for (const auto& cell : cell::all_topologies()) {
    SCOPED_TRACE(cell.name);
    for (int dimension = std::max(2, cell.dimension); dimension <= 3; ++dimension) {
      const auto mesh = test::one_cell(cell.type, dimension);
      write_med(folder / "cell.med", mesh, "one");
      expect_same(read_med(folder / "cell.med"), mesh);
    }
  }
}

TEST(MedFile, KeepsOverlappingGroupsAcrossBlocks) {
  const ScratchFolder folder;
  write_med(folder / "small.med", small_mesh(), "small");
  expect_same(read_med(folder / "small.med", "small"), small_mesh());
}

TEST(MedFile, CountsFromOneWhereTheFileHasNoNumbers) {
  const ScratchFolder folder;
  auto mesh = small_mesh();
  mesh.node_numbers.clear();
  for (auto& block : mesh.blocks)
    block.numbers.clear();
  write_med(folder / "small.med", mesh);
  const auto read = read_med(folder / "small.med");
  EXPECT_EQ(read.node_numbers, (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(read.blocks[1].numbers, (std::vector<std::int64_t>{3, 4}));
}

TEST(MedFile, ReplacesAFileThatIsAlreadyThere) {
  const ScratchFolder folder;
  write_med(folder / "small.med", test::one_cell(CellType::hexa27, 3));
  write_med(folder / "small.med", small_mesh());
  expect_same(read_med(folder / "small.med"), small_mesh());
}

TEST(MedFile, IsRefusedWhenItCannotBeOpened) {
  const ScratchFolder folder;
  EXPECT_EQ(fault_of([&] { read_med(folder / "none.med"); }),
            "mesh file '" + (folder / "none.med").string() + "' does not exist");
  EXPECT_NE(fault_of([&] { read_med(folder.path()); }).find("is a directory"), std::string::npos);
  EXPECT_NE(
      fault_of([&] { write_med(folder / "no/such/folder.med", small_mesh()); }).find("cannot be written"),
      std::string::npos);
}

TEST(MedFile, IsRefusedWhenItIsNotHdf5) {
  const ScratchFolder folder;
  std::ofstream(folder / "empty.med");
  std::ofstream(folder / "text.med") << "$MeshFormat\n2.2 0 8\n";
  EXPECT_NE(fault_of([&] { read_med(folder / "empty.med"); }).find("is empty"), std::string::npos);
  EXPECT_NE(fault_of([&] { read_med(folder / "text.med"); }).find("does not begin as an HDF5 file"),
            std::string::npos);
}

TEST(MedFile, SuggestsTheNearestMeshName) {
  const ScratchFolder folder;
  write_med(folder / "small.med", small_mesh(), "beams");
  const auto fault = fault_of([&] { read_med(folder / "small.med", "beans"); });
  EXPECT_NE(fault.find("holds no mesh 'beans', did you mean 'beams'?"), std::string::npos) << fault;
}

TEST(MedFile, RefusesNamesAndNumbersThatMedCannotHold) {
  const ScratchFolder folder;
  EXPECT_NE(fault_of([&] { write_med(folder / "a.med", small_mesh(), std::string(65, 'x')); }).find("64"),
            std::string::npos);
  auto mesh = small_mesh();
  mesh.cell_groups.push_back({std::string(81, 'g'), {0}});
  EXPECT_NE(fault_of([&] { write_med(folder / "a.med", mesh); }).find("at most 80"), std::string::npos);
  mesh = small_mesh();
  mesh.node_numbers.back() = std::int64_t{1} << 40;
  EXPECT_NE(fault_of([&] { write_med(folder / "a.med", mesh); }).find("beyond MED's integers"),
            std::string::npos);
}

} // namespace
} // namespace rubato::mesh::med_test
