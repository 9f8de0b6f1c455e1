// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/mesh_file.hpp"

#include <gtest/gtest.h>

#include "one_cell.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <fstream>

namespace rubato::mesh::mesh_file_test {
namespace {

using test::fault_of;
using test::ScratchFolder;

TEST(MeshFile, IsReadByItsEndingOrByItsFirstBytes) {
  const ScratchFolder folder;
  for (const auto* name : {"a.med", "a.rmed", "a.MED"}) {
    write_mesh(folder / name, test::one_cell(CellType::hexa8, 3));
    EXPECT_EQ(read_mesh(folder / name).node_count(), 8);
  }
  std::filesystem::copy_file(folder / "a.med", folder / "a.hdf");
  EXPECT_EQ(read_mesh(folder / "a.hdf").node_count(), 8);
}

TEST(MeshFile, OfUnknownFormatIsRefused) {
  const ScratchFolder folder;
  std::ofstream(folder / "a.stl") << "solid";
  EXPECT_NE(fault_of([&] {
              read_mesh(folder / "a.stl");
            }).find("is of no format that this program reads: .med, .rmed, .mmed, .msh, .mail"),
            std::string::npos);
  EXPECT_NE(fault_of([&] { read_mesh(folder / "b.stl"); }).find("does not exist"), std::string::npos);
  EXPECT_NE(fault_of([&] { read_mesh(folder.path()); }).find("is a directory"), std::string::npos);
  EXPECT_NE(fault_of([&] { write_mesh(folder / "a.stl", {}); }).find(".med, .mail or .vtu was expected"),
            std::string::npos);
}

TEST(MeshFile, OfAPlaneMeshWithThreeCoordinatesIsPlane) {
  const ScratchFolder folder;
  auto mesh = test::one_cell(CellType::quad8, 3);
  for (auto& point : mesh.points)
    point.z() = 7.5 + 1e-13 * point.x();
  write_mesh(folder / "a.med", mesh);
  const auto read = read_mesh(folder / "a.med");
  EXPECT_EQ(read.dimension, 2);
  for (const auto& point : read.points)
    EXPECT_EQ(point.z(), 0.0);
}

TEST(MeshFile, IsWrittenForParaViewToo) {
  const ScratchFolder folder;
  write_mesh(folder / "a.vtu", test::one_cell(CellType::hexa8, 3));
  std::ifstream stream(folder / "a.vtu");
  std::string text(std::istreambuf_iterator<char>(stream), {});
  EXPECT_NE(text.find("<Piece NumberOfPoints=\"8\" NumberOfCells=\"1\">"), std::string::npos);
}

} // namespace
} // namespace rubato::mesh::mesh_file_test
