// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/ogden.hpp"
#include "rubato/material/voigt.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "support/point_path.hpp"

namespace rubato::material::ogden_test {
namespace {

using test::PointPath;
using test::random_six;

TEST(Ogden, OfTheExponents2AndMinus2IsMooneyRivlin) {
  std::mt19937 engine(1);
  for (const auto kind : {Volumetric::logarithmic, Volumetric::quadratic})
    for (int i = 0; i < 10; ++i) {
      const auto strain = random_six(engine, 0.25);
      PointPath ogden(Ogden{{{0.8, 2}, {0.2, -2}}, 20, kind});
      PointPath mooney(MooneyRivlin{0.4, 0.1, 20, kind});
      ASSERT_TRUE(ogden.to_strain(strain) && mooney.to_strain(strain));
      const auto& a = ogden.response();
      const auto& b = mooney.response();
      EXPECT_NEAR(a.stored, b.stored, 1e-13 * b.stored);
      EXPECT_LT((a.stress - b.stress).norm(), 1e-13 * b.stress.norm());
      EXPECT_LT((a.tangent - b.tangent).norm(), 1e-13 * b.tangent.norm());
    }
}

/// Two principal strains that differ by less and less, in axes of their own.
TEST(Ogden, KeepsItsTangentWhereStretchesAreEqualOrNearlySo) {
  const Eigen::Matrix3d axes(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, -2, 3).normalized()));
  for (const double apart : {0.0, 1e-16, 1e-14, 1e-12, 1e-9, 1e-6, 1e-3, 1e-1})
    for (const double third : {0.3, -0.2}) {
      Strain6 principal = Strain6::Zero();
      principal.head<3>() << 0.3, 0.3 + apart, third;
      const Strain6 strain = strain_rotation(axes) * principal;
      PointPath ogden(Ogden{{{0.8, 2}, {0.2, -2}}, 20});
      PointPath mooney(MooneyRivlin{0.4, 0.1, 20});
      ASSERT_TRUE(ogden.to_strain(strain) && mooney.to_strain(strain));
      const Tangent6 expected = mooney.response().tangent;
      EXPECT_LT((ogden.response().tangent - expected).norm(), 1e-13 * expected.norm()) << apart;
    }
}

/// Incompressible tension of Ogden's rubber (1972; MPa): P = Σ 2μ/α (λ^(α−1) − λ^(−α/2−1)).
TEST(Ogden, PulledGivesItsClosedForm) {
  // Ogden's μ, times α/2 the coefficients here.
  const std::vector<Ogden::Term> terms{{0.63 * 1.3 / 2, 1.3}, {0.0012 * 5.0 / 2, 5}, {0.01 * 2.0 / 2, -2}};
  for (const double stretch : {0.5, 0.9, 1.1, 2.0, 6.0}) {
    double expected = 0;
    for (const auto& [shear, exponent] : terms)
      expected +=
          2 * shear / exponent * (std::pow(stretch, exponent - 1) - std::pow(stretch, -exponent / 2 - 1));
    const double found = test::nominal_stress(Ogden{terms, 1e7}, stretch, false);
    EXPECT_NEAR(found, expected, 1e-5 * std::abs(expected)) << stretch;
  }
}

TEST(Ogden, HasTheDerivativeOfItsEnergyAsStress) {
  std::mt19937 engine(2);
  for (int i = 0; i < 10; ++i) {
    const auto strain = random_six(engine, 0.2);
    PointPath path(Ogden{{{0.6, 1.3}, {0.01, 5}, {0.1, -2}}, 20});
    const auto expected = test::stress_by_differences(path, strain, 2e-4);
    ASSERT_TRUE(path.to_strain(strain));
    EXPECT_LT((path.response().stress - expected).norm(), 1e-9 * expected.norm());
  }
}

TEST(Ogden, RefusesStrainsThatNoBodyHas) {
  PointPath path(Ogden{{{1, 2}}, 20});
  EXPECT_FALSE(path.to_strain(-0.5 * Strain6::Unit(2)));
  EXPECT_FALSE(path.to_strain(std::nan("") * Strain6::Unit(2)));
}

} // namespace
} // namespace rubato::material::ogden_test
