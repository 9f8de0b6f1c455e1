// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/quadrature.hpp"
#include "rubato/cell/reference_cell.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::cell::quadrature_test {
namespace {

using Exponents = std::array<int, 3>;

std::vector<CellType> every_type() {
  std::vector<CellType> types;
  for (const auto& cell : cell::all_topologies())
    if (has_reference_cell(cell.type))
      types.push_back(cell.type);
  return types;
}

double factorial(int n) {
  return std::tgamma(n + 1.);
}

double line_integral(int power) {
  return power % 2 == 0 ? 2. / (power + 1) : 0.;
}

/// ∫ x^i y^j z^k over the reference cell; simplices by i! j! k! / (i + j + k + dimension)!.
double exact_integral(CellType type, const Exponents& p) {
  const auto [i, j, k] = p;
  switch (cell::topology(type).corner_count * 10 + cell::topology(type).dimension) {
  case 21:
    return line_integral(i);
  case 32:
    return factorial(i) * factorial(j) / factorial(i + j + 2);
  case 42:
    return line_integral(i) * line_integral(j);
  case 43:
    return factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
  case 53: // ∫ (1−z)^(i+j+2) z^k dz = (i+j+2)! k! / (i+j+k+3)!
    return line_integral(i) * line_integral(j) * factorial(i + j + 2) * factorial(k) /
           factorial(i + j + k + 3);
  case 63:
    return factorial(i) * factorial(j) / factorial(i + j + 2) * line_integral(k);
  default:
    return line_integral(i) * line_integral(j) * line_integral(k);
  }
}

double integral(std::span<const QuadraturePoint> rule, const Exponents& p) {
  double sum = 0;
  for (const auto& [xi, weight] : rule)
    sum += weight * std::pow(xi[0], p[0]) * std::pow(xi[1], p[1]) * std::pow(xi[2], p[2]);
  return sum;
}

void expect_exact(CellType type, std::span<const QuadraturePoint> rule, int degree) {
  const int dimension = cell::topology(type).dimension;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; j <= (dimension > 1 ? degree - i : 0); ++j)
      for (int k = 0; k <= (dimension > 2 ? degree - i - j : 0); ++k)
        EXPECT_NEAR(integral(rule, {i, j, k}), exact_integral(type, {i, j, k}),
                    3e-15 * std::pow(2, dimension))
            << cell::topology(type).name << " x^" << i << " y^" << j << " z^" << k << ", degree " << degree;
}

class EveryQuadrature : public testing::TestWithParam<CellType> {};

TEST_P(EveryQuadrature, IsExactToItsDegree) {
  for (int degree = 0; degree <= 9; ++degree)
    expect_exact(GetParam(), rule_of_degree(GetParam(), degree), degree);
}

TEST_P(EveryQuadrature, IntegratesProductsOfShapeFunctionsExactlyByTheMassRule) {
  const auto& cell = reference_cell(GetParam());
  const auto n = static_cast<std::size_t>(cell.node_count);
  const auto gram = [&](std::span<const QuadraturePoint> rule) {
    std::vector<double> values(n), products(n * n, 0.);
    for (const auto& [xi, weight] : rule) {
      cell.values(xi, values);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          products[i * n + j] += weight * values[i] * values[j];
    }
    return products;
  };
  const auto products = gram(mass_rule(GetParam()));
  const auto reference = gram(rule_of_degree(GetParam(), 9));
  for (std::size_t k = 0; k < products.size(); ++k)
    EXPECT_NEAR(products[k], reference[k], 1e-14);
}

TEST_P(EveryQuadrature, IntegratesProductsOfGradientsExactlyByTheStiffnessRule) {
  const auto& cell = reference_cell(GetParam());
  const auto rows = static_cast<std::size_t>(cell.node_count * cell.dimension);
  const auto gram = [&](std::span<const QuadraturePoint> rule) {
    std::vector<double> n_xi(rows), products(rows * rows, 0.);
    for (const auto& [xi, weight] : rule) {
      cell.gradients(xi, n_xi);
      for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < rows; ++j)
          products[i * rows + j] += weight * n_xi[i] * n_xi[j];
    }
    return products;
  };
  const auto products = gram(stiffness_rule(GetParam()));
  const auto reference = gram(rule_of_degree(GetParam(), 9));
  for (std::size_t k = 0; k < products.size(); ++k)
    EXPECT_NEAR(products[k], reference[k], 1e-13);
}

