// SPDX-License-Identifier: LGPL-3.0-or-later
// The five real meshes of SDNL140, where they are there.
#include "rubato/mesh/io/med.hpp"

#include <gtest/gtest.h>

#include "one_cell.hpp"
#include "support/shared_files.hpp"

namespace rubato::mesh::shared_med_test {
namespace {

struct Expected {
  char letter;
  int dimension;
  NodeIndex nodes;
  CellType body;
  CellIndex bodies;
  CellType face;
  CellIndex faces;
  std::size_t contact_faces;
  std::size_t clamped_faces;
  std::string clamped;
  std::string tip;
  Eigen::Vector3d tip_at;
  std::vector<std::string> clamped_interface;
};

void PrintTo(const Expected& expected, std::ostream* to) {
  *to << "sdnl140" << expected.letter;
}

std::vector<Expected> all_expected() {
  using T = CellType;
  const Eigen::Vector3d middle(1.0, 0.1, 0.05);
  const std::vector<std::string> three{"N529", "N530", "N531"};
  return {{'a', 3, 1051, T::tetra4, 3535, T::tria3, 1584, 190, 16, "Haut_Encastre", "N90", middle, three},
          {'b', 3, 6427, T::tetra10, 3535, T::tria6, 1584, 190, 16, "Haut_Encastre", "N90", middle, three},
          {'c',
           3,
           252,
           T::hexa8,
           80,
           T::quad4,
           248,
           20,
           2,
           "Bas_Encastre",
           "N7",
           {1.0, 0.1, 0.0},
           {"N11", "N12"}},
          {'d',
           3,
           786,
           T::hexa20,
           80,
           T::quad8,
           248,
           20,
           2,
           "Bas_Encastre",
           "N50",
           {1.0, 0.1, 0.1},
           {"N91", "N434", "N94"}},
          {'f', 2, 126, T::quad4, 80, T::seg2, 88, 20, 4, "Encastrement", "Force", {1.0, 0.1, 0.0}, {"N6"}}};
}

std::filesystem::path file_of(const Expected& expected) {
  return test::shared_file(std::string("sdnl140/sdnl140") + expected.letter + ".med");
}

const CellBlock& block_of(const Mesh& mesh, CellType type) {
  return *std::ranges::find(mesh.blocks, type, &CellBlock::type);
}

Eigen::Vector3d place_of_node(const Mesh& mesh, const std::string& name) {
  const auto nodes = nodes_named(mesh, name);
  return nodes.size() == 1 ? mesh.points[static_cast<std::size_t>(nodes.front())]
                           : Eigen::Vector3d::Constant(std::nan(""));
}

class SharedMesh : public testing::TestWithParam<Expected> {
protected:
  void SetUp() override {
    if (!std::filesystem::exists(file_of(GetParam())))
      GTEST_SKIP() << "the shared SDNL140 files are not there";
    mesh_ = read_med(file_of(GetParam()));
  }
  Mesh mesh_;
};

TEST_P(SharedMesh, HasTheCountsOfItsDescription) {
  const auto& expected = GetParam();
  EXPECT_EQ(mesh_.dimension, expected.dimension);
  EXPECT_EQ(mesh_.node_count(), expected.nodes);
  EXPECT_EQ(block_of(mesh_, expected.body).cell_count(), expected.bodies);
  EXPECT_EQ(block_of(mesh_, expected.face).cell_count(), expected.faces);
  EXPECT_EQ(mesh_.cell_group("Bas_Contact")->items.size(), expected.contact_faces);
  EXPECT_EQ(mesh_.cell_group("Haut_Contact")->items.size(), expected.contact_faces);
  EXPECT_EQ(mesh_.cell_group(expected.clamped)->items.size(), expected.clamped_faces);
}

TEST_P(SharedMesh, HasItsNamedNodesInPlace) {
  const auto& expected = GetParam();
  EXPECT_LT((place_of_node(mesh_, expected.tip) - expected.tip_at).norm(), 1e-12);
  for (const auto& name : expected.clamped_interface) {
    const auto at = place_of_node(mesh_, name);
    EXPECT_LT(std::hypot(at.x(), at.y()), 1e-12) << name;
  }
}

TEST_P(SharedMesh, HasContactFacesAtTheInterface) {
  for (const auto* name : {"Bas_Contact", "Haut_Contact"})
    for (const auto node : nodes_named(mesh_, name))
      EXPECT_NEAR(mesh_.points[static_cast<std::size_t>(node)].y(), 0.0, 1e-12);
}

TEST_P(SharedMesh, FillsTheTwoBeamsWithCellsOfPositiveVolume) {
  const auto& block = block_of(mesh_, GetParam().body);
  double volume = 0.0;
  for (CellIndex cell = 0; cell < block.cell_count(); ++cell) {
    const auto own = test::measure(block.type, test::points_of(mesh_, block, cell));
    EXPECT_GT(own, 0.0) << "cell " << cell;
    volume += own;
  }
  EXPECT_NEAR(volume, GetParam().dimension == 3 ? 0.02 : 0.2, 1e-12);
}

TEST_P(SharedMesh, HasEdgeNodesInTheMiddleOfTheirCorners) {
  for (const auto& block : mesh_.blocks)
    for (CellIndex cell = 0; cell < block.cell_count(); ++cell) {
      const auto points = test::points_of(mesh_, block, cell);
      const auto corners = static_cast<std::size_t>(cell::topology(block.type).corner_count);
      const test::Points expected = test::filled(block.type, {points.begin(), points.begin() + corners});
      for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_LT((points[i] - expected[i]).norm(), 1e-9)
            << cell::topology(block.type).name << " " << cell << " " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Sdnl140, SharedMesh, testing::ValuesIn(all_expected()),
                         [](const auto& one) { return std::string(1, one.param.letter); });

} // namespace
} // namespace rubato::mesh::shared_med_test
