// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/prony.hpp"

#include <gtest/gtest.h>

#include "support/point_path.hpp"

namespace rubato::material::prony_test {
namespace {

using test::PointPath;

constexpr double poisson = 0.3;
const Prony polymer{2 * (1 + poisson) * 1.0, poisson, {{2, 0.1}, {3, 1}}}; // G_∞ = 1

Strain6 sheared(double by) {
  return by * Strain6::Unit(3);
}

TEST(Prony, ARampOfShearIsExactInAnyNumberOfSteps) {
  double expected = 0.02; // G_∞ γ
  for (const auto& [shear, time] : polymer.terms)
    expected += shear * 0.02 * time * -std::expm1(-1 / time);
  EXPECT_NEAR(expected, 0.061927051930, 5e-13);
  for (const int steps : {1, 7, 1000}) {
    PointPath path(polymer);
    for (int i = 1; i <= steps; ++i)
      ASSERT_TRUE(path.to_strain(sheared(0.02 * i / steps), 1.0 / steps));
    EXPECT_NEAR(path.response().stress[3], expected, 1e-13) << steps;
  }
}

TEST(Prony, RelaxesFromTheSuddenToTheLongTermModulus) {
  PointPath path(polymer);
  ASSERT_TRUE(path.to_strain(sheared(0.01), 0)); // a step of no length
  EXPECT_NEAR(path.response().stress[3], 6 * 0.01, 1e-15);
  ASSERT_TRUE(path.to_strain(sheared(0.01), 0.5));
  EXPECT_NEAR(path.response().stress[3], 0.01 * (1 + 2 * std::exp(-5) + 3 * std::exp(-0.5)), 1e-15);
  ASSERT_TRUE(path.to_strain(sheared(0.01), 1e6));
  EXPECT_NEAR(path.response().stress[3], 0.01, 1e-15);
}

TEST(Prony, DissipatesWhatASuddenStrainStoredInItsTerms) {
  PointPath path(polymer);
  ASSERT_TRUE(path.to_strain(sheared(0.01), 0));
  EXPECT_NEAR(path.response().stored, 0.5 * 6 * 1e-4, 1e-18);
  for (int i = 0; i < 4000; ++i)
    ASSERT_TRUE(path.to_strain(sheared(0.01), 5e-3));
  EXPECT_NEAR(path.lost.viscous, 0.5 * 5 * 1e-4, 1e-11);
}

TEST(Prony, WithoutTermsIsElastic) {
  PointPath path(Prony{200e3, 0.3, {}});
  std::mt19937 engine(1);
  const auto strain = test::random_six(engine, 0.01);
  ASSERT_TRUE(path.to_strain(strain));
  const Stress6 expected = make_elastic_point(200e3, 0.3).stiffness * strain;
  EXPECT_LT((path.response().stress - expected).norm(), 1e-15 * expected.norm());
}

} // namespace
} // namespace rubato::material::prony_test
