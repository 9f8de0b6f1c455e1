// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/mooney_rivlin.hpp"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "support/point_path.hpp"

namespace rubato::material::mooney_rivlin_test {
namespace {

using test::PointPath;
using test::random_six;

TEST(MooneyRivlin, NearlyIncompressibleStretchesAreThoseOfTheClosedForms) {
  const MooneyRivlin neo{0.5, 0, 1e5};
  const MooneyRivlin two{0.4, 0.1, 1e5};
  EXPECT_NEAR(test::nominal_stress(neo, 2, false), 1.749983, 1e-6); // incompressible 1.75
  EXPECT_NEAR(test::nominal_stress(neo, 2, true), 1.968714, 1e-6);  // 1.96875
  EXPECT_NEAR(test::nominal_stress(two, 2, false), 1.574987, 1e-6); // 1.575
}

/// The energy by the invariants of C, for strains that are not small.
double plain_energy(const MooneyRivlin& law, const Strain6& strain) {
  Eigen::Matrix3d c;
  c << 1 + 2 * strain[0], strain[3], strain[5], strain[3], 1 + 2 * strain[1], strain[4], strain[5], strain[4],
      1 + 2 * strain[2];
  const double j = std::sqrt(c.determinant());
  const double a = std::pow(j, -2.0 / 3);
  const double first = c.trace();
  const double second = 0.5 * (first * first - (c * c).trace());
  const double volume = law.volumetric == Volumetric::quadratic
                            ? law.bulk / 2 * (j - 1) * (j - 1)
                            : law.bulk / 4 * (j * j - 1 - 2 * std::log(j));
  return law.c10 * (a * first - 3) + law.c01 * (a * a * second - 3) + volume;
}

TEST(MooneyRivlin, StoresItsEnergyAndHasItsDerivativeAsStress) {
  std::mt19937 engine(1);
  for (const auto kind : {Volumetric::logarithmic, Volumetric::quadratic}) {
    const MooneyRivlin law{0.4, 0.1, 20, kind};
    for (int i = 0; i < 20; ++i) {
      const auto strain = random_six(engine, 0.2);
      PointPath path(law);
      const auto expected = test::stress_by_differences(path, strain, 2e-4);
      ASSERT_TRUE(path.to_strain(strain));
      EXPECT_NEAR(path.response().stored, plain_energy(law, strain), 1e-13 * path.response().stored + 1e-14);
      EXPECT_LT((path.response().stress - expected).norm(), 1e-9 * expected.norm());
    }
  }
}

/// Of strains so small that the law is linear, every digit that the strain has.
TEST(MooneyRivlin, LosesNothingInSmallStrains) {
  std::mt19937 engine(1);
  const double bulk = 2e4;
  for (const double c01 : {0.0, 0.1}) {
    const MooneyRivlin law{0.5 - c01, c01, bulk};
    const auto young = 9 * bulk / (3 * bulk + 1);
    const auto linear = make_elastic_point(young, young / 2 - 1);
    for (const double size : {1e-9, 1e-12, 1e-15}) {
      auto strain = random_six(engine, size);
      strain[2] = -strain[0] - strain[1]; // the volume stays: its stress would hide the others
      PointPath path(law);
      ASSERT_TRUE(path.to_strain(strain));
      const double shear = path.response().stress[3] / strain[3];
      EXPECT_NEAR(shear, 1, 1e-8 * size / 1e-9 + 1e-14);
      EXPECT_NEAR(path.response().stored, 0.5 * strain.dot(linear.stiffness * strain),
                  1e-6 * path.response().stored);
    }
  }
}

TEST(MooneyRivlin, RefusesStrainsThatNoBodyHas) {
  std::vector<double> none;
  Response out;
  Strain6 strain = Strain6::Zero();
  strain[1] = -0.5;
  EXPECT_FALSE(respond(MooneyRivlin{0.4, 0.1, 20}, strain, none, none, {}, Want::stress, out));
  strain << -0.7, -0.7, 0, 0, 0, 0; // det C is positive
  EXPECT_FALSE(respond(MooneyRivlin{0.4, 0.1, 20}, strain, none, none, {}, Want::stress, out));
  strain << std::nan(""), 0, 0, 0, 0, 0;
  EXPECT_FALSE(respond(MooneyRivlin{0.4, 0.1, 20}, strain, none, none, {}, Want::stress, out));
}

} // namespace
} // namespace rubato::material::mooney_rivlin_test
