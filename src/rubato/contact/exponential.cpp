// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/exponential.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::contact::exponential {
namespace {

/// p at x = 1 is p₀.
constexpr double norm = std::numbers::e - 1;
/// Below it W/p is summed as a series: its closed form subtracts terms of order one from each other.
constexpr double series_end = 1;
/// Terms after that one are rounding at series_end.
constexpr int last_term = 20;
constexpr int most_iterations = 50;
/// Relative change of x that ends the iteration: Newton's method squares it.
constexpr double settled = 1e-9;

double depth_of(double gap, double clearance) {
  return std::max(0.0, 1 - gap / clearance);
}

/// (x − 1) eˣ + 1 − x²/2 over x (eˣ − 1), both as series.
double series_of_energy(double x) {
  double energy = 0;
  double pressure = 0;
  double power = 1; // xⁿ⁻²/n!
  for (int n = 2; n <= last_term; ++n) {
    power *= n == 2 ? 0.5 : x / n;
    energy += n == 2 ? 0 : (n - 1) * power;
    pressure += n * power;
  }
  return energy / pressure;
}

} // namespace

double pressure(double gap, const Numbers& numbers) {
  const double x = depth_of(gap, numbers.clearance);
  return numbers.pressure / norm * x * std::expm1(x);
}

double stiffness(double gap, const Numbers& numbers) {
  const double x = depth_of(gap, numbers.clearance);
  return numbers.pressure / (norm * numbers.clearance) * (std::expm1(x) + x * std::exp(x));
}

/// Newton's method on the convex x (eˣ − 1) = y descends from any bound above: x² and eˣ/e − 1 are below it.
double gap_of(double pressure, const Numbers& numbers) {
  const double y = pressure * norm / numbers.pressure;
  double x = std::min(std::sqrt(y), 1 + std::log1p(y));
  for (int i = 0; i < most_iterations; ++i) {
    const double change = (x * std::expm1(x) - y) / (std::expm1(x) + x * std::exp(x));
    x -= change;
    if (std::abs(change) <= settled * x)
      break;
  }
  return numbers.clearance * (1 - x);
}

double energy_length(double gap, double clearance) {
  const double x = depth_of(gap, clearance);
  if (x < series_end)
    return clearance * series_of_energy(x);
  const double decay = std::exp(-x);
  return clearance * ((x - 1) + (1 - x * x / 2) * decay) / (-x * std::expm1(-x));
}

} // namespace rubato::contact::exponential
