// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cmath>
#include <limits>
#include <optional>

namespace rubato::material {

struct ValueAndSlope {
  double value;
  double slope;
};

/// x > 0 with |f(x)| ≤ `tolerance`, or as near as doubles come, where f(0) > 0 and f falls below 0 for large
/// x: Newton's method from 0, kept in a bracket, which is halved where a step leaves it or gains little.
/// `upper` is doubled while f is positive there. Nothing where f has no such x or is not finite.
template <class F> std::optional<double> bracketed_root(const F& f, double upper, double tolerance) {
  constexpr int most_doublings = 60;
  constexpr int most_iterations = 200;
  double low = 0;
  double high = upper;
  for (int i = 0; f(high).value > 0; ++i, low = high, high *= 2)
    if (i == most_doublings || !std::isfinite(high))
      return std::nullopt;
  double x = low;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_iterations; ++i) {
    const auto [value, slope] = f(x);
    if (std::abs(value) <= tolerance)
      return x;
    if (!std::isfinite(value))
      return std::nullopt;
    (value > 0 ? low : high) = x;
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high)
      return middle;
    const double newton = x - value / slope;
    const bool gains =
        newton > low && newton < high && newton != x && std::abs(value) <= 0.5 * std::abs(before);
    before = value;
    x = gains ? newton : middle;
  }
  return std::nullopt;
}

} // namespace rubato::material
