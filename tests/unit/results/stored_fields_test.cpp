// SPDX-License-Identifier: LGPL-3.0-or-later
// The same fields by .vtu files and by fields.med.
#include "rubato/mesh/io/med.hpp"
#include "rubato/results/med_fields.hpp"
#include "rubato/results/stored_fields.hpp"
#include "rubato/results/vtu.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include "unit/mesh_io/one_cell.hpp"
#include <filesystem>

namespace rubato::results::stored_fields_test {
namespace {

class FieldsOfARun : public testing::Test {
protected:
  FieldsOfARun() { std::filesystem::create_directories(folder_ / "fields"); }

  /// A plane displacement and a pressure, other at each instant.
  std::vector<double> shift(int instant) const { return values(2, 0.5 + instant); }
  std::vector<double> pressure(int instant) const { return values(1, -3.0 * instant); }

  void write_vtu(int instants) {
    PvdSeries series(folder_ / "fields.pvd");
    for (int i = 0; i < instants; ++i) {
      const auto file = folder_ / fmt::format("fields/{:06}.vtu", i);
      const auto u = shift(i);
      const auto p = pressure(i);
      results::write_vtu(file, mesh_, fields(u, p));
      series.add(0.25 * i, file);
    }
  }

  void write_med(int instants) const {
    mesh::write_med(folder_ / "fields.med", mesh_, "mesh");
    for (int i = 0; i < instants; ++i) {
      const auto u = shift(i);
      const auto p = pressure(i);
      append_med_fields(folder_ / "fields.med", "mesh", {i, 0.25 * i}, fields(u, p));
    }
  }

  void expect_all(const StoredFields& stored, int instants) const {
    ASSERT_EQ(stored.instants.size(), static_cast<std::size_t>(instants));
    EXPECT_EQ(stored.mesh.dimension, 2);
    EXPECT_EQ(stored.mesh.points, mesh_.points);
    EXPECT_EQ(stored.mesh.node_numbers, mesh_.node_numbers);
    for (int i = 0; i < instants; ++i) {
      EXPECT_EQ(stored.instants[static_cast<std::size_t>(i)], 0.25 * i);
      const auto values = stored.values_at(static_cast<std::size_t>(i));
      ASSERT_EQ(values.size(), stored.fields.size());
      for (std::size_t f = 0; f < values.size(); ++f) {
        const bool is_shift = stored.fields[f].name == "displacement";
        EXPECT_EQ(stored.fields[f].components,
                  is_shift ? std::vector<std::string>({"x", "y"}) : std::vector<std::string>{""});
        EXPECT_EQ(values[f], is_shift ? shift(i) : pressure(i));
      }
    }
  }

  test::ScratchFolder folder_;
  mesh::Mesh mesh_ = test::one_cell(CellType::quad9, 2);

private:
  std::vector<double> values(std::size_t components, double first) const {
    std::vector<double> all(components * mesh_.points.size());
    std::iota(all.begin(), all.end(), first);
    return all;
  }
  static std::vector<NodalField> fields(const std::vector<double>& u, const std::vector<double>& p) {
    return {{"displacement", 2, u, {"x", "y"}, ""}, {"contact_pressure", 1, p, {}, ""}};
  }
};

TEST_F(FieldsOfARun, AreTheSameFromBothKindsOfFiles) {
  write_vtu(3);
  write_med(3);
  expect_all(stored_vtu_fields(folder_.path()).value(), 3);
  expect_all(stored_med_fields(folder_.path()).value(), 3);
}

TEST_F(FieldsOfARun, ComeFromTheFileWithMoreInstants) {
  write_vtu(1);
  write_med(3);
  expect_all(stored_fields(folder_.path()).value(), 3);
  std::filesystem::remove(folder_ / "fields.pvd");
  expect_all(stored_fields(folder_.path()).value(), 3);
  write_vtu(4);
  expect_all(stored_fields(folder_.path()).value(), 4);
}

TEST_F(FieldsOfARun, MayBeNone) {
  EXPECT_FALSE(stored_fields(folder_.path()));
  mesh::write_med(folder_ / "fields.med", mesh_, "mesh");
  EXPECT_FALSE(stored_fields(folder_.path()));
}

TEST_F(FieldsOfARun, OfWhichAFileIsGoneAreRefused) {
  write_vtu(2);
  std::filesystem::remove(folder_ / "fields/000001.vtu");
  const auto stored = stored_fields(folder_.path()).value();
  EXPECT_NO_THROW(stored.values_at(0));
  EXPECT_NE(test::fault_of([&] { stored.values_at(1); }).find("000001.vtu"), std::string::npos);
}

} // namespace
} // namespace rubato::results::stored_fields_test
