// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/quadrature.hpp"
#include "rubato/domain/assembly.hpp"
#include "rubato/domain/recovery.hpp"
#include "rubato/element/element.hpp"

#include <gtest/gtest.h>

#include "support/bulk_cells.hpp"
#include "support/faults.hpp"
#include "support/patch_mesh.hpp"
#include <array>
#include <limits>

namespace rubato::domain::assembly_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using study::Physics;

const material::LinearElastic soft{1., 0.3, 2.};
const material::LinearElastic hard{5., 0.2, 3.};

mesh::Mesh square_and_a_stray_node() {
  auto mesh = test::patch_mesh(CellType::quad4, 2, test::shaken(2, 2, 0.2));
  mesh.points.insert(mesh.points.begin() + 4, Vector3d(9, 9, 0));
  for (auto& node : mesh.blocks.front().nodes)
    node += node >= 4 ? 1 : 0;
  mesh.node_numbers.push_back(10);
  return mesh;
}

/// What assembly must give, one entry at a time.
MatrixXd dense_stiffness(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs) {
  MatrixXd k = MatrixXd::Zero(dofs.dof_count, dofs.dof_count);
  for (std::size_t c = 0; c < bulk.cells.size(); ++c) {
    const auto nodes = mesh.nodes_of(bulk.cells[c]);
    const int size = static_cast<int>(nodes.size()) * dofs.components;
    MatrixXd element(size, size);
    stiffness(mesh.type_of(bulk.cells[c]), CellPoints(mesh, nodes), bulk.law(c), bulk.section, element);
    const auto global = [&](int local) {
      return dofs.dof(nodes[static_cast<std::size_t>(local / dofs.components)], local % dofs.components);
    };
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j)
        k(global(i), global(j)) += element(i, j);
  }
  return k;
}

class TwoMaterials : public testing::Test {
protected:
  mesh::Mesh mesh_ = square_and_a_stray_node();
  Bulk bulk_{{Physics::plane_stress, 0.5}, {0, 1, 2, 3}, {soft, hard}, {0, 1, 0, 1}};
  DofMap dofs_ = number_dofs(mesh_, bulk_.cells, 2);
  BlockPattern pattern_{mesh_, bulk_.cells, dofs_};
};

TEST_F(TwoMaterials, AreToldByCellWhenTheirMatricesAreNotFinite) {
  auto& law = std::get<material::LinearElastic>(bulk_.laws[1]);
  law.young = 1e308;
  law.density = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(test::fault_of([&] {
                assemble_stiffness(mesh_, bulk_, pattern_, std::array{1., 1e10});
              }).starts_with("cell 2 (QUAD4) at ("));
  EXPECT_NE(test::fault_of([&] { assemble_mass(mesh_, bulk_, pattern_); }).find("its mass is not finite"),
            std::string::npos);
  EXPECT_NE(test::fault_of([&] { lumped_mass(mesh_, bulk_, dofs_); }).find("its mass is not finite"),
            std::string::npos);
}

TEST_F(TwoMaterials, LeaveNodesWithoutCellsUnnumbered) {
  EXPECT_EQ(dofs_.dof_count, 18);
  EXPECT_FALSE(dofs_.has(4));
  EXPECT_EQ(dofs_.dof(3, 1), 7);
  EXPECT_EQ(dofs_.dof(5, 0), 8);
  ASSERT_EQ(dofs_.nodes.size(), 9U);
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_EQ(dofs_.dof(dofs_.nodes[i], 0), static_cast<int>(2 * i));
}

TEST_F(TwoMaterials, AssembleToTheSumOfTheirCells) {
  const auto k = assemble_stiffness(mesh_, bulk_, pattern_);
  const MatrixXd expected = dense_stiffness(mesh_, bulk_, dofs_);
  EXPECT_LT((MatrixXd(k) - expected).norm(), 1e-15 * expected.norm());
  EXPECT_TRUE(k.isCompressed());
}

TEST_F(TwoMaterials, HaveBlocksOfTheirNodesInTheStiffnessAndTheirDiagonalsInTheMass) {
  const auto k = assemble_stiffness(mesh_, bulk_, pattern_);
  const auto m = assemble_mass(mesh_, bulk_, pattern_);
  EXPECT_EQ(2 * m.nonZeros(), k.nonZeros());
  for (int column = 0; column < m.outerSize(); ++column)
    for (domain::SparseMatrix::InnerIterator entry(m, column); entry; ++entry) {
      EXPECT_EQ(entry.row() % 2, column % 2);
      EXPECT_NE(k.coeff(entry.row(), column), 0);
      EXPECT_NE(entry.value(), 0);
    }
  EXPECT_EQ(k.nonZeros(), 4 * (4 * 4 + 4 * 6 + 9)); // corners see 4 nodes, mid-sides 6, the middle 9
}

