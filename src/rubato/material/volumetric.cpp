// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/volumetric.hpp"

#include <cmath>

namespace rubato::material {

VolumeEnergy volume_energy(Volumetric kind, double bulk, double square) {
  if (kind == Volumetric::quadratic) {
    const double j = std::sqrt(1 + square);
    const double change = square / (1 + j); // J − 1
    return {0.5 * bulk * change * change, bulk * j * change, bulk * j * (2 * j - 1)};
  }
  return {0.25 * bulk * less_logarithm(square), 0.5 * bulk * square, bulk * (1 + square)};
}

double less_logarithm(double x) {
  constexpr double small = 0.05;
  if (std::abs(x) > small)
    return x - std::log1p(x);
  double sum = 0;
  double power = x;
  for (int k = 2; k < 14; ++k) { // 0.05^12/14 < 1e-16
    power *= -x;
    sum -= power / k;
  }
  return sum;
}

} // namespace rubato::material
