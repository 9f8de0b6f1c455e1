// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/law.hpp"
#include "rubato/study/study.hpp"

#include <gtest/gtest.h>

#include "support/dense.hpp"
#include <random>

namespace rubato::material::law_test {
namespace {

using study::Physics;

const LinearElastic rubbery{3.2e3, 0.37, 0};
constexpr Physics all_physics[] = {Physics::solid, Physics::plane_stress, Physics::plane_strain,
                                   Physics::axisymmetric};

Voigt voigt(std::initializer_list<double> values) {
  Voigt v(static_cast<Eigen::Index>(values.size()));
  std::ranges::copy(values, v.begin());
  return v;
}

Voigt random_strain(Physics physics) {
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> component(-1e-3, 1e-3);
  Voigt strain(strain_size(physics));
  for (auto& value : strain)
    value = component(engine);
  return strain;
}

TEST(LinearElasticity, HasAStressThatIsTheDerivativeOfItsEnergy) {
  for (const auto physics : all_physics) {
    const auto strain = random_strain(physics);
    const auto sigma = stress(rubbery, physics, strain);
    constexpr double step = 1e-6;
    for (Eigen::Index i = 0; i < strain.size(); ++i) {
      Voigt above = strain, below = strain;
      above[i] += step;
      below[i] -= step;
      const double slope = (energy(rubbery, physics, above) - energy(rubbery, physics, below)) / (2 * step);
      EXPECT_NEAR(sigma[i], slope, 1e-8);
    }
  }
}

TEST(LinearElasticity, HasATangentThatIsTheDerivativeOfItsStress) {
  for (const auto physics : all_physics) {
    const auto strain = random_strain(physics);
    const Voigt product = tangent(rubbery, physics) * strain;
    EXPECT_LT((product - stress(rubbery, physics, strain)).norm(), 1e-13 * product.norm());
  }
}

TEST(LinearElasticity, HasASymmetricPositiveDefiniteTangent) {
  for (const auto physics : all_physics) {
    const Eigen::MatrixXd d = tangent(rubbery, physics);
    EXPECT_EQ(d, d.transpose());
    EXPECT_TRUE(test::is_positive_definite(d));
  }
}

TEST(LinearElasticity, PullsABarByYoungsModulusAndThinsItByPoissons) {
  const double e = rubbery.young, nu = rubbery.poisson, stretch = 1e-3;
  const auto solid = stress(rubbery, Physics::solid, voigt({stretch, -nu * stretch, -nu * stretch, 0, 0, 0}));
  EXPECT_LT((solid - voigt({e * stretch, 0, 0, 0, 0, 0})).norm(), 1e-12);
  const auto ring = stress(rubbery, Physics::axisymmetric, voigt({-nu * stretch, stretch, -nu * stretch, 0}));
  EXPECT_LT((ring - voigt({0, e * stretch, 0, 0})).norm(), 1e-12);
  const auto sheet = stress(rubbery, Physics::plane_stress, voigt({stretch, -nu * stretch, 0}));
  EXPECT_LT((sheet - voigt({e * stretch, 0, 0})).norm(), 1e-12);
}

TEST(LinearElasticity, ShearsByTheEngineeringAngle) {
  const double g = rubbery.young / (2 * (1 + rubbery.poisson));
  EXPECT_NEAR(stress(rubbery, Physics::plane_strain, voigt({0, 0, 1e-3}))[2], g * 1e-3, 1e-14);
  EXPECT_NEAR(stress(rubbery, Physics::solid, voigt({0, 0, 0, 0, 1e-3, 0}))[4], g * 1e-3, 1e-14);
}

TEST(LinearElasticity, FindsTheThicknessStressOfPlaneStrain) {
  const auto plane = voigt({1e-3, 4e-4, 2e-4});
  const auto expected = stress(rubbery, Physics::solid, voigt({1e-3, 4e-4, 0, 2e-4, 0, 0}));
  const auto full =
      full_stress(rubbery, Physics::plane_strain, stress(rubbery, Physics::plane_strain, plane));
  EXPECT_LT((full - expected).norm(), 1e-13 * expected.norm());
}

TEST(LinearElasticity, LeavesPlaneStressWithoutThicknessStress) {
  const auto full = full_stress(rubbery, Physics::plane_stress, voigt({3, 5, 7}));
  EXPECT_EQ(full, (FullStress() << 3, 5, 0, 7, 0, 0).finished());
}

TEST(VonMises, IsTheStressOfABarTheRootOfThreeOfShearAndNothingOfPressure) {
  EXPECT_DOUBLE_EQ(von_mises((FullStress() << 0, -5, 0, 0, 0, 0).finished()), 5);
  EXPECT_DOUBLE_EQ(von_mises((FullStress() << 0, 0, 0, 0, 2, 0).finished()), 2 * std::sqrt(3.));
  EXPECT_DOUBLE_EQ(von_mises((FullStress() << 4, 4, 4, 0, 0, 0).finished()), 0);
}

} // namespace
} // namespace rubato::material::law_test