TEST_F(TwoMaterials, AreScaledEachByItsOwnFactor) {
  const std::vector<double> factors{0.25, 4.};
  auto scaled = bulk_;
  for (std::size_t law = 0; law < 2; ++law) {
    auto& elastic = std::get<material::LinearElastic>(scaled.laws[law]);
    elastic.young *= factors[law];
    elastic.density *= factors[law];
  }
  const MatrixXd k = assemble_stiffness(mesh_, bulk_, pattern_, factors);
  EXPECT_LT((k - MatrixXd(assemble_stiffness(mesh_, scaled, pattern_))).norm(), 1e-14 * k.norm());
  const MatrixXd m = assemble_mass(mesh_, bulk_, pattern_, factors);
  EXPECT_LT((m - MatrixXd(assemble_mass(mesh_, scaled, pattern_))).norm(), 1e-14 * m.norm());
}

TEST_F(TwoMaterials, LumpToTheRowSumsOfALinearMass) {
  const VectorXd rows = assemble_mass(mesh_, bulk_, pattern_) * VectorXd::Ones(dofs_.dof_count);
  EXPECT_LT((lumped_mass(mesh_, bulk_, dofs_) - rows).norm(), 1e-14 * rows.norm());
}

/// Some cells with the same edges as the one before, some with another law or other edges.
TEST(CongruentCells, AssembleToTheSumOfTheirCells) {
  constexpr int n = 3;
  auto mesh = test::patch_mesh(CellType::hexa8, n, [](const Vector3d& x) { return Vector3d(3 * x); });
  mesh.points[21] += Vector3d(0.1, -0.05, 0.08);
  Bulk bulk{{Physics::solid, 1.}, {}, {soft, hard}, {}};
  for (mesh::CellIndex cell = 0; cell < n * n * n; ++cell) {
    bulk.cells.push_back(cell);
    bulk.law_of_cell.push_back(cell % 5 == 4 ? 1 : 0);
  }
  const auto dofs = number_dofs(mesh, bulk.cells, 3);
  const BlockPattern pattern(mesh, bulk.cells, dofs);
  const MatrixXd expected = dense_stiffness(mesh, bulk, dofs);
  EXPECT_LT((MatrixXd(assemble_stiffness(mesh, bulk, pattern)) - expected).norm(), 1e-15 * expected.norm());
}

/// HEXA8 of isotropic laws are computed two by two, others each by itself.
class DistinctCells : public testing::Test {
protected:
  DistinctCells() {
    for (mesh::CellIndex cell = 0; cell < 27; ++cell) {
      bulk_.cells.push_back(cell);
      bulk_.law_of_cell.push_back(cell % 5 == 4 ? 1 : cell % 7 == 3 ? 2 : 0);
    }
    dofs_ = number_dofs(mesh_, bulk_.cells, 3);
  }

  static material::Orthotropic wood() {
    material::Orthotropic law;
    law.stiffness = Vector3d(1, 2, 3).replicate(2, 1).asDiagonal();
    return law;
  }

  mesh::Mesh mesh_ = test::patch_mesh(CellType::hexa8, 3, test::shaken(3, 3, 0.2));
  Bulk bulk_{{Physics::solid, 1.}, {}, {soft, hard, wood()}, {}};
  DofMap dofs_;
};

TEST_F(DistinctCells, AssembleToTheSumOfTheirCells) {
  const BlockPattern pattern(mesh_, bulk_.cells, dofs_);
  const MatrixXd expected = dense_stiffness(mesh_, bulk_, dofs_);
  EXPECT_LT((MatrixXd(assemble_stiffness(mesh_, bulk_, pattern)) - expected).norm(), 1e-15 * expected.norm());
}

TEST_F(DistinctCells, AreScaledEachByItsOwnFactor) {
  const BlockPattern pattern(mesh_, bulk_.cells, dofs_);
  const MatrixXd k = assemble_stiffness(mesh_, bulk_, pattern, std::array{0.25, 4., 1.});
  std::get<material::LinearElastic>(bulk_.laws[0]).young *= 0.25;
  std::get<material::LinearElastic>(bulk_.laws[1]).young *= 4;
  EXPECT_LT((k - MatrixXd(assemble_stiffness(mesh_, bulk_, pattern))).norm(), 1e-15 * k.norm());
}

