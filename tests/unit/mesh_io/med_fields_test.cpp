// SPDX-License-Identifier: LGPL-3.0-or-later
// Fields as other programs write them with the MED library: on parts of the nodes, with iterations.
#include "rubato/mesh/io/field_file.hpp"
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/io/med_fields.hpp"

#include <gtest/gtest.h>
#include <med.h>

#include "one_cell.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <array>
#include <cmath>

namespace rubato::mesh::med_fields_test {
namespace {

Mesh square() {
  Mesh mesh;
  mesh.dimension = 2;
  mesh.points = test::reference_corners(CellType::quad4);
  mesh.node_numbers = {1, 2, 3, 4};
  mesh.blocks.push_back({CellType::quad4, {0, 1, 2, 3}, {1}});
  return mesh;
}

class FieldsOfOthers : public testing::Test {
protected:
  test::ScratchFolder folder_;
  std::filesystem::path file_ = folder_ / "others.med";

  void SetUp() override {
    write_med(file_, square(), "body");
    const auto id = MEDfileOpen(file_.c_str(), MED_ACC_RDWR);
    ASSERT_GE(id, 0);
    constexpr const char* names = "TEMP            FLUX            ";
    ASSERT_GE(MEDfieldCr(id, "THER", MED_FLOAT64, 2, names, names, "", "body"), 0);
    const std::array<med_int, 2> some{2, 4};
    ASSERT_GE(MEDprofileWr(id, "some", 2, some.data()), 0);
    write(id, 5, 3, 0.5, {10, 11, 20, 21}, "some");
    write(id, 6, 1, 0.75, {1, 2, 3, 4, 5, 6, 7, 8}, "");
    ASSERT_GE(MEDfileClose(id), 0);
  }

  static void write(med_idt id, int number, int iteration, double time, const std::vector<double>& values,
                    const char* profile) {
    ASSERT_GE(MEDfieldValueWithProfileWr(id, "THER", number, iteration, time, MED_NODE, MED_NONE,
                                         MED_COMPACT_STMODE, profile, "", MED_FULL_INTERLACE,
                                         MED_ALL_CONSTITUENT, static_cast<med_int>(values.size() / 2),
                                         reinterpret_cast<const unsigned char*>(values.data())),
              0);
  }
};

TEST_F(FieldsOfOthers, AreReadWithIterationsAndWithoutTheNodesThatTheyLeaveOut) {
  const auto fields = med_fields(file_);
  ASSERT_EQ(fields.size(), 1U);
  EXPECT_TRUE(fields[0].at_nodes);
  EXPECT_EQ(fields[0].component_names, (std::vector<std::string>{"TEMP", "FLUX"}));
  EXPECT_EQ(fields[0].instants.size(), 2U);
  const auto part = read_med_field(file_, "THER", 5);
  ASSERT_EQ(part.size(), 8U);
  EXPECT_TRUE(std::isnan(part[0]) && std::isnan(part[5]));
  EXPECT_EQ((std::array{part[2], part[3], part[6], part[7]}), (std::array{10., 11., 20., 21.}));
  EXPECT_EQ(read_med_field(file_, "THER", 6), (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_NE(test::fault_of([&] { read_med_field(file_, "THER", 7); }).find("for instant 7"),
            std::string::npos);
}

TEST_F(FieldsOfOthers, AreTakenByComponentAndInstant) {
  const auto samples = read_nodal_field(file_, {"THER", "FLUX", 0.75});
  EXPECT_EQ(samples.instants, (std::vector<double>{0.75}));
  EXPECT_EQ(samples.values, (std::vector<std::vector<double>>{{2, 4, 6, 8}}));
  EXPECT_EQ(samples.places, square().points);
  EXPECT_EQ(read_nodal_field(file_, {"THER", "TEMP", {}}).instants, (std::vector<double>{0.5, 0.75}));
}

TEST_F(FieldsOfOthers, AreRefusedInAFileOfAnotherKind) {
  EXPECT_NE(test::fault_of([&] {
              read_nodal_field(folder_.path(), {"T", "", {}});
            }).find("is no file of fields"),
            std::string::npos);
  EXPECT_NE(test::fault_of([&] {
              read_nodal_field(folder_ / "x.med", {"T", "", {}});
            }).find("does not exist"),
            std::string::npos);
}

} // namespace
} // namespace rubato::mesh::med_fields_test
