// SPDX-License-Identifier: LGPL-3.0-or-later
// MED files as meshio writes them: by HDF5 alone, without the numbers of the cell types (attribute GEO), with
// 64-bit numbers and solids in VTK's order.
#include "rubato/mesh/io/mesh_file.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/mesh/orientation.hpp"

#include <gtest/gtest.h>

#include "hdf5_making.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"

namespace rubato::mesh::meshio_med_test {
namespace {

using test::Hdf5Making;
using test::ScratchFolder;

constexpr const char* no_profile = "MED_NO_PROFILE_INTERNAL";

void write_head(const Hdf5Making& file) {
  file.group("INFOS_GENERALES");
  file.attribute("INFOS_GENERALES", "MAJ", 3);
  file.attribute("INFOS_GENERALES", "MIN", 0);
  file.attribute("INFOS_GENERALES", "REL", 0);
  const std::string mesh = "ENS_MAA/mesh";
  file.group(mesh);
  for (const auto& [name, value] : {std::pair{"DIM", 3}, {"ESP", 3}, {"REP", 0}, {"SRT", 1}, {"TYP", 0}})
    file.attribute(mesh, name, value);
  file.attribute(mesh, "UNT", "", 0);
  file.attribute(mesh, "UNI", "", 0);
  file.attribute(mesh, "NOM", "X               Y               Z               ", 48);
  file.attribute(mesh, "DES", "Mesh created with meshio", 24);
}

const std::string step = "ENS_MAA/mesh/-0000000000000000001-0000000000000000001";

void write_step(const Hdf5Making& file) {
  file.group(step + "/NOE");
  file.group(step + "/MAI");
  file.attribute(step, "CGT", 1);
  file.attribute(step, "NDT", -1);
  file.attribute(step, "NOR", -1);
  file.attribute(step, "PDT", -1.0);
  file.attribute(step + "/MAI", "CGT", 1);
}

void write_part(const Hdf5Making& file, const std::string& group, const std::string& data, int count) {
  file.attribute(group + "/" + data, "CGT", 1);
  file.attribute(group + "/" + data, "NBR", count);
}

void write_entities(const Hdf5Making& file, const std::string& group) {
  file.group(group);
  file.attribute(group, "CGT", 1);
  file.attribute(group, "CGS", 1);
  file.attribute(group, "PFL", no_profile, 23);
}

void write_cells(const Hdf5Making& file, const std::string& type, const std::vector<int>& nodes,
                 const std::vector<int>& families) {
  const auto group = step + "/MAI/" + type;
  write_entities(file, group);
  file.data(group + "/NOD", nodes);
  file.data(group + "/FAM", families);
  for (const auto* data : {"NOD", "FAM"})
    write_part(file, group, data, static_cast<int>(families.size()));
}

void write_family(const Hdf5Making& file, const std::string& path, int number, std::string group) {
  file.group(path + "/GRO");
  file.attribute(path, "NUM", number);
  file.attribute(path + "/GRO", "NBR", 1);
  group.resize(80, '\0');
  file.rows_of_letters(path + "/GRO/NOM", group, 80);
}

/// A unit cube with its bottom and top, one node in a group. `odd`: cells of a type that rubato doesn't know
/// instead of the faces.
void write_cube(const std::filesystem::path& path, bool odd = false) {
  const Hdf5Making file(path);
  write_head(file);
  write_step(file);
  write_entities(file, step + "/NOE");
  file.data(step + "/NOE/COO",
            std::vector<double>{0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 1, 1, 1});
  file.data(step + "/NOE/FAM", std::vector<int>{0, 1, 0, 0, 0, 0, 0, 0});
  for (const auto* data : {"COO", "FAM"})
    write_part(file, step + "/NOE", data, 8);
  write_cells(file, "HE8", {1, 2, 3, 4, 5, 6, 7, 8}, {-1});
  write_cells(file, odd ? "OCT" : "QU4", {1, 5, 2, 6, 3, 7, 4, 8}, {-2, -3});
  file.group("FAS/mesh/FAMILLE_ZERO");
  file.attribute("FAS/mesh/FAMILLE_ZERO", "NUM", 0);
  write_family(file, "FAS/mesh/NOEUD/FAM_1_corner", 1, "corner");
  write_family(file, "FAS/mesh/ELEME/FAM_-1_body", -1, "body");
  write_family(file, "FAS/mesh/ELEME/FAM_-2_bottom", -2, "bottom");
  write_family(file, "FAS/mesh/ELEME/FAM_-3_top", -3, "top");
}

TEST(MeshioMedFile, IsReadWithItsCellsAndGroups) {
  const ScratchFolder folder;
  write_cube(folder / "cube.med");
  auto mesh = read_mesh(folder / "cube.med");
  ASSERT_EQ(mesh.blocks.size(), 2U);
  EXPECT_EQ(mesh.blocks[0].type, CellType::quad4);
  EXPECT_EQ(mesh.blocks[1].type, CellType::hexa8);
  EXPECT_EQ(mesh.node_count(), 8);
  EXPECT_EQ(nodes_named(mesh, "bottom"), (std::vector<NodeIndex>{0, 1, 2, 3}));
  EXPECT_EQ(nodes_named(mesh, "top"), (std::vector<NodeIndex>{4, 5, 6, 7}));
  EXPECT_EQ(nodes_named(mesh, "corner"), (std::vector<NodeIndex>{1}));
  EXPECT_EQ(mesh.cell_group("body")->items, (std::vector<CellIndex>{2}));
  mend_orientation(mesh);
  EXPECT_DOUBLE_EQ(signed_measure(mesh, 2), 1.0);
}

TEST(MeshioMedFile, WithCellsUnknownHereIsRefused) {
  const ScratchFolder folder;
  write_cube(folder / "cube.med", true);
  const auto fault = test::fault_of([&] { read_mesh(folder / "cube.med"); });
  EXPECT_NE(fault.find("holds cells of 2 types, 1 of which this program does not know"), std::string::npos)
      << fault;
}

} // namespace
} // namespace rubato::mesh::meshio_med_test
