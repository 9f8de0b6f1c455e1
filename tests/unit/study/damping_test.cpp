// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/damping.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace rubato::study::damping_test {
namespace {

double ratio_at(const RayleighCoefficients& coefficients, double frequency) {
  const double omega = 2 * std::numbers::pi * frequency;
  return coefficients.mass / (2 * omega) + coefficients.stiffness * omega / 2;
}

TEST(Damping, HasItsRatiosAtItsFrequencies) {
  for (const auto& damping : {DampingRatios{{0.01, 0.02}, {50, 400}}, DampingRatios{{0.02, 0.01}, {400, 50}},
                              DampingRatios{{0.05, 0.05}, {1e-3, 1e5}}}) {
    Material material;
    material.damping = damping;
    const auto coefficients = rayleigh_coefficients(material);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(ratio_at(coefficients, damping.at[i]), damping.ratio[i], 1e-14);
    EXPECT_GE(coefficients.stiffness, 0);
    EXPECT_GE(coefficients.mass, 0);
  }
}

TEST(Damping, IsWhatTheMaterialSaysWithoutRatios) {
  Material material;
  material.rayleigh_stiffness = 1e-3;
  material.rayleigh_mass = 2;
  const auto [stiffness, mass] = rayleigh_coefficients(material);
  EXPECT_EQ(stiffness, 1e-3);
  EXPECT_EQ(mass, 2);
}

/// At the bounds one of the coefficients is 0.
TEST(Damping, BoundsTheRatioAtTheHigherFrequency) {
  Material material;
  material.damping = DampingRatios{{0, 0.02}, {80, 20}};
  auto& ratio = material.damping->ratio[0];
  ratio = least_ratio_at_higher_frequency(*material.damping);
  EXPECT_DOUBLE_EQ(ratio, 0.005);
  EXPECT_NEAR(rayleigh_coefficients(material).stiffness, 0, 1e-18);
  ratio = largest_ratio_at_higher_frequency(*material.damping);
  EXPECT_DOUBLE_EQ(ratio, 0.08);
  EXPECT_NEAR(rayleigh_coefficients(material).mass, 0, 1e-14);
}

} // namespace
} // namespace rubato::study::damping_test
