// SPDX-License-Identifier: LGPL-3.0-or-later
// All instants in one file for ParaView. tests/shell/fields_test.py reads one with h5py.
#include "rubato/results/hdf5_file.hpp"
#include "rubato/results/vtkhdf.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <array>
#include <cmath>

namespace rubato::results::vtkhdf_test {
namespace {

using Values = std::vector<double>;
using Integers = std::vector<std::int64_t>;

mesh::Mesh two_triangles() {
  mesh::Mesh mesh;
  mesh.dimension = 2;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.node_numbers = {10, 11, 12, 13};
  mesh.blocks = {{CellType::seg2, {0, 1}, {5}}, {CellType::tria3, {0, 1, 2, 0, 2, 3}, {6, 7}}};
  mesh.cell_groups = {{"lower", {0}}, {"first", {1}}};
  return mesh;
}

class VtkHdf : public testing::Test {
protected:
  VtkHdf() { start_vtkhdf(file_, mesh_); }
  void append(std::int64_t number, double time, double scale) const {
    const Values u{0, 1 * scale, 2 * scale, 3 * scale, 4 * scale, 5 * scale, 6 * scale, 7 * scale};
    const Values p{scale, 0, 0, std::sqrt(2) * scale};
    const std::array fields{NodalField{"displacement", 2, u, {}, ""}, NodalField{"pressure", 1, p, {}, ""}};
    const CellField stress{
        "stress_elga", 1, {}, study::FieldPlace::gauss_points, {{CellType::tria3, 1, {scale, 2 * scale}}},
        {1, 1}};
    append_vtkhdf(file_, mesh_, {number, time}, fields, std::array{stress}, 9);
  }
  Values numbers(const std::string& name) const {
    return Hdf5File(file_, Hdf5File::Access::read).numbers("VTKHDF/" + name);
  }
  Integers integers(const std::string& name) const {
    return Hdf5File(file_, Hdf5File::Access::read).integers("VTKHDF/" + name);
  }

  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "fields.vtkhdf";
  mesh::Mesh mesh_ = two_triangles();
};

TEST_F(VtkHdf, HasTheBodiesAndTheirGroupsOnce) {
  EXPECT_EQ(instants_in_vtkhdf(file_), 0);
  append(0, 0, 1);
  append(1, 0.5, 2);
  EXPECT_EQ(integers("NumberOfPoints"), Integers{4});
  EXPECT_EQ(integers("NumberOfCells"), Integers{2});
  EXPECT_EQ(integers("NumberOfConnectivityIds"), Integers{6});
  EXPECT_EQ(numbers("Points"), (Values{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_EQ(integers("Connectivity"), (Integers{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(integers("Offsets"), (Integers{0, 3, 6}));
  EXPECT_EQ(integers("Types"), (Integers{5, 5}));
  EXPECT_EQ(integers("PointData/group_lower"), (Integers{1, 1, 0, 0}));
  EXPECT_EQ(integers("CellData/group_first"), (Integers{1, 0}));
  EXPECT_EQ(integers("PointData/node_number"), (Integers{10, 11, 12, 13}));
  EXPECT_EQ(integers("CellData/cell_number"), (Integers{6, 7}));
}

TEST_F(VtkHdf, HasEveryInstantAfterTheOther) {
  append(0, 0, 1);
  append(1, 0.5, 2);
  EXPECT_EQ(instants_in_vtkhdf(file_), 2);
  EXPECT_EQ(numbers("Steps/Values"), (Values{0, 0.5}));
  EXPECT_EQ(integers("Steps/PointDataOffsets/displacement"), (Integers{0, 4}));
  EXPECT_EQ(integers("Steps/CellDataOffsets/stress_elga"), (Integers{0, 2}));
  for (const auto* name : {"PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets",
                           "PointDataOffsets/group_lower", "CellDataOffsets/cell_number"})
    EXPECT_EQ(integers(std::string("Steps/") + name), (Integers{0, 0})) << name;
  EXPECT_EQ(integers("Steps/NumberOfParts"), (Integers{1, 1}));
  const auto u = numbers("PointData/displacement");
  EXPECT_EQ((Values{u.begin() + 12, u.end()}), (Values{0, 2, 0, 4, 6, 0, 8, 10, 0, 12, 14, 0}));
  EXPECT_EQ(numbers("CellData/stress_elga"), (Values{1, 2, 2, 4}));
  const auto p = numbers("PointData/pressure");
  EXPECT_NEAR(p[3], std::sqrt(2), 1e-9);
  EXPECT_NE(p[3], std::sqrt(2)) << "nine digits";
}

TEST_F(VtkHdf, TakesBackWhatComesAgain) {
  append(0, 0, 1);
  append(1, 0.5, 2);
  append(2, 0.7, 3);
  append(1, 0.6, 5);
  EXPECT_EQ(instants_in_vtkhdf(file_), 2);
  EXPECT_EQ(numbers("Steps/Values"), (Values{0, 0.6}));
  EXPECT_EQ(numbers("CellData/stress_elga"), (Values{1, 2, 5, 10}));
  EXPECT_EQ(numbers("PointData/displacement").size(), 24U);
  EXPECT_EQ(integers("Steps/PointDataOffsets/displacement"), (Integers{0, 4}));
}

TEST_F(VtkHdf, IsRefusedWhereNoFileCanBe) {
  EXPECT_NE(test::fault_of([&] { start_vtkhdf(folder_ / "no/a.vtkhdf", mesh_); }).find("cannot be written"),
            std::string::npos);
}

} // namespace
} // namespace rubato::results::vtkhdf_test
