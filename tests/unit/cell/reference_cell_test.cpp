// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_cell.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::cell::reference_cell_test {
namespace {

using Eigen::Vector3d;

std::vector<CellType> every_type() {
  std::vector<CellType> types;
  for (const auto& cell : cell::all_topologies())
    if (has_reference_cell(cell.type))
      types.push_back(cell.type);
  return types;
}

std::vector<double> values(const ReferenceCell& cell, const Vector3d& xi) {
  std::vector<double> n(static_cast<std::size_t>(cell.node_count));
  cell.values(xi, n);
  return n;
}

std::vector<double> gradients(const ReferenceCell& cell, const Vector3d& xi) {
  std::vector<double> dn(static_cast<std::size_t>(cell.node_count * cell.dimension));
  cell.gradients(xi, dn);
  return dn;
}

/// Of a pyramid only below the apex, where its functions have a pole.
std::vector<Vector3d> some_points(const ReferenceCell& cell) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
  std::vector<Vector3d> points(10, Vector3d::Zero());
  for (auto& point : points)
    for (int a = 0; a < cell.dimension; ++a)
      point[a] = coordinate(engine);
  if (cell::topology(cell.type).corner_count == 5)
    for (auto& point : points)
      point[2] = 0.25 * (point[2] + 1.2);
  return points;
}

using Exponents = std::array<int, 3>;

double monomial(const Exponents& powers, const Vector3d& x) {
  return std::pow(x[0], powers[0]) * std::pow(x[1], powers[1]) * std::pow(x[2], powers[2]);
}

bool is_full_product(CellType type) {
  return type == CellType::quad4 || type == CellType::quad9 || type == CellType::hexa8 ||
         type == CellType::hexa27;
}

/// The monomials a cell must reproduce: complete polynomials of its order, and every product for the full
/// ones.
std::vector<Exponents> monomials_of(const ReferenceCell& cell) {
  const int order = cell::topology(cell.type).order;
  const auto most = [&](int axis) { return cell.dimension > axis ? order : 0; };
  std::vector<Exponents> all;
  for (int i = 0; i <= most(0); ++i)
    for (int j = 0; j <= most(1); ++j)
      for (int k = 0; k <= most(2); ++k)
        if (is_full_product(cell.type) || i + j + k <= order)
          all.push_back({i, j, k});
  return all;
}

class EveryReferenceCell : public testing::TestWithParam<CellType> {
protected:
  const ReferenceCell& cell_ = reference_cell(GetParam());
};

TEST_P(EveryReferenceCell, AgreesWithTheTopologyOfItsType) {
  const auto& topology = cell::topology(GetParam());
  EXPECT_EQ(cell_.type, topology.type);
  EXPECT_EQ(cell_.dimension, topology.dimension);
  EXPECT_EQ(cell_.node_count, topology.node_count);
  EXPECT_EQ(cell_.nodes.size(), static_cast<std::size_t>(topology.node_count));
  EXPECT_EQ(cell_.hessians == nullptr, cell_.dimension == 3);
}

TEST_P(EveryReferenceCell, HasMidEdgeNodesInTheMiddleOfTheirEdges) {
  const auto& topology = cell::topology(GetParam());
  if (topology.order == 1)
    return;
  auto node = static_cast<std::size_t>(topology.corner_count);
  for (const auto [a, b] : topology.edges)
    EXPECT_LT((cell_.nodes[node++] - 0.5 * (cell_.nodes[a] + cell_.nodes[b])).norm(), 1e-15);
}

TEST_P(EveryReferenceCell, HasSideNodesWhereTheSideTypePutsThem) {
  for (const auto& side : cell::topology(GetParam()).sides) {
    const auto& face = reference_cell(side.type);
    const auto corners = static_cast<std::size_t>(cell::topology(side.type).corner_count);
    const auto& linear = reference_cell(corners == 2   ? CellType::seg2
                                        : corners == 3 ? CellType::tria3
                                                       : CellType::quad4);
    for (std::size_t i = 0; i < face.nodes.size(); ++i) {
      Vector3d expected = Vector3d::Zero();
      const auto n = values(linear, face.nodes[i]);
      for (std::size_t c = 0; c < corners; ++c)
        expected += n[c] * cell_.nodes[side.nodes[c]];
      EXPECT_LT((cell_.nodes[side.nodes[i]] - expected).norm(), 1e-15);
    }
  }
}

TEST_P(EveryReferenceCell, IsOneAtItsOwnNodeAndZeroAtTheOthers) {
  for (std::size_t i = 0; i < cell_.nodes.size(); ++i) {
    const auto n = values(cell_, cell_.nodes[i]);
    for (std::size_t j = 0; j < n.size(); ++j)
      EXPECT_NEAR(n[j], i == j ? 1. : 0., 1e-15) << "function " << j << " at node " << i;
  }
}

TEST_P(EveryReferenceCell, ReproducesItsPolynomials) {
  for (const auto& powers : monomials_of(cell_))
    for (const auto& xi : some_points(cell_)) {
      const auto n = values(cell_, xi);
      double interpolated = 0;
      for (std::size_t i = 0; i < n.size(); ++i)
        interpolated += n[i] * monomial(powers, cell_.nodes[i]);
      EXPECT_NEAR(interpolated, monomial(powers, xi), 2e-13)
          << "x^" << powers[0] << " y^" << powers[1] << " z^" << powers[2];
    }
}

TEST_P(EveryReferenceCell, HasGradientsThatAgreeWithCentralDifferences) {
  constexpr double step = 1e-5;
  for (const auto& xi : some_points(cell_)) {
    const auto dn = gradients(cell_, xi);
    for (int a = 0; a < cell_.dimension; ++a) {
      const Vector3d shift = step * Vector3d::Unit(a);
      const auto above = values(cell_, xi + shift);
      const auto below = values(cell_, xi - shift);
      for (std::size_t i = 0; i < above.size(); ++i)
        EXPECT_NEAR(dn[i * static_cast<std::size_t>(cell_.dimension) + static_cast<std::size_t>(a)],
                    (above[i] - below[i]) / (2 * step), 2e-8);
    }
  }
}

TEST_P(EveryReferenceCell, HasHessiansThatAgreeWithCentralDifferences) {
  if (cell_.hessians == nullptr)
    return;
  constexpr double step = 1e-5;
  const auto d = static_cast<std::size_t>(cell_.dimension);
  std::vector<double> ddn(cell_.nodes.size() * d * d);
  for (const auto& xi : some_points(cell_)) {
    cell_.hessians(xi, ddn);
    for (std::size_t b = 0; b < d; ++b) {
      const Vector3d shift = step * Vector3d::Unit(static_cast<int>(b));
      const auto above = gradients(cell_, xi + shift);
      const auto below = gradients(cell_, xi - shift);
      for (std::size_t row = 0; row < above.size(); ++row)
        EXPECT_NEAR(ddn[row * d + b], (above[row] - below[row]) / (2 * step), 2e-8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ReferenceCells, EveryReferenceCell, testing::ValuesIn(every_type()),
                         [](const auto& instance) {
                           return std::string(cell::topology(instance.param).name);
                         });

TEST(ReferenceCells, AreSeventeen) {
  EXPECT_EQ(every_type().size(), 17U);
}

TEST(ReferenceCells, RefuseTypesWithoutMechanics) {
  EXPECT_FALSE(has_reference_cell(CellType::penta18));
  EXPECT_THROW(reference_cell(CellType::penta18), std::invalid_argument);
  EXPECT_THROW(reference_cell(CellType::point1), std::invalid_argument);
}

} // namespace
} // namespace rubato::cell::reference_cell_test
