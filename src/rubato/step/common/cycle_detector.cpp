// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/cycle_detector.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

/// Relative difference of forces that are the same: iterations may close in on a cycle.
constexpr double same_forces = 1e-6;

constexpr int most_cycles = 3;

/// Of the corrections of the first cycle; of those of the second its square, and so on.
constexpr double damped = 0.4;

} // namespace

std::optional<int> CycleDetector::length_of_cycle(const ContactIterate& iterate, double size_of_forces) {
  const auto same = std::ranges::find_if(met_, [&](const Met& met) {
    return std::abs(met.size - size_of_forces) <= same_forces * size_of_forces &&
           met.status == iterate.status;
  });
  if (same != met_.end())
    return static_cast<int>(met_.end() - same);
  met_.push_back({iterate.status, size_of_forces});
  return std::nullopt;
}

std::optional<double> CycleDetector::part_of_next(const ContactIterate& iterate, double size_of_forces) {
  if (damped_left_ > 0) {
    --damped_left_;
    return std::pow(damped, cycles_);
  }
  const auto length = length_of_cycle(iterate, size_of_forces);
  if (!length)
    return 1.0;
  if (++cycles_ > most_cycles)
    return std::nullopt;
  damped_left_ = *length - 1;
  met_.clear();
  return std::pow(damped, cycles_);
}

} // namespace rubato::step
