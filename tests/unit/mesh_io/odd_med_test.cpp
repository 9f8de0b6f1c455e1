// SPDX-License-Identifier: LGPL-3.0-or-later
// Sound MED files that are not what this project reads, made with the MED library itself.
#include "rubato/mesh/io/med.hpp"

#include <gtest/gtest.h>
#include <med.h>

#include "one_cell.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <array>

namespace rubato::mesh::odd_med_test {
namespace {

using test::fault_of;
using test::ScratchFolder;

constexpr const char* three_axes = "X               Y               Z               ";

/// A MED file being made; every step must succeed.
class Making {
public:
  explicit Making(const std::filesystem::path& path) : id_(MEDfileOpen(path.c_str(), MED_ACC_CREAT)) {
    EXPECT_GE(id_, 0);
  }
  ~Making() { EXPECT_GE(MEDfileClose(id_), 0); }
  Making(const Making&) = delete;
  Making& operator=(const Making&) = delete;

  void mesh(const char* name, int space, med_mesh_type type, med_axis_type axes) const {
    EXPECT_GE(MEDmeshCr(id_, name, space, space, type, "", "", MED_SORT_DTIT, axes, three_axes, three_axes),
              0);
  }
  void three_nodes(const char* name) const {
    const std::array<double, 9> at{0, 0, 0, 1, 0, 0, 0, 1, 0};
    EXPECT_GE(MEDmeshNodeCoordinateWr(id_, name, MED_NO_DT, MED_NO_IT, 0.0, MED_FULL_INTERLACE, 3, at.data()),
              0);
  }
  void cell(const char* name, med_geometry_type type, const std::vector<int>& nodes) const {
    EXPECT_GE(MEDmeshElementConnectivityWr(id_, name, MED_NO_DT, MED_NO_IT, 0.0, MED_CELL, type, MED_NODAL,
                                           MED_FULL_INTERLACE, 1, nodes.data()),
              0);
  }

private:
  med_idt id_;
};

std::string fault_of_reading(const std::filesystem::path& path) {
  return fault_of([&] { read_med(path); });
}

TEST(OddMedFile, WithoutAMeshIsRefused) {
  const ScratchFolder folder;
  { const Making file(folder / "odd.med"); }
  EXPECT_NE(fault_of_reading(folder / "odd.med").find("holds no mesh"), std::string::npos);
}

TEST(OddMedFile, WithSeveralMeshesWantsOneNamed) {
  const ScratchFolder folder;
  {
    const Making file(folder / "odd.med");
    for (const auto* name : {"lower", "upper"}) {
      file.mesh(name, 3, MED_UNSTRUCTURED_MESH, MED_CARTESIAN);
      file.three_nodes(name);
      file.cell(name, MED_TRIA3, {1, 2, 3});
    }
  }
  EXPECT_NE(fault_of_reading(folder / "odd.med").find("holds 2 meshes, name one of them: lower, upper"),
            std::string::npos);
  EXPECT_EQ(read_med(folder / "odd.med", "upper").cell_count(), 1);
}

TEST(OddMedFile, KeepsAFlatMeshInTheSpaceTheFileSays) {
  const ScratchFolder folder;
  {
    const Making file(folder / "odd.med");
    file.mesh("flat", 3, MED_UNSTRUCTURED_MESH, MED_CARTESIAN);
    file.three_nodes("flat");
    file.cell("flat", MED_TRIA3, {1, 2, 3});
  }
  EXPECT_EQ(read_med(folder / "odd.med").dimension, 3);
}

TEST(OddMedFile, WithAStructuredGridIsRefused) {
  const ScratchFolder folder;
  {
    const Making file(folder / "odd.med");
    file.mesh("grid", 3, MED_STRUCTURED_MESH, MED_CARTESIAN);
  }
  EXPECT_NE(fault_of_reading(folder / "odd.med").find("'grid' as a structured grid"), std::string::npos);
}

TEST(OddMedFile, InCylindricalAxesIsRefused) {
  const ScratchFolder folder;
  {
    const Making file(folder / "odd.med");
    file.mesh("round", 3, MED_UNSTRUCTURED_MESH, MED_CYLINDRICAL);
  }
  EXPECT_NE(fault_of_reading(folder / "odd.med").find("cylindrical"), std::string::npos);
}

TEST(OddMedFile, WithoutNodesOrCellsIsRefused) {
  const ScratchFolder folder;
  {
    const Making file(folder / "odd.med");
    file.mesh("bare", 3, MED_UNSTRUCTURED_MESH, MED_CARTESIAN);
  }
  EXPECT_NE(fault_of_reading(folder / "odd.med").find("without nodes and cells"), std::string::npos);
  {
    const Making file(folder / "odd.med");
    file.mesh("bare", 3, MED_UNSTRUCTURED_MESH, MED_CARTESIAN);
    file.three_nodes("bare");
  }
  EXPECT_NE(fault_of_reading(folder / "odd.med").find("without cells"), std::string::npos);
}

TEST(OddMedFile, WithCellsUnknownHereIsRefusedByTheirName) {
  const ScratchFolder folder;
  {
    const Making file(folder / "odd.med");
    file.mesh("odd", 3, MED_UNSTRUCTURED_MESH, MED_CARTESIAN);
    file.three_nodes("odd");
    file.cell("odd", MED_SEG4, {1, 2, 3, 3});
  }
  EXPECT_NE(fault_of_reading(folder / "odd.med").find("cells of type MED_SEG4"), std::string::npos);
}

TEST(OddMedFile, WithANodeThatIsNotThereIsRefused) {
  const ScratchFolder folder;
  {
    const Making file(folder / "odd.med");
    file.mesh("odd", 3, MED_UNSTRUCTURED_MESH, MED_CARTESIAN);
    file.three_nodes("odd");
    file.cell("odd", MED_TRIA3, {1, 2, 4});
  }
  EXPECT_NE(fault_of_reading(folder / "odd.med").find("TRIA3 has node 4, but the nodes go from 1 to 3"),
            std::string::npos);
}

TEST(OddMedFile, ThatIsOnlyHdf5IsRefused) {
  const ScratchFolder folder;
  const auto file = H5Fcreate((folder / "odd.med").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Fclose(file), 0);
  EXPECT_NE(fault_of_reading(folder / "odd.med").find("is an HDF5 file but not a MED file"),
            std::string::npos);
}

void replace_major_version(const std::filesystem::path& path, int version) {
  const auto file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  const auto group = H5Gopen2(file, "INFOS_GENERALES", H5P_DEFAULT);
  const auto one_number = H5Screate(H5S_SCALAR);
  ASSERT_GE(H5Adelete(group, "MAJ"), 0);
  const auto major = H5Acreate2(group, "MAJ", H5T_NATIVE_INT, one_number, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Awrite(major, H5T_NATIVE_INT, &version), 0);
  H5Aclose(major);
  H5Sclose(one_number);
  H5Gclose(group);
  ASSERT_GE(H5Fclose(file), 0);
}

TEST(OddMedFile, OfAnotherVersionIsRefused) {
  const ScratchFolder folder;
  for (const auto& [version, fault] :
       {std::pair(9, "9.1.0, newer than 4.1"),
        std::pair(2, "older than 3.0, the oldest this program reads; MED's tools")}) {
    write_med(folder / "odd.med", test::one_cell(CellType::quad4, 2));
    replace_major_version(folder / "odd.med", version);
    EXPECT_NE(fault_of_reading(folder / "odd.med").find(fault), std::string::npos)
        << fault_of_reading(folder / "odd.med");
  }
}

} // namespace
} // namespace rubato::mesh::odd_med_test
