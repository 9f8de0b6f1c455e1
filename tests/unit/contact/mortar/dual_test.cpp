// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/dual.hpp"
#include "rubato/contact/mortar/subfacets.hpp"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "unit/contact/mortar/surfaces.hpp"
#include <functional>
#include <random>

namespace rubato::dual_test {
namespace {

using namespace contact::mortar;
using Eigen::Matrix4d;
using Eigen::Vector2d;
using Eigen::Vector4d;

constexpr std::array all_kept{true, true, true, true};

FacetMoments whole(const SubFacet& facet) {
  FacetMoments moments;
  for (const auto& [xi, weight] : facet_rule(facet, 8))
    moments.add(weight, facet_values(facet, xi.head<2>()));
  return moments;
}

/// A random part of a sub-facet: positive weights at random places of it.
FacetMoments random_part(const SubFacet& facet, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  FacetMoments moments;
  for (int q = 0; q < 12; ++q) {
    Vector4d values = Vector4d::Zero();
    for (int i = 0; i < facet.node_count; ++i)
      values[i] = unit(random);
    moments.add(unit(random), values / values.sum());
  }
  return moments;
}

struct Shares {
  CellType type;
  double corner, mid, centre;
};

TEST(SubFacets, ShareTheAreaOfAFaceAmongItsNodesAsTheTableSays) {
  for (const auto& [type, corner, mid, centre] :
       {Shares{CellType::seg2, 1. / 2, 0, 0}, Shares{CellType::tria3, 1. / 3, 0, 0},
        Shares{CellType::quad4, 1. / 4, 0, 0}, Shares{CellType::seg3, 1. / 4, 1. / 2, 0},
        Shares{CellType::tria6, 1. / 12, 1. / 4, 0}, Shares{CellType::tria7, 1. / 9, 1. / 9, 1. / 3},
        Shares{CellType::quad8, 1. / 24, 5. / 24, 0}, Shares{CellType::quad9, 1. / 16, 1. / 8, 1. / 4}}) {
    std::array<double, 9> areas{};
    double face = 0;
    for (const auto& facet : subfacets(type)) {
      EXPECT_GT(facet.from_local.determinant(), 0) << test::name_of(type);
      for (const auto& [xi, weight] : facet_rule(facet, 2)) {
        face += weight;
        const Vector4d values = facet_values(facet, xi.head<2>());
        for (std::size_t i = 0; i < 4; ++i)
          areas[facet.nodes[i]] += weight * values[static_cast<Eigen::Index>(i)];
      }
    }
    const auto& cell = cell::topology(type);
    const int mids = cell.dimension == 1 ? (cell.order == 2 ? 1 : 0) : static_cast<int>(cell.edges.size());
    for (int i = 0; i < cell.node_count; ++i) {
      const double expected = i < cell.corner_count ? corner : i < cell.corner_count + mids ? mid : centre;
      EXPECT_NEAR(areas[static_cast<std::size_t>(i)] / face, expected, 1e-15)
          << test::name_of(type) << " node " << i;
    }
  }
}

TEST(SubFacets, AreOneAtTheirOwnNodeAndZeroAtTheOthers) {
  for (const auto type : {CellType::seg2, CellType::seg3, CellType::tria3, CellType::tria6, CellType::tria7,
                          CellType::quad4, CellType::quad8, CellType::quad9})
    for (const auto& facet : subfacets(type))
      for (int i = 0; i < facet.node_count; ++i) {
        const auto& xi = cell::reference_cell(type).nodes[facet.nodes[static_cast<std::size_t>(i)]];
        EXPECT_LE((facet_values(facet, xi.head<2>()) - Vector4d::Unit(i)).norm(), 1e-15);
      }
}

TEST(SubFacets, OfSolidsAreRefused) {
  EXPECT_THROW(subfacets(CellType::hexa8), std::invalid_argument);
}

TEST(DualFunctions, OnWholeAffineSubFacetsAreTheKnownOnes) {
  for (const auto type : {CellType::seg2, CellType::seg3, CellType::tria3, CellType::tria6, CellType::tria7,
                          CellType::quad4, CellType::quad8, CellType::quad9})
    for (const auto& facet : subfacets(type)) {
      const auto moments = whole(facet);
      const Matrix4d dual = dual_coefficients(facet.node_count, moments, moments.first.sum(), all_kept);
      for (const auto& [place, weight] : facet_rule(facet, 4)) {
        const Vector2d xi = place.head<2>();
        const Vector4d h = facet_values(facet, xi), phi = dual * h;
        const Vector2d r = facet.to_local * (xi - facet.origin);
        const auto along = [](double s, bool end) { return 3 * 0.5 * (end ? 1 + s : 1 - s) - 1; };
        for (int a = 0; a < facet.node_count; ++a) {
          double expected = 4 * h[a] - 1;
          if (facet.node_count == 2)
            expected = 3 * h[a] - 1;
          if (facet.node_count == 4)
            expected = along(r[0], a == 1 || a == 2) * along(r[1], a >= 2);
          EXPECT_NEAR(phi[a], expected, 2e-14) << test::name_of(type);
        }
      }
    }
}

TEST(DualFunctions, AreDualAndAddUpToOneOnAnyPart) {
  std::mt19937 random(3);
  for (const auto type : {CellType::seg2, CellType::tria3, CellType::quad4})
    for (int trial = 0; trial < 200; ++trial) {
      const auto& facet = subfacets(type).front();
      const auto part = random_part(facet, random);
      const int n = facet.node_count;
      const Matrix4d dual = dual_coefficients(n, part, part.first.sum(), all_kept);
      const Matrix4d products = dual * part.second;
      EXPECT_LE((products.topLeftCorner(n, n) - Matrix4d(part.first.asDiagonal()).topLeftCorner(n, n)).norm(),
                1e-11);
      EXPECT_LE((dual.leftCols(n).colwise().sum().array() - 1).abs().maxCoeff(), 1e-9);
      EXPECT_LE((kept_areas(n, part, all_kept) - part.first).norm(), 1e-14);
    }
}

TEST(DualFunctions, OfDroppedNodesAreGivenToTheKeptOnes) {
  std::mt19937 random(4);
  for (unsigned kept_set = 1; kept_set < 16; ++kept_set) {
    std::array<bool, 4> kept{};
    for (unsigned i = 0; i < 4; ++i)
      kept[i] = (kept_set >> i & 1U) != 0;
    const auto& facet = subfacets(CellType::quad4).front();
    const auto part = random_part(facet, random);
    const double area = part.first.sum();
    const Matrix4d dual = dual_coefficients(4, part, area, kept);
    const Vector4d areas = kept_areas(4, part, kept);
    EXPECT_NEAR(areas.sum(), area, 1e-14 * area);
    EXPECT_LE((dual.colwise().sum().array() - 1).abs().maxCoeff(), 1e-9);
    EXPECT_LE((dual * part.first - areas).norm(), 1e-10 * area);
    for (int i = 0; i < 4; ++i)
      if (!kept[static_cast<std::size_t>(i)]) {
        EXPECT_TRUE(dual.row(i).isZero(0));
      }
  }
}

TEST(DualFunctions, AreTheLinearOnesBelowOnePercentOfCover) {
  const auto& facet = subfacets(CellType::tria3).front();
  const auto moments = whole(facet);
  const double area = moments.first.sum();
  EXPECT_EQ(dual_coefficients(3, moments, 101 * area, all_kept), Matrix4d(Vector4d(1, 1, 1, 0).asDiagonal()));
  EXPECT_NE(dual_coefficients(3, moments, 99 * area, all_kept), Matrix4d(Vector4d(1, 1, 1, 0).asDiagonal()));
}

TEST(DualFunctions, OfASingularPartAreTheLinearOnes) {
  FacetMoments point;
  point.add(1, {1, 0, 0, 0});
  const Matrix4d dual = dual_coefficients(4, point, 1, all_kept);
  EXPECT_TRUE(dual.allFinite());
  EXPECT_EQ(dual, Matrix4d::Identity());
}

/// LeastGaps and the fitted values of a gap over a part of the reference line [−1, 1].
struct Fitted {
  std::array<double, 2> bounds;
  Vector4d values;
  std::array<LeastGaps::Bound, 2> changes;
  std::vector<double> places; ///< where gaps were seen
  std::size_t least_seen;
  Vector4d first_gap;
};

Fitted fitted(double low, double high, const std::function<double(double)>& gap) {
  const auto& facet = subfacets(CellType::seg2)[0];
  FacetMoments covered;
  Vector4d first_gap = Vector4d::Zero();
  std::vector<std::pair<Vector4d, double>> seen;
  std::vector<double> places;
  constexpr int pieces = 400;
  for (int q = 0; q < pieces; ++q) {
    const double xi = low + (high - low) * (q + 0.5) / pieces, weight = (high - low) / pieces;
    const Vector4d values = facet_values(facet, Vector2d(xi, 0));
    covered.add(weight, values);
    first_gap += weight * gap(xi) * values;
    seen.emplace_back(values, gap(xi));
    places.push_back(xi);
  }
  for (const double xi : {low, high}) {
    seen.emplace_back(facet_values(facet, Vector2d(xi, 0)), gap(xi));
    places.push_back(xi);
  }
  const auto rows = dual_coefficients(2, covered, 2, all_kept);
  LeastGaps least(2, covered, rows, first_gap);
  for (const auto& [values, value] : seen)
    least.see(values, value);
  Vector4d means = Vector4d::Zero();
  for (int i = 0; i < 2; ++i)
    means[i] = rows.row(i).dot(first_gap) / covered.first[i];
  const std::array changes{least.bound(0, 1), least.bound(1, 1)};
  return {{changes[0].value, changes[1].value}, means, changes, places, least.least_seen(), first_gap};
}

TEST(LeastGaps, AreAboveTheMeanOfAGapThatGrowsWithTheSquare) {
  const auto of = fitted(-1, 1, [](double xi) { return 0.25 * (1 + xi) * (1 + xi); });
  EXPECT_NEAR(of.values[0], -1. / 6, 1e-5); // −1/12 over the weight of 1/2
  EXPECT_EQ(of.bounds[0], 0);
  EXPECT_LT(of.bounds[1], of.values[1]);
}

TEST(LeastGaps, AreAboveTheMeanAtAKink) {
  const auto of = fitted(-1, 1, [](double xi) { return std::max(0., xi + 1. / 3); });
  EXPECT_NEAR(of.values[0], -2 * 4. / 27, 1e-5);
  EXPECT_EQ(of.bounds[0], 0);
}

TEST(LeastGaps, LeaveLinearGapsAlsoWhereANodeIsNotCovered) {
  for (const double high : {1., 0.3, -0.5})
    for (const double slope : {-0.06, 0.06}) {
      const auto of = fitted(-1, high, [&](double xi) { return 0.2 + slope * xi; });
      for (int i = 0; i < 2; ++i)
        EXPECT_LE(of.bounds[i], of.values[i] + 1e-12) << high << ' ' << slope << ' ' << i;
    }
}

TEST(LeastGaps, MoveWithTheGapWhereItIsOpen) {
  const auto gap = [](double xi) { return std::max(0., xi + 1. / 3); };
  const auto of = fitted(-1, 1, gap), lifted = fitted(-1, 1, [&](double xi) { return gap(xi) + 0.01; });
  EXPECT_NEAR(lifted.bounds[0], of.bounds[0] + 0.01, 1e-15);
}

TEST(LeastGaps, LetTheMeanBeTwiceAsDeepAsWhatOverlaps) {
  const auto of = fitted(-1, 1, [](double xi) { return std::max(0., xi + 1. / 3) - 0.01; });
  EXPECT_NEAR(of.bounds[0], -0.02, 1e-15);
}

TEST(LeastGaps, FallToANodeThatIsNotCoveredByATenthOfTheSize) {
  const auto of = fitted(-1, 0.5, [](double xi) { return 2 - 2 * xi; });
  EXPECT_NEAR(of.values[1], 0, 1e-12);
  EXPECT_NEAR(of.bounds[1], 1 - 0.1, 1e-12);
}

/// Open, overlapping, with a node beyond the covered part that may fall freely, and one that may not.
TEST(LeastGaps, ChangeAsTheyAreLinearised) {
  struct Case {
    double high;
    std::function<double(double)> gap;
  };
  const std::vector<Case> cases{{1, [](double xi) { return 0.3 + 0.25 * (0.903 + xi) * (0.903 + xi); }},
                                {1, [](double xi) { return 0.25 * (0.903 + xi) * (0.903 + xi) - 0.01; }},
                                {0.7, [](double xi) { return 0.2 - 0.06 * xi + 0.03 * xi * xi; }},
                                {0.5, [](double xi) { return 2 - 2 * xi; }}};
  const auto change = [](double xi) { return 0.7 + 0.4 * xi - 0.3 * xi * xi; };
  constexpr double step = 1e-6;
  for (const auto& [high, gap] : cases) {
    const auto of = fitted(-1, high, gap);
    const auto more = fitted(-1, high, [&, &gap = gap](double xi) { return gap(xi) + step * change(xi); });
    const auto less = fitted(-1, high, [&, &gap = gap](double xi) { return gap(xi) - step * change(xi); });
    const Vector4d integral = (more.first_gap - less.first_gap) / (2 * step);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& by = of.changes[i];
      const double expected = by.by_least * change(of.places[of.least_seen]) + by.row.dot(integral);
      EXPECT_NEAR((more.bounds[i] - less.bounds[i]) / (2 * step), expected, 1e-8) << high << ' ' << i;
    }
  }
}

} // namespace
} // namespace rubato::dual_test
