// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/integration.hpp"
#include "rubato/contact/simpson.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::contact::integration_test {
namespace {

constexpr std::array faces{CellType::seg2,  CellType::seg3,  CellType::tria3, CellType::tria6,
                           CellType::tria7, CellType::quad4, CellType::quad8, CellType::quad9};

std::string name_of(const testing::TestParamInfo<CellType>& face) {
  return std::string(cell::topology(face.param).name);
}

bool is_triangle(CellType face) {
  return cell::topology(face).corner_count == 3;
}

/// ∫ ξ^i η^j over the reference face: [−1, 1], [−1, 1]² or the triangle of unit legs.
double exact(CellType face, int i, int j) {
  if (is_triangle(face))
    return std::tgamma(i + 1) * std::tgamma(j + 1) / std::tgamma(i + j + 3);
  const auto line = [](int power) { return power % 2 == 1 ? 0.0 : 2.0 / (power + 1); };
  return line(i) * (cell::topology(face).dimension == 1 ? 1.0 : line(j));
}

double integral(const std::vector<IntegrationPoint>& rule, int i, int j) {
  double sum = 0;
  for (const auto& point : rule)
    sum += point.weight * std::pow(point.xi[0], i) * std::pow(point.xi[1], j);
  return sum;
}

/// By all monomials up to a degree, in each direction on segments and quadrangles.
void expect_exact(CellType face, const std::vector<IntegrationPoint>& rule, int degree) {
  const bool line = cell::topology(face).dimension == 1;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= (line ? 0 : is_triangle(face) ? degree - i : degree); ++j)
      EXPECT_NEAR(integral(rule, i, j), exact(face, i, j), 1e-14) << "of degrees " << i << ", " << j;
}

class ContactRule : public testing::TestWithParam<CellType> {};

/// A uniform pressure then puts on each node what the face's shape functions do: linear faces need degree 1,
/// quadratic ones 2, and Simpson's rule has 3.
TEST_P(ContactRule, IntegratesShapeFunctions) {
  const auto face = GetParam();
  const bool linear = cell::topology(face).node_count == cell::topology(face).corner_count;
  const int degree = linear ? 1 : is_triangle(face) ? 4 : 3;
  expect_exact(face, nodal_rule(face), degree);
}

TEST_P(ContactRule, IsAsExactAsItsGaussPointsAllow) {
  const auto face = GetParam();
  for (const int points : {1, 2, 3, 4}) {
    const auto rule = gauss_rule(face, points);
    expect_exact(face, rule, is_triangle(face) ? points : 2 * points - 1);
    for (const auto& point : rule) {
      EXPECT_GT(point.weight, 0);
      EXPECT_EQ(point.node, -1);
      EXPECT_EQ(point.stands_for, -1);
    }
  }
}

/// Code_Aster's weights on triangles integrate linear functions only.
TEST_P(ContactRule, OfSimpsonHasItsDegreeWhateverTheParts) {
  const auto face = GetParam();
  for (int parts = 1; parts <= 4; ++parts) {
    const auto rule = simpson_rule(face, parts);
    expect_exact(face, rule, is_triangle(face) ? 1 : 3);
    const int line = 2 * parts + 1;
    const int expected = cell::topology(face).dimension == 1 ? line
                         : is_triangle(face)                 ? line * (line + 1) / 2
                                                             : line * line;
    EXPECT_EQ(rule.size(), static_cast<std::size_t>(expected));
    for (const auto& point : rule)
      EXPECT_GT(point.weight, 0);
  }
}

/// Where Simpson's rule is the closed Newton–Cotes rule of a quadratic face.
TEST(SimpsonRule, OfOnePartIsTheRuleOnTheNodesOfQuadraticFaces) {
  for (const auto face : {CellType::seg3, CellType::quad9})
    for (const auto& point : nodal_rule(face)) {
      const auto rule = simpson_rule(face, 1);
      const auto same = std::ranges::find(rule, point.node, &IntegrationPoint::node);
      ASSERT_NE(same, rule.end());
      EXPECT_NEAR(same->weight, point.weight, 1e-15);
      EXPECT_EQ(same->stands_for, point.stands_for);
    }
}

TEST_P(ContactRule, NeedsAPointForEachNodeAndItsShapeFunctions) {
  const auto face = GetParam();
  EXPECT_EQ(least_order(study::ContactIntegration::nodes, face), 0);
  EXPECT_EQ(least_order(study::ContactIntegration::gauss, face),
            face == CellType::tria7 ? 4 : cell::topology(face).order + 1);
  const bool refused = face == CellType::tria6 || face == CellType::tria7;
  EXPECT_EQ(least_order(study::ContactIntegration::simpson, face), refused ? std::nullopt : std::optional(1));
}

TEST_P(ContactRule, StandsOnTheNodesThatItNames) {
  const auto face = GetParam();
  const auto& cell = cell::reference_cell(face);
  for (const auto& rule : {nodal_rule(face), node_rule(face)})
    for (const auto& point : rule)
      if (point.node >= 0) {
        const auto& node = cell.nodes[static_cast<std::size_t>(point.node)];
        EXPECT_EQ(point.xi, Eigen::Vector2d(node[0], cell.dimension == 1 ? 0.0 : node[1]));
        EXPECT_EQ(point.stands_for, point.node);
      }
}

/// Code_Aster's order: the i-th point is the one nearest to the i-th node of those that stand for one.
TEST_P(ContactRule, StandsForTheNearestNode) {
  const auto face = GetParam();
  const auto& cell = cell::reference_cell(face);
  for (const auto& point : nodal_rule(face)) {
    if (point.stands_for < 0)
      continue;
    const auto apart = [&](int node) {
      const auto& place = cell.nodes[static_cast<std::size_t>(node)];
      return (Eigen::Vector2d(place[0], cell.dimension == 1 ? 0.0 : place[1]) - point.xi).norm();
    };
    for (int node = 0; node < std::min(cell.node_count, 6); ++node)
      EXPECT_LE(apart(point.stands_for), apart(node) + 1e-14);
  }
}

TEST_P(ContactRule, HasOnePointOnEveryNodeForNodalMethods) {
  const auto face = GetParam();
  const auto rule = node_rule(face);
  ASSERT_EQ(static_cast<int>(rule.size()), cell::reference_cell(face).node_count);
  double sum = 0;
  for (std::size_t i = 0; i < rule.size(); ++i) {
    EXPECT_EQ(rule[i].node, static_cast<int>(i));
    EXPECT_GT(rule[i].weight, 0);
    sum += rule[i].weight;
  }
  EXPECT_NEAR(sum, exact(face, 0, 0), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Of, ContactRule, testing::ValuesIn(faces), name_of);

TEST(ContactRule, IsNoneOfSolids) {
  EXPECT_THROW(nodal_rule(CellType::hexa8), std::invalid_argument);
}

} // namespace
} // namespace rubato::contact::integration_test
