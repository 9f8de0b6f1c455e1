// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/volumetric.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace rubato::material::volumetric_test {
namespace {

TEST(Volumetric, HasTheDerivativesOfItsEnergyByTheLogarithmOfTheVolume) {
  const auto at = [](Volumetric kind, double logarithm) {
    return volume_energy(kind, 3, std::expm1(2 * logarithm));
  };
  constexpr double width = 1e-4;
  for (const auto kind : {Volumetric::logarithmic, Volumetric::quadratic})
    for (const double logarithm : {-1.0, -0.1, 0.01, 0.5}) {
      const auto low = at(kind, logarithm - width);
      const auto high = at(kind, logarithm + width);
      const auto mid = at(kind, logarithm);
      EXPECT_NEAR(mid.first, (high.energy - low.energy) / (2 * width), 1e-6);
      EXPECT_NEAR(mid.second, (high.first - low.first) / (2 * width), 1e-6);
    }
}

TEST(Volumetric, LosesNothingNearTheUndeformedVolume) {
  for (const auto kind : {Volumetric::logarithmic, Volumetric::quadratic})
    for (const double change : {1e-3, 1e-8, 1e-15}) { // of J
      const auto at = volume_energy(kind, 2, change * (2 + change));
      EXPECT_NEAR(at.energy / (change * change), 1, change);
      EXPECT_NEAR(at.first / (2 * change), 1, 2 * change + 1e-15);
    }
}

TEST(Volumetric, TheSeriesOfTheLogarithmMeetsItsClosedForm) {
  for (const double x : {0.05, -0.05})
    EXPECT_NEAR(less_logarithm(x * (1 - 1e-15)), less_logarithm(x * (1 + 1e-15)), 1e-17);
}

TEST(Volumetric, TheBulkModulusIsThatOfElasticity) {
  const double young = 210, poisson = 0.3;
  EXPECT_DOUBLE_EQ(bulk_modulus(young / (2 * (1 + poisson)), poisson), young / (3 * (1 - 2 * poisson)));
}

} // namespace
} // namespace rubato::material::volumetric_test
