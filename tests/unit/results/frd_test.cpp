// SPDX-License-Identifier: LGPL-3.0-or-later
// Files of CalculiX's layout as they grow. tests/shell/ccx_files_test.py compares them with CalculiX's own.
#include "rubato/core/error.hpp"
#include "rubato/results/ccx_numbers.hpp"
#include "rubato/results/ccx_points.hpp"
#include "rubato/results/frd.hpp"

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include <array>
#include <fstream>
#include <iterator>

namespace rubato::results::frd_test {
namespace {

mesh::Mesh two_triangles() {
  mesh::Mesh mesh;
  mesh.dimension = 2;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 0}};
  mesh.node_numbers = {13, 11, 12, 10, 99};
  mesh.blocks = {{CellType::seg2, {0, 1}, {5}}, {CellType::tria3, {0, 1, 2, 0, 2, 3}, {6, 7}}};
  return mesh;
}

std::string text_of(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

class FrdFiles : public testing::TestWithParam<bool> {
protected:
  FrdSettings settings(int step = 1) const { return {GetParam(), step, {"steel"}, {}}; }
  static std::array<FrdBlock, 1> heat(double scale) {
    return {FrdBlock{"NDTEMP", FrdKind::scalar, {"T"}, {scale, 2 * scale, 3 * scale, 4 * scale, 5 * scale}}};
  }

  test::ScratchFolder folder_;
  mesh::Mesh mesh_ = two_triangles();
};

TEST_P(FrdFiles, AreCutAndContinued) {
  const auto path = folder_ / "a.frd";
  FrdFile file(path, mesh_, settings());
  file.add(0.5, 1, heat(1));
  const auto before = text_of(path);
  const auto position = file.position();
  file.add(1, 2, heat(2));
  const auto after = text_of(path);
  EXPECT_GT(after.size(), before.size());
  file.cut(position);
  EXPECT_EQ(text_of(path), before);
  FrdFile again(path, mesh_, settings(), position);
  EXPECT_EQ(text_of(path), before);
  again.add(1, 2, heat(2));
  EXPECT_EQ(text_of(path), after);
  EXPECT_THROW(FrdFile(path, mesh_, settings(), {after.size() + 1, 2, 2}), InputError);
}

TEST_P(FrdFiles, AreJoinedWithNumbersThroughAllSteps) {
  const std::array paths{folder_ / "a.frd", folder_ / "b.frd"};
  FrdFile first(paths[0], mesh_, settings());
  first.add(0.5, 1, heat(1));
  first.add(1, 2, heat(2));
  FrdFile second(paths[1], mesh_, settings(2));
  second.add(1.5, 1, heat(3));
  join_frd(paths, folder_ / "all.frd");
  const auto text = text_of(folder_ / "all.frd");
  EXPECT_TRUE(text.starts_with(text_of(paths[0]).substr(0, first.position().bytes)));
  EXPECT_EQ(count(text, "    2C"), 1U);
  EXPECT_EQ(count(text, "    1PSTEP                         3           1           2"), 1U);
  EXPECT_EQ(count(text, "  100CL  103 1.500000000           4                     0    3           "), 1U);
  EXPECT_TRUE(text.ends_with(" 9999\n"));
  join_frd(std::span(paths).first(1), folder_ / "one.frd");
  EXPECT_EQ(text_of(folder_ / "one.frd"), text_of(paths[0]));
}

TEST_P(FrdFiles, RefuseFilesOfOtherPrograms) {
  std::ofstream(folder_ / "x.frd") << "    1C\n    1PSTEP 1\n nonsense\n";
  const std::array paths{folder_ / "x.frd"};
  EXPECT_THROW(join_frd(paths, folder_ / "all.frd"), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "all.frd"));
}

INSTANTIATE_TEST_SUITE_P(Numbers, FrdFiles, testing::Bool());

TEST(FrdText, HasNodesOfCellsByNumber) {
  const test::ScratchFolder folder;
  const FrdFile file(folder / "a.frd", two_triangles(), {false, 1, {}, {}});
  const auto text = text_of(folder / "a.frd");
  EXPECT_NE(text.find("    2C                             4                                     1\n"
                      " -1        10 0.00000E+00 1.00000E+00 0.00000E+00\n"
                      " -1        11 1.00000E+00 0.00000E+00 0.00000E+00\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find(" -1         6    7    0    1\n -2        13        11        12\n"),
            std::string::npos);
}

TEST(CcxNumbers, StartFromOneIfTheyAreNotUnique) {
  auto mesh = two_triangles();
  EXPECT_EQ(ccx_numbers(mesh).nodes, (std::vector<std::int32_t>{13, 11, 12, 10, 99}));
  mesh.node_numbers[0] = 10;
  EXPECT_EQ(ccx_numbers(mesh).nodes, (std::vector<std::int32_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(ccx_numbers(mesh).cells, (std::vector<std::int32_t>{5, 6, 7}));
}

TEST(FortranNumbers, BeginWithZero) {
  EXPECT_EQ(fortran_e(0, 7), "0.0000000E+00");
  EXPECT_EQ(fortran_e(1, 7), "0.1000000E+01");
  EXPECT_EQ(fortran_e(0.5, 7), "0.5000000E+00");
  EXPECT_EQ(fortran_e(-1.25e-3, 7), "-0.1250000E-02");
  EXPECT_EQ(fortran_e(99999999.9, 7), "0.1000000E+09");
}

/// Constant and linear values are kept at all points of CalculiX.
TEST(CcxPoints, HaveTheNumberOfCalculiXAndLinearValues) {
  struct Row {
    CellType type;
    bool reduced;
    int points;
  };
  for (const auto& row :
       {Row{CellType::hexa8, false, 8}, Row{CellType::hexa8, true, 1}, Row{CellType::hexa20, false, 27},
        Row{CellType::hexa20, true, 8}, Row{CellType::tetra4, false, 1}, Row{CellType::tetra10, false, 4},
        Row{CellType::penta6, false, 2}, Row{CellType::penta15, false, 9}, Row{CellType::quad4, false, 8},
        Row{CellType::quad8, true, 8}, Row{CellType::tria3, false, 2}, Row{CellType::tria6, false, 9}}) {
    const auto& points = ccx_points(row.type, row.reduced);
    EXPECT_EQ(points.layers * points.from_points.cols(), row.points);
    EXPECT_EQ(points.from_nodes.cols(), points.from_points.cols());
    EXPECT_LT((points.from_points.colwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
    EXPECT_LT((points.from_nodes.colwise().sum().array() - 1).abs().maxCoeff(), 1e-12);
  }
}

} // namespace
} // namespace rubato::results::frd_test
