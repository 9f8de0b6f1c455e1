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

/// p/p₀ of CalculiX' curve at c₀.
constexpr double left_at_clearance = 0.01;

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

// ---- Abaqus' curve

double abaqus_pressure(double gap, const Numbers& numbers) {
  const double x = depth_of(gap, numbers.clearance);
  return numbers.pressure / norm * x * std::expm1(x);
}

double abaqus_stiffness(double gap, const Numbers& numbers) {
  const double x = depth_of(gap, numbers.clearance);
  return numbers.pressure / (norm * numbers.clearance) * (std::expm1(x) + x * std::exp(x));
}

/// Newton's method on the convex x (eˣ − 1) = y descends from any bound above: x² and eˣ/e − 1 are below it.
double abaqus_gap_of(double pressure, const Numbers& numbers) {
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

double abaqus_energy_length(double gap, const Numbers& numbers) {
  const double clearance = numbers.clearance;
  const double x = depth_of(gap, clearance);
  if (x < series_end)
    return clearance * series_of_energy(x);
  const double decay = std::exp(-x);
  return clearance * ((x - 1) + (1 - x * x / 2) * decay) / (-x * std::expm1(-x));
}

// ---- CalculiX' curve

/// β
double growth(const Numbers& numbers) {
  return -std::log(left_at_clearance) / numbers.clearance;
}

double calculix_pressure(double gap, const Numbers& numbers) {
  const double beta = growth(numbers), beyond = gap - numbers.clearance;
  if (beyond < 0)
    return numbers.pressure * std::exp(-beta * gap);
  return gap < reach(numbers) ? numbers.pressure * left_at_clearance * (1 - beta * beyond) : 0;
}

double calculix_stiffness(double gap, const Numbers& numbers) {
  if (gap >= reach(numbers))
    return 0;
  return growth(numbers) * calculix_pressure(std::min(gap, numbers.clearance), numbers);
}

double calculix_gap_of(double pressure, const Numbers& numbers) {
  const double share = pressure / numbers.pressure;
  if (share >= left_at_clearance)
    return -std::log(share) / growth(numbers);
  return numbers.clearance + (1 - share / left_at_clearance) / growth(numbers);
}

double calculix_energy_length(double gap, const Numbers& numbers) {
  if (gap >= numbers.clearance)
    return 0.5 * std::max(0.0, reach(numbers) - gap);
  const double share = std::exp(-growth(numbers) * gap);
  return (1 - 0.5 * left_at_clearance / share) / growth(numbers);
}

bool is_abaqus(const Numbers& numbers) {
  return numbers.curve == study::ExponentialCurve::abaqus;
}

} // namespace

Numbers numbers_of(const study::ContactZone& zone) {
  return {
      .pressure = zone.pressure.value_or(0), .clearance = zone.clearance.value_or(0), .curve = zone.curve};
}

double reach(const Numbers& numbers) {
  return is_abaqus(numbers) ? numbers.clearance : numbers.clearance + 1 / growth(numbers);
}

double pressure(double gap, const Numbers& numbers) {
  return is_abaqus(numbers) ? abaqus_pressure(gap, numbers) : calculix_pressure(gap, numbers);
}

double stiffness(double gap, const Numbers& numbers) {
  return is_abaqus(numbers) ? abaqus_stiffness(gap, numbers) : calculix_stiffness(gap, numbers);
}

double gap_of(double pressure, const Numbers& numbers) {
  return is_abaqus(numbers) ? abaqus_gap_of(pressure, numbers) : calculix_gap_of(pressure, numbers);
}

double energy_length(double gap, const Numbers& numbers) {
  return is_abaqus(numbers) ? abaqus_energy_length(gap, numbers) : calculix_energy_length(gap, numbers);
}

} // namespace rubato::contact::exponential
