// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bounds of numbers, and how messages name them.
#pragma once

#include <limits>
#include <string>

namespace rubato::study {

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_allowed = true;
  bool high_allowed = true;
  /// Never of a number that is not finite.
  bool contains(double value) const;
};

constexpr Range above(double low) {
  return {.low = low, .low_allowed = false};
}
constexpr Range at_least(double low) {
  return {.low = low};
}
constexpr Range at_most(double high) {
  return {.high = high};
}
constexpr Range from_to(double low, double high) {
  return {low, high};
}
constexpr Range between(double low, double high) {
  return {low, high, false, false};
}

/// " > 0", " from 0 to 1", " between 0 and 1"; empty without bounds.
std::string bounds_text(const Range& range);

} // namespace rubato::study