TEST_F(DistinctCells, AreToldByTheirNumberWhenTheirStiffnessIsNotFinite) {
  const BlockPattern pattern(mesh_, bulk_.cells, dofs_);
  bulk_.laws.push_back(material::LinearElastic{std::numeric_limits<double>::infinity(), 0.2, 3.});
  for (const std::size_t wrong : {0, 1, 2, 26}) {
    auto bulk = bulk_;
    bulk.law_of_cell[wrong] = 3;
    const auto fault = test::fault_of([&] { assemble_stiffness(mesh_, bulk, pattern); });
    EXPECT_TRUE(fault.starts_with("cell " + std::to_string(wrong + 1) + " (HEXA8)")) << fault;
  }
}

TEST(CellFaults, NameEveryCellThatCannotBeComputedWith) {
  auto mesh = test::patch_mesh(CellType::quad4, 2, test::shaken(2, 2, 0.1));
  auto& block = mesh.blocks.front();
  block.numbers = {11, 12, 13, 14};
  std::swap(block.nodes[5], block.nodes[7]); // the second cell now turns clockwise
  const std::vector<mesh::CellIndex> cells{0, 1, 2, 3};
  const auto faults = cell_faults(mesh, cells, Physics::plane_stress);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_TRUE(faults[0].text.starts_with("cell 12 (QUAD4) at (0.76")) << faults[0].text;
  EXPECT_NE(faults[0].text.find(" is inverted"), std::string::npos) << faults[0].text;
  EXPECT_EQ(cell_faults(mesh, cells, Physics::solid).size(), 4U);
  for (auto& point : mesh.points)
    point[0] -= 0.4;
  EXPECT_EQ(cell_faults(mesh, cells, Physics::axisymmetric).size(), 3U);
  mesh.points[0][1] = std::nan("");
  EXPECT_EQ(cell_faults(mesh, cells, Physics::plane_stress).size(), 2U);
}

TEST(Extrapolation, TakesLinearFieldsToTheNodesExactly) {
  for (const auto& topology : cell::all_topologies()) {
    if (!cell::has_reference_cell(topology.type) || topology.dimension == 1)
      continue;
    const auto& cell = cell::reference_cell(topology.type);
    const auto rule = cell::stiffness_rule(topology.type);
    const bool one_point = rule.size() == 1;
    const auto field = [&](const Vector3d& xi) { return 2. + (one_point ? 0. : xi.dot(Vector3d(3, -1, 4))); };
    VectorXd at_points(static_cast<Eigen::Index>(rule.size()));
    for (std::size_t q = 0; q < rule.size(); ++q)
      at_points[static_cast<Eigen::Index>(q)] = field(rule[q].xi);
    const VectorXd at_nodes = extrapolation(topology.type) * at_points;
    for (std::size_t i = 0; i < cell.nodes.size(); ++i)
      EXPECT_NEAR(at_nodes[static_cast<Eigen::Index>(i)], field(cell.nodes[i]), 1e-13) << topology.name;
  }
}

TEST(NodalStress, AveragesOverTheCellsOfANode) {
  // Two unit squares side by side, pulled by 1 % and by 3 %: at the nodes between them the mean.
  const auto mesh = [] {
    test::PatchBuilder builder(CellType::quad4);
    for (const double x : {0., 1., 2.})
      for (const double y : {0., 1.})
        builder.add_node({x, y, 0});
    builder.add_cell({0, 2, 3, 1});
    builder.add_cell({2, 4, 5, 3});
    return std::move(builder).mesh();
  }();
  const auto bulk =
      test::whole_bulk(mesh, {Physics::plane_stress, 1.}, material::LinearElastic{100., 0., 0.});
  const auto dofs = number_dofs(mesh, bulk.cells, 2);
  VectorXd u = VectorXd::Zero(dofs.dof_count);
  for (const int node : {2, 3})
    u[dofs.dof(node, 0)] = 0.01;
  for (const int node : {4, 5})
    u[dofs.dof(node, 0)] = 0.04;
  const auto nodal = nodal_stress(mesh, bulk, dofs, u);
  const std::vector<double> expected{1, 1, 2, 2, 3, 3};
  for (int node = 0; node < 6; ++node) {
    EXPECT_NEAR(nodal.stress(0, node), expected[static_cast<std::size_t>(node)], 1e-13);
    EXPECT_NEAR(nodal.von_mises[node], expected[static_cast<std::size_t>(node)], 1e-13);
  }
}

} // namespace
} // namespace rubato::domain::assembly_test
