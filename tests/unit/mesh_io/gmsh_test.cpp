// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/gmsh.hpp"
#include "rubato/mesh/io/mesh_file.hpp"

#include <gtest/gtest.h>

#include "one_cell.hpp"
#include "support/faults.hpp"
#include "support/scratch_folder.hpp"
#include <algorithm>
#include <fstream>

namespace rubato::mesh::gmsh_test {
namespace {

using test::fault_of;
using test::ScratchFolder;

class GmshFile : public testing::Test {
protected:
  void SetUp() override {
    if (!has_gmsh())
      GTEST_SKIP() << "built without Gmsh, or its library is not here";
  }
  Mesh mesh_of(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return read_mesh(folder_ / name);
  }
  ScratchFolder folder_;
};

const std::string unit_square = R"(
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0}; Point(5) = {5, 5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1:4} = 3; Transfinite Surface{1};
)";

const CellBlock* block_of(const Mesh& mesh, CellType type) {
  const auto found = std::ranges::find(mesh.blocks, type, &CellBlock::type);
  return found == mesh.blocks.end() ? nullptr : &*found;
}

/// Every node of every cell where its corners want it, and the solids right side out and of that volume in
/// all.
void expect_regular(const Mesh& mesh, CellType body, double volume) {
  ASSERT_NE(block_of(mesh, body), nullptr) << cell::topology(body).name;
  double sum = 0.0;
  for (const auto& block : mesh.blocks)
    for (CellIndex cell = 0; cell < block.cell_count(); ++cell) {
      const auto points = test::points_of(mesh, block, cell);
      const auto corners = cell::topology(block.type).corner_count;
      const auto expected = test::filled(block.type, {points.begin(), points.begin() + corners});
      for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_LT((points[i] - expected[i]).norm(), 1e-9) << cell::topology(block.type).name << " node " << i;
      if (cell::topology(block.type).dimension == 3) {
        EXPECT_GT(test::measure(block.type, points), 0.0);
      }
      if (block.type == body)
        sum += test::measure(block.type, points);
    }
  EXPECT_NEAR(sum, volume, 1e-9);
}

TEST_F(GmshFile, OfAGeometryIsMeshedWithItsGroups) {
  const auto mesh = mesh_of("square.geo", unit_square + R"(Recombine Surface{1};
    Physical Point("tip") = {3}; Physical Curve("bottom") = {1}; Physical Surface(12) = {1};
)");
  EXPECT_EQ(mesh.dimension, 2);
  EXPECT_EQ(mesh.node_count(), 9);
  ASSERT_NE(mesh.node_group("tip"), nullptr);
  ASSERT_EQ(mesh.cell_groups.size(), 2U);
  ASSERT_EQ(nodes_named(mesh, "tip").size(), 1U);
  EXPECT_EQ(mesh.points[static_cast<std::size_t>(nodes_named(mesh, "tip")[0])], Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(mesh.cell_group("bottom")->items.size(), 2U);
  EXPECT_EQ(mesh.cell_group("surface_12")->items.size(), 4U);
  EXPECT_EQ(block_of(mesh, CellType::seg2)->cell_count(), 2);
  expect_regular(mesh, CellType::quad4, 1.0);
}

TEST_F(GmshFile, WithoutPhysicalGroupsKeepsEveryCell) {
  const auto mesh = mesh_of("square.geo", unit_square);
  EXPECT_EQ(block_of(mesh, CellType::seg2)->cell_count(), 8);
  EXPECT_EQ(block_of(mesh, CellType::tria3)->cell_count(), 8);
  EXPECT_EQ(mesh.node_count(), 9);
}

TEST_F(GmshFile, HasTheNodesOfEveryQuadraticCellInOurOrder) {
  struct Case {
    std::string extrusion;
    std::string options;
    CellType body;
  };
  const std::string solid = "out[] = Extrude{0, 0, 1}{Surface{1}; Layers{2};";
  const std::string hexa = "Recombine Surface{1};" + solid + " Recombine;};";
  const std::string penta = solid + " Recombine;};";
  const std::string tetra = solid + "};";
  const std::string full = "Mesh.ElementOrder = 2;";
  const std::string serendipity = full + "Mesh.SecondOrderIncomplete = 1;";
  const std::vector<Case> cases{{hexa, "", CellType::hexa8},
                                {hexa, serendipity, CellType::hexa20},
                                {hexa, full, CellType::hexa27},
                                {penta, "", CellType::penta6},
                                {penta, serendipity, CellType::penta15},
                                {penta, full, CellType::penta18},
                                {tetra, "", CellType::tetra4},
                                {tetra, full, CellType::tetra10}};
  for (const auto& one : cases) {
    SCOPED_TRACE(cell::topology(one.body).name);
    const auto mesh = mesh_of("box.geo", unit_square + one.extrusion + one.options + "\n");
    EXPECT_EQ(mesh.dimension, 3);
    expect_regular(mesh, one.body, 1.0);
  }
}

TEST_F(GmshFile, IsRefusedWithGmshsOwnWords) {
  EXPECT_NE(fault_of([&] { read_geo(folder_ / "none.geo"); }).find("does not exist"), std::string::npos);
  const auto fault = fault_of([&] { mesh_of("bad.geo", "Point(1) = {0, 0\n"); });
  EXPECT_NE(fault.find("cannot be read by Gmsh: "), std::string::npos) << fault;
  EXPECT_NE(fault_of([&] { mesh_of("empty.geo", ""); }).find("holds no cells"), std::string::npos);
  EXPECT_NE(
      fault_of([&] { mesh_of("cubic.geo", unit_square + "Mesh.ElementOrder = 3;\n"); }).find("does not know"),
      std::string::npos);
}

TEST_F(GmshFile, WhoseLastLineGmshWouldDropIsRefused) {
  EXPECT_NE(fault_of([&] { mesh_of("open.geo", unit_square + "Recombine Surface{1};"); }).find("no line end"),
            std::string::npos);
}

} // namespace
} // namespace rubato::mesh::gmsh_test
