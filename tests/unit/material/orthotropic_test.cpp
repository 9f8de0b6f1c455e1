// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/law.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include <cmath>
#include <numbers>
#include <random>

namespace rubato::material::orthotropic_test {
namespace {

using Eigen::Vector3d;
using study::Physics;

constexpr Physics all_physics[] = {Physics::solid, Physics::plane_stress, Physics::plane_strain,
                                   Physics::axisymmetric};
constexpr double degree = std::numbers::pi / 180;

/// Wood: three different axes.
study::Orthotropy spruce() {
  study::Orthotropy o;
  o.young_x = 11600, o.young_y = 900, o.young_z = 500;
  o.poisson_xy = 0.37, o.poisson_yz = 0.43, o.poisson_xz = 0.47;
  o.shear_xy = 750, o.shear_yz = 39, o.shear_xz = 720;
  return o;
}

study::Orthotropy turned(double z, double y = 0, double x = 0) {
  auto o = spruce();
  o.angle_z = z, o.angle_y = y, o.angle_x = x;
  return o;
}

study::Orthotropy like_isotropic(double young, double poisson) {
  const double shear = young / (2 * (1 + poisson));
  study::Orthotropy o;
  o.young_x = young, o.young_y = young, o.young_z = young;
  o.poisson_xy = poisson, o.poisson_yz = poisson, o.poisson_xz = poisson;
  o.shear_xy = shear, o.shear_yz = shear, o.shear_xz = shear;
  return o;
}

Voigt random_strain(Physics physics) {
  std::mt19937 engine(13);
  std::uniform_real_distribution<double> component(-1e-3, 1e-3);
  Voigt strain(strain_size(physics));
  for (auto& value : strain)
    value = component(engine);
  return strain;
}

/// The strain along n of a bar pulled along n by a unit stress.
double compliance_along(const Orthotropic& law, const Vector3d& n) {
  FullStress pull;
  pull << n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[1] * n[2], n[0] * n[2];
  return pull.dot(law.compliance * pull); // γ counts both shears
}

TEST(OrthotropicElasticity, HasAStressThatIsTheDerivativeOfItsEnergyAndATangentThatIsThatOfItsStress) {
  const auto law = make_orthotropic(turned(20, 0, 0), 0);
  for (const auto physics : all_physics) {
    const auto strain = random_strain(physics);
    const auto sigma = stress(law, physics, strain);
    EXPECT_LT((tangent(law, physics) * strain - sigma).norm(), 1e-13 * sigma.norm());
    constexpr double step = 1e-6;
    for (Eigen::Index i = 0; i < strain.size(); ++i) {
      Voigt above = strain, below = strain;
      above[i] += step;
      below[i] -= step;
      const double slope = (energy(law, physics, above) - energy(law, physics, below)) / (2 * step);
      EXPECT_NEAR(sigma[i], slope, 1e-8 * sigma.norm());
    }
  }
}

TEST(OrthotropicElasticity, HasASymmetricPositiveDefiniteTangent) {
  for (const auto physics : all_physics) {
    const bool solid = physics == Physics::solid;
    const Eigen::MatrixXd d =
        tangent(make_orthotropic(turned(20, solid ? 50 : 0, solid ? -70 : 0), 0), physics);
    EXPECT_EQ(d, d.transpose());
    EXPECT_TRUE(test::is_positive_definite(d));
  }
}

TEST(OrthotropicElasticity, WithIsotropicNumbersIsIsotropicWhateverTheAngles) {
  const LinearElastic isotropic_law{3.2e3, 0.37, 0};
  auto numbers = like_isotropic(isotropic_law.young, isotropic_law.poisson);
  numbers.angle_z = 33;
  for (const auto physics : all_physics) {
    numbers.angle_y = physics == Physics::solid ? -71 : 0;
    const auto law = make_orthotropic(numbers, 0);
    const Tangent expected = tangent(isotropic_law, physics);
    EXPECT_LT((tangent(law, physics) - expected).norm(), 1e-12 * expected.norm());
    const auto sigma = stress(isotropic_law, physics, random_strain(physics));
    const auto full = full_stress(isotropic_law, physics, sigma);
    EXPECT_LT((full_stress(law, physics, sigma) - full).norm(), 1e-12 * full.norm());
  }
}

/// 1/E_θ = cos⁴θ/E_x + sin⁴θ/E_y + (1/G_xy − 2ν_xy/E_x) sin²θ cos²θ (S. G. Lekhnitskii, Theory of Elasticity
/// of an Anisotropic Body, 1963).
TEST(OrthotropicElasticity, PullsABarAcrossItsFibresByTheOffAxisModulus) {
  const auto o = spruce();
  for (const double theta : {0., 15., 30., 45., 60., 90., 130.}) {
    const double c = std::cos(theta * degree), s = std::sin(theta * degree);
    const double expected = std::pow(c, 4) / o.young_x + std::pow(s, 4) / o.young_y +
                            (1 / o.shear_xy - 2 * o.poisson_xy / o.young_x) * s * s * c * c;
    const auto law = make_orthotropic(turned(theta), 0);
    EXPECT_NEAR(compliance_along(law, Vector3d::UnitX()), expected, 1e-12 * expected) << theta;
    const Eigen::Matrix3d sheet = tangent(law, Physics::plane_stress);
    EXPECT_NEAR(sheet.inverse()(0, 0), expected, 1e-12 * expected) << theta;
  }
}

/// E = 150, 10, ν = 0.3, G = 5 with axes at 30° and 45°: by the formula above, worked out by hand.
TEST(OrthotropicElasticity, OfASheetNeedsNothingOfTheThirdAxis) {
  study::Orthotropy o;
  o.young_x = 150, o.young_y = 10, o.poisson_xy = 0.3, o.shear_xy = 5;
  const auto modulus = [&](double angle) {
    o.angle_z = angle;
    const Eigen::Matrix3d d = tangent(make_orthotropic(o, 0), Physics::plane_stress);
    return 1 / d.inverse()(0, 0);
  };
  EXPECT_NEAR(modulus(30), 21.390374, 1e-6);
  EXPECT_NEAR(modulus(45), 13.215859, 1e-6);
}

/// Code_Aster's matrix from nautical angles (routine matrot) has x', y', z' as its rows:
/// x' = (cosβ cosα, cosβ sinα, −sinβ), z' = (sinγ sinα + cosγ sinβ cosα, cosγ sinβ sinα − sinγ cosα, cosγ
/// cosβ).
TEST(OrthotropicElasticity, HasAxesTurnedByNauticalAngles) {
  const double alpha = 25 * degree, beta = -40 * degree, gamma = 65 * degree;
  const auto numbers = turned(25, -40, 65);
  const Vector3d x(std::cos(beta) * std::cos(alpha), std::cos(beta) * std::sin(alpha), -std::sin(beta));
  const Vector3d z(std::sin(gamma) * std::sin(alpha) + std::cos(gamma) * std::sin(beta) * std::cos(alpha),
                   std::cos(gamma) * std::sin(beta) * std::sin(alpha) - std::sin(gamma) * std::cos(alpha),
                   std::cos(gamma) * std::cos(beta));
  const auto axes = axes_of(numbers);
  EXPECT_LT((axes.col(0) - x).norm(), 1e-15);
  EXPECT_LT((axes.col(2) - z).norm(), 1e-15);
  EXPECT_LT((axes.col(1) - z.cross(x)).norm(), 1e-15);
  const auto law = make_orthotropic(numbers, 0);
  EXPECT_NEAR(compliance_along(law, x), 1 / numbers.young_x, 1e-12 / numbers.young_x);
  EXPECT_NEAR(compliance_along(law, axes.col(1)), 1 / numbers.young_y, 1e-12 / numbers.young_y);
  EXPECT_NEAR(compliance_along(law, z), 1 / *numbers.young_z, 1e-12 / *numbers.young_z);
}

TEST(OrthotropicElasticity, ThinsAlongYByTheFirstRatioWhenPulledAlongX) {
  const auto o = spruce();
  const auto law = make_orthotropic(o, 0);
  const FullStress pull = FullStress::Unit(0);
  const FullStress strain = law.compliance * pull;
  EXPECT_NEAR(-strain[1] / strain[0], o.poisson_xy, 1e-12);
  EXPECT_NEAR(-strain[2] / strain[0], *o.poisson_xz, 1e-12);
  const FullStress across = law.compliance * FullStress::Unit(1);
  EXPECT_NEAR(-across[2] / across[1], *o.poisson_yz, 1e-12);
  EXPECT_NEAR(-across[0] / across[1], o.poisson_xy * o.young_y / o.young_x, 1e-12);
}

TEST(OrthotropicElasticity, OfPlaneStrainIsTheSolidWithoutThicknessStrain) {
  const auto law = make_orthotropic(turned(35), 0);
  const auto plane = random_strain(Physics::plane_strain);
  FullStress strain;
  strain << plane[0], plane[1], 0, plane[2], 0, 0;
  const FullStress expected = law.stiffness * strain;
  const auto full = full_stress(law, Physics::plane_strain, stress(law, Physics::plane_strain, plane));
  EXPECT_LT((full - expected).norm(), 1e-12 * expected.norm());
}

TEST(OrthotropicElasticity, OfPlaneStressIsTheSolidWithoutThicknessStress) {
  const auto law = make_orthotropic(turned(35), 0);
  const auto plane = random_strain(Physics::plane_stress);
  FullStress strain;
  strain << plane[0], plane[1], 0, plane[2], 0, 0;
  strain[2] = -law.stiffness.row(2).dot(strain) / law.stiffness(2, 2);
  const FullStress expected = law.stiffness * strain;
  const auto full = full_stress(law, Physics::plane_stress, stress(law, Physics::plane_stress, plane));
  EXPECT_LT((full - expected).norm(), 1e-12 * expected.norm());
}

TEST(OrthotropicElasticity, OfARingHasItsThirdAxisAlongTheHoop) {
  const auto law = make_orthotropic(turned(35), 0);
  const auto ring = random_strain(Physics::axisymmetric);
  FullStress strain;
  strain << ring[0], ring[1], ring[2], ring[3], 0, 0;
  const FullStress expected = law.stiffness * strain;
  EXPECT_LT((with_zeros(Physics::axisymmetric, stress(law, Physics::axisymmetric, ring)) - expected).norm(),
            1e-12 * expected.norm());
}

} // namespace
} // namespace rubato::material::orthotropic_test