TEST_P(EveryQuadrature, HasPositiveWeights) {
  for (const auto rule : {stiffness_rule(GetParam()), mass_rule(GetParam())})
    for (const auto& point : rule)
      EXPECT_GT(point.weight, 0.);
}

INSTANTIATE_TEST_SUITE_P(Quadratures, EveryQuadrature, testing::ValuesIn(every_type()),
                         [](const auto& instance) {
                           return std::string(cell::topology(instance.param).name);
                         });

TEST(QuadratureRules, HaveTheCustomaryNumbersOfPoints) {
  using Case = std::tuple<CellType, std::size_t, std::size_t>;
  for (const auto& [type, stiffness, mass] :
       {Case{CellType::tria3, 1, 3}, Case{CellType::tria6, 3, 6}, Case{CellType::quad4, 4, 4},
        Case{CellType::quad8, 9, 9}, Case{CellType::quad9, 9, 9}, Case{CellType::tetra4, 1, 4},
        Case{CellType::tetra10, 4, 15}, Case{CellType::pyra5, 8, 8}, Case{CellType::pyra13, 27, 27},
        Case{CellType::penta6, 6, 6}, Case{CellType::penta15, 18, 18}, Case{CellType::hexa8, 8, 8},
        Case{CellType::hexa20, 27, 27}, Case{CellType::hexa27, 27, 27}}) {
    EXPECT_EQ(stiffness_rule(type).size(), stiffness) << cell::topology(type).name;
    EXPECT_EQ(mass_rule(type).size(), mass) << cell::topology(type).name;
  }
}

TEST(GaussRules, AreExactToTheirDegreeOnFaces) {
  for (int n = 1; n <= 7; ++n) {
    expect_exact(CellType::seg3, gauss_rule(CellType::seg3, n), 2 * n - 1);
    expect_exact(CellType::quad8, gauss_rule(CellType::quad8, n), 2 * n - 1);
    expect_exact(CellType::tria6, gauss_rule(CellType::tria6, n), n == 1 ? 1 : 2 * n - 2);
  }
}

TEST(GaussRules, OfPrismsHaveOnePointLessAcrossThanAlong) {
  for (int n = 2; n <= 5; ++n)
    expect_exact(CellType::penta15, gauss_rule(CellType::penta15, n), n == 2 ? 1 : 2 * n - 4);
  EXPECT_EQ(gauss_rule(CellType::penta6, 2).size(), 2U);
  EXPECT_EQ(gauss_rule(CellType::penta15, 3).size(), 9U);
  EXPECT_THROW(gauss_rule(CellType::penta6, 1), std::invalid_argument);
}

TEST(GaussRules, ListTheSixPointsOfATriangleInTheDocumentedOrder) {
  const double a = 0.445948490915965, b = 0.091576213509771;
  const std::array<std::array<double, 3>, 6> expected{{{b, b, 0.054975871827661},
                                                       {1 - 2 * b, b, 0.054975871827661},
                                                       {b, 1 - 2 * b, 0.054975871827661},
                                                       {a, 1 - 2 * a, 0.111690794839005},
                                                       {a, a, 0.111690794839005},
                                                       {1 - 2 * a, a, 0.111690794839005}}};
  const auto rule = gauss_rule(CellType::tria6, 3);
  ASSERT_EQ(rule.size(), expected.size());
  for (std::size_t i = 0; i < rule.size(); ++i) {
    EXPECT_NEAR(rule[i].xi[0], expected[i][0], 3e-15);
    EXPECT_NEAR(rule[i].xi[1], expected[i][1], 3e-15);
    EXPECT_NEAR(rule[i].weight, expected[i][2], 2e-15);
  }
}

TEST(QuadratureRules, RefuseWhatTheyCannotIntegrate) {
  EXPECT_THROW(rule_of_degree(CellType::penta18, 2), std::invalid_argument);
  EXPECT_THROW(rule_of_degree(CellType::seg2, -1), std::invalid_argument);
  EXPECT_THROW(stiffness_rule(CellType::point1), std::invalid_argument);
  EXPECT_THROW(gauss_rule(CellType::tetra4, 2), std::invalid_argument);
  EXPECT_THROW(gauss_rule(CellType::seg2, 0), std::invalid_argument);
}

} // namespace
} // namespace rubato::cell::quadrature_test
