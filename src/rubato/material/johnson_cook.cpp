// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/johnson_cook.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::material {
namespace {

/// A + B p^n, with an infinite slope at p = 0 where n < 1.
Yield at_reference_rate(const JohnsonCook& kind, double p) {
  if (kind.factor == 0)
    return {kind.yield_stress, 0};
  if (p > 0) {
    const double power = kind.factor * std::pow(p, kind.exponent);
    return {kind.yield_stress + power, kind.exponent * power / p};
  }
  const double steep = std::numeric_limits<double>::infinity();
  const double slope = kind.exponent > 1 ? 0 : kind.exponent < 1 ? steep : kind.factor;
  return {kind.yield_stress, slope};
}

} // namespace

double johnson_cook_softening(double temperature, double room, double melting, double exponent) {
  const double relative = std::clamp((temperature - room) / (melting - room), 0.0, 1.0);
  return 1 - std::pow(relative, exponent);
}

Yield yield(const JohnsonCook& kind, double start, double growth, const StepInfo& step) {
  const auto [stress, slope] = at_reference_rate(kind, start + growth);
  const double at_reference = kind.reference_rate * step.length;
  if (kind.rate_factor == 0 || !(at_reference > 0) || growth <= at_reference)
    return {kind.softening * stress, kind.softening * slope};
  const double faster = 1 + kind.rate_factor * std::log(growth / at_reference);
  return {kind.softening * stress * faster,
          kind.softening * (slope * faster + stress * kind.rate_factor / growth)};
}

} // namespace rubato::material
