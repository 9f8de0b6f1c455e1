// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/plot/vtu_file.hpp"
#include "rubato/results/vtu.hpp"

#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/faults.hpp"
#include "support/patch_mesh.hpp"
#include "support/scratch_folder.hpp"
#include <fstream>
#include <iterator>

namespace rubato::plot {
namespace {

class VtuOfACell : public testing::TestWithParam<test::BulkCase> {};

TEST_P(VtuOfACell, IsReadBackAsItWas) {
  const auto mesh = test::patch_mesh(GetParam().type, 2, [](const Eigen::Vector3d& x) { return x; });
  std::vector<double> scalar;
  std::vector<double> vector;
  for (const auto& point : mesh.points) {
    scalar.push_back(point.x() - 3 * point.y() + 0.1);
    for (int i = 0; i < mesh.dimension; ++i)
      vector.push_back(point[i] / 7);
  }
  const std::vector<results::NodalField> fields{{"scalar", 1, scalar, {}, ""},
                                                {"vector", mesh.dimension, vector, {}, ""}};
  const test::ScratchFolder folder;
  results::write_vtu(folder / "a.vtu", mesh, fields);
  const auto content = read_vtu(folder / "a.vtu");

  EXPECT_EQ(content.mesh.points, mesh.points);
  ASSERT_EQ(content.mesh.blocks.size(), 1U);
  EXPECT_EQ(content.mesh.blocks[0].type, GetParam().type);
  EXPECT_EQ(content.mesh.blocks[0].nodes, mesh.blocks.back().nodes);
  ASSERT_EQ(content.arrays.size(), 2U);
  EXPECT_EQ(content.arrays[0].name, "scalar");
  EXPECT_EQ(content.arrays[0].values, scalar);
  EXPECT_EQ(content.arrays[1].components.size(), 3U);
  for (std::size_t node = 0; node < mesh.points.size(); ++node)
    EXPECT_EQ(content.arrays[1].values[3 * node + 1], mesh.points[node].y() / 7);
}

INSTANTIATE_TEST_SUITE_P(OfEveryType, VtuOfACell, testing::ValuesIn(test::every_bulk_case()),
                         [](const auto& entry) { return test::name_of(entry.param); });

class DamagedVtu : public testing::Test {
protected:
  DamagedVtu() {
    const auto mesh = test::patch_mesh(CellType::quad4, 2, [](const Eigen::Vector3d& x) { return x; });
    results::write_vtu(folder_ / "a.vtu", mesh, {});
    std::ifstream stream(folder_ / "a.vtu", std::ios::binary);
    text_.assign(std::istreambuf_iterator<char>(stream), {});
  }
  std::string fault_of(const std::string& text) const {
    std::ofstream(folder_ / "b.vtu", std::ios::binary) << text;
    const auto fault = test::fault_of([&] { read_vtu(folder_ / "b.vtu"); });
    const auto name = (folder_ / "b.vtu").string() + ": ";
    return fault.starts_with(name) ? fault.substr(name.size()) : fault;
  }
  std::string with(const std::string& old, const std::string& by) const {
    auto text = text_;
    const auto at = text.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return text.replace(at, old.size(), by);
  }

  test::ScratchFolder folder_;
  std::string text_;
};

TEST_F(DamagedVtu, IsRefusedWithWhatIsWrong) {
  const std::string end = ", expected a file as rubato writes it";
  EXPECT_EQ(fault_of(text_), "nothing thrown");
  EXPECT_EQ(fault_of("<VTKFile/>"), "found no appended raw data" + end);
  EXPECT_NE(fault_of(with("<Cells>", "<Cells")).find("found no valid XML"), std::string::npos);
  EXPECT_EQ(fault_of(with("LittleEndian", "BigEndian")), "found numbers in another order of bytes" + end);
  EXPECT_EQ(fault_of(with("Name=\"types\"", "Name=\"kinds\"")), "found no values of an array" + end);
  EXPECT_EQ(fault_of(with("Name=\"connectivity\"", "Name=\"offsets\"")), "found no values of an array" + end);
}

TEST_F(DamagedVtu, IsRefusedWhereverItEnds) {
  const auto data = text_.find("<AppendedData");
  for (auto size = data; size < text_.size() - 40; size += 7)
    EXPECT_NE(fault_of(text_.substr(0, size)), "nothing thrown") << size;
}

TEST(Pvd, NamesFilesFromItsOwnFolder) {
  const test::ScratchFolder folder;
  const auto mesh = test::patch_mesh(CellType::quad4, 1, [](const Eigen::Vector3d& x) { return x; });
  results::PvdSeries series(folder / "fields.pvd");
  series.add(0.25, folder / "fields/000001.vtu");
  series.add(0.5, folder / "fields/000002.vtu");
  const auto entries = read_pvd(folder / "fields.pvd");
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[1].t, 0.5);
  EXPECT_EQ(entries[1].file, folder / "fields/000002.vtu");
}

} // namespace
} // namespace rubato::plot
