// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/yeoh.hpp"

#include <gtest/gtest.h>

#include "support/point_path.hpp"

namespace rubato::material::yeoh_test {
namespace {

using test::PointPath;
using test::random_six;

TEST(Yeoh, WithoutItsHigherTermsIsNeoHookean) {
  std::mt19937 engine(1);
  const auto strain = random_six(engine, 0.2);
  PointPath yeoh(Yeoh{0.5, 0, 0, 20});
  PointPath neo(MooneyRivlin{0.5, 0, 20});
  ASSERT_TRUE(yeoh.to_strain(strain) && neo.to_strain(strain));
  EXPECT_EQ(yeoh.response().stress, neo.response().stress);
  EXPECT_EQ(yeoh.response().tangent, neo.response().tangent);
}

TEST(Yeoh, HasTheDerivativeOfItsEnergyAsStress) {
  std::mt19937 engine(2);
  for (int i = 0; i < 10; ++i) {
    const auto strain = random_six(engine, 0.2);
    PointPath path(Yeoh{0.5, -0.05, 0.02, 20});
    const auto expected = test::stress_by_differences(path, strain, 2e-4);
    ASSERT_TRUE(path.to_strain(strain));
    EXPECT_LT((path.response().stress - expected).norm(), 1e-9 * expected.norm());
  }
}

/// Incompressible tension: P = 2 (λ − λ⁻²) W', W' = c10 + 2 c20 (I₁ − 3) + 3 c30 (I₁ − 3)².
TEST(Yeoh, StiffensInTensionAsItsClosedForm) {
  const double c10 = 0.5, c20 = -0.05, c30 = 0.02;
  for (const double stretch : {0.5, 0.9, 1.1, 2.0, 3.0}) {
    const double x = stretch * stretch + 2 / stretch - 3;
    const double expected = 2 * (stretch - 1 / (stretch * stretch)) * (c10 + 2 * c20 * x + 3 * c30 * x * x);
    const double found = test::nominal_stress(Yeoh{c10, c20, c30, 1e7}, stretch, false);
    EXPECT_NEAR(found, expected, 1e-5 * std::abs(expected)) << stretch;
  }
}

} // namespace
} // namespace rubato::material::yeoh_test
