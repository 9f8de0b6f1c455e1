// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/damping.hpp"

#include <algorithm>
#include <array>
#include <numbers>

namespace rubato::study {
namespace {

/// The ratio at the lower frequency.
double lower_ratio(const DampingRatios& damping) {
  return damping.ratio[damping.at[0] < damping.at[1] ? 0 : 1];
}

/// Of the frequencies, at least 1.
double quotient(const DampingRatios& damping) {
  const auto [low, high] = std::minmax(damping.at[0], damping.at[1]);
  return high / low;
}

} // namespace

RayleighCoefficients rayleigh_coefficients(const Material& material) {
  if (!material.damping)
    return {material.rayleigh_stiffness, material.rayleigh_mass};
  const auto& [ratio, at] = *material.damping;
  const std::array omega{2 * std::numbers::pi * at[0], 2 * std::numbers::pi * at[1]};
  const double difference = (omega[1] - omega[0]) * (omega[1] + omega[0]);
  return {2 * (ratio[1] * omega[1] - ratio[0] * omega[0]) / difference,
          2 * omega[0] * omega[1] * (ratio[0] * omega[1] - ratio[1] * omega[0]) / difference};
}

double least_ratio_at_higher_frequency(const DampingRatios& damping) {
  return lower_ratio(damping) / quotient(damping);
}

double largest_ratio_at_higher_frequency(const DampingRatios& damping) {
  return lower_ratio(damping) * quotient(damping);
}

} // namespace rubato::study
