// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/sliding.hpp"

#include <cmath>
#include <numbers>

namespace rubato::verification {
namespace {

/// Slower than this part of the largest speed is at rest.
constexpr double at_rest = 1e-3;

} // namespace

double incline_acceleration(double friction) {
  constexpr double gravity = 9.81;
  return gravity * (0.5 - friction * std::sqrt(3.0) / 2);
}

double measured_acceleration(const CaseRun& run) {
  const auto t = column(run.probes, "t");
  const auto v = column(run.probes, "speed.x");
  const auto middle = t.size() / 2;
  return (v.back() - v[middle]) / (t.back() - t[middle]);
}

SliderTheory slider_theory() {
  constexpr double mass = 1, spring = 1e4, weight = 10, friction = 0.1, start = 0.85e-3;
  constexpr double reach = friction * weight / spring;
  const double half_swing = std::numbers::pi / std::sqrt(spring / mass);
  SliderTheory theory;
  double x = start;
  while (std::abs(x) > reach) {
    x = (x > 0 ? 2 : -2) * reach - x;
    theory.turning_points.push_back(x);
    theory.stop += half_swing;
  }
  return theory;
}

SliderTheory measured_slider(const CaseRun& run) {
  const auto t = column(run.probes, "t");
  const auto x = column(run.probes, "mark.x");
  const auto v = column(run.probes, "speed.x");
  double fastest = 0;
  for (const double speed : v)
    fastest = std::max(fastest, std::abs(speed));
  SliderTheory found;
  for (std::size_t i = 1; i < t.size(); ++i)
    if (std::abs(v[i]) > at_rest * fastest)
      found.stop = t[i];
  // The last turning point is where it stays.
  for (std::size_t i = 2; t[i] < found.stop; ++i)
    if (v[i - 1] * v[i] < 0)
      found.turning_points.push_back(std::abs(x[i]) > std::abs(x[i - 1]) ? x[i] : x[i - 1]);
  found.turning_points.push_back(x.back());
  return found;
}

} // namespace rubato::verification
