// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/med.hpp"
#include "rubato/results/med_fields.hpp"

#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <array>

namespace rubato::results::med_fields_test {
namespace {

using test::fault_of;
using test::ScratchFolder;

mesh::Mesh triangle() {
  mesh::Mesh mesh;
  mesh.dimension = 2;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.node_numbers = {1, 2, 3};
  mesh.blocks = {{CellType::tria3, {0, 1, 2}, {1}}};
  return mesh;
}

constexpr std::array<double, 6> first{1, 2, 3, 4, 5, 6};
constexpr std::array<double, 6> second{-1, -2, -3, -4, -5, -6};
constexpr std::array<double, 3> pressure{1e9, 2e9, 3e9};

class MedFields : public testing::Test {
protected:
  MedFields() : file_(folder_ / "results.med") { mesh::write_med(file_, triangle(), "beams"); }
  ScratchFolder folder_;
  std::filesystem::path file_;
};

TEST_F(MedFields, AreReadBackAtEveryInstant) {
  const NodalField at_first{"displacement", 2, first, {"DX", "DY"}, "m"};
  const NodalField at_second{"displacement", 2, second, {"DX", "DY"}, "m"};
  const NodalField contact{"contact_pressure", 1, pressure, {}, "Pa"};
  append_med_fields(file_, "beams", {0, 0.0}, std::array{at_first}, "s");
  append_med_fields(file_, "beams", {3, 0.25}, std::array{at_second, contact}, "s");

  auto fields = med_fields(file_);
  std::ranges::sort(fields, {}, &MedField::name);
  ASSERT_EQ(fields.size(), 2U);
  EXPECT_EQ(fields[0].name, "contact_pressure");
  EXPECT_EQ(fields[0].component_names, std::vector<std::string>{"1"});
  EXPECT_EQ(fields[0].unit, "Pa");
  ASSERT_EQ(fields[0].instants.size(), 1U);
  EXPECT_EQ(fields[1].component_names, (std::vector<std::string>{"DX", "DY"}));
  EXPECT_EQ(fields[1].mesh_name, "beams");
  EXPECT_EQ(fields[1].time_unit, "s");
  ASSERT_EQ(fields[1].instants.size(), 2U);
  EXPECT_EQ(fields[1].instants[1].number, 3);
  EXPECT_EQ(fields[1].instants[1].time, 0.25);

  EXPECT_EQ(read_med_field(file_, "displacement", 0), std::vector<double>(first.begin(), first.end()));
  EXPECT_EQ(read_med_field(file_, "displacement", 3), std::vector<double>(second.begin(), second.end()));
  EXPECT_EQ(read_med_field(file_, "contact_pressure", 3),
            std::vector<double>(pressure.begin(), pressure.end()));
}

TEST_F(MedFields, LeaveTheMeshReadable) {
  append_med_fields(file_, "beams", {1, 0.5}, std::array{NodalField{"velocity", 2, first, {}, ""}});
  EXPECT_EQ(mesh::read_med(file_, "beams").blocks[0].nodes, (std::vector<mesh::NodeIndex>{0, 1, 2}));
  EXPECT_EQ(med_fields(file_).at(0).component_names, (std::vector<std::string>{"x", "y"}));
}

TEST_F(MedFields, AreRefusedWithoutTheirMesh) {
  const NodalField field{"velocity", 2, first, {}, ""};
  const auto append_to = [&](const std::filesystem::path& file, const std::string& mesh_name) {
    return fault_of([&] { append_med_fields(file, mesh_name, {0, 0.0}, std::array{field}); });
  };
  EXPECT_NE(append_to(file_, "beam").find("holds no mesh 'beam'"), std::string::npos);
  EXPECT_NE(append_to(folder_ / "none.med", "beams").find("does not exist"), std::string::npos);
}

TEST_F(MedFields, AreRefusedWhenNamesAreTooLong) {
  const NodalField field{"velocity", 2, first, {"a component of speed", "y"}, ""};
  EXPECT_NE(fault_of([&] {
              append_med_fields(file_, "beams", {0, 0.0}, std::array{field});
            }).find("16 letters"),
            std::string::npos);
}

TEST_F(MedFields, MustFitTheMeshAndWhatIsThere) {
  const auto append = [&](const NodalField& field) {
    append_med_fields(file_, "beams", {0, 0.0}, std::array{field});
  };
  EXPECT_THROW(append({"velocity", 3, first, {}, ""}), std::invalid_argument);
  append({"velocity", 2, first, {}, ""});
  EXPECT_THROW(append({"velocity", 1, pressure, {}, ""}), std::invalid_argument);
}

TEST_F(MedFields, AreAskedForByTheirRightNameAndInstant) {
  append_med_fields(file_, "beams", {0, 0.0}, std::array{NodalField{"velocity", 2, first, {}, ""}});
  EXPECT_NE(fault_of([&] { read_med_field(file_, "velocty", 0); }).find("did you mean 'velocity'?"),
            std::string::npos);
  EXPECT_NE(fault_of([&] { read_med_field(file_, "velocity", 5); }).find("instant 5"), std::string::npos);
}

} // namespace
} // namespace rubato::results::med_fields_test
