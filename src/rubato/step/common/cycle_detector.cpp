// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/cycle_detector.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

/// Relative difference of forces that are the same.
constexpr double rounding = 1e-9;

constexpr int most_cycles = 3;

} // namespace

bool CycleDetector::has_met(const ContactIterate& iterate, double size_of_forces) {
  const bool known = std::ranges::any_of(met_, [&](const Met& met) {
    return std::abs(met.size - size_of_forces) <= rounding * size_of_forces && met.status == iterate.status;
  });
  if (!known)
    met_.push_back({iterate.status, size_of_forces});
  return known;
}

std::optional<double> CycleDetector::part_of_next(const ContactIterate& iterate, double size_of_forces) {
  if (!has_met(iterate, size_of_forces))
    return 1.0;
  if (++cycles_ > most_cycles)
    return std::nullopt;
  met_.clear();
  return 0.5;
}

} // namespace rubato::step
