// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/impact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::verification {
namespace {

// The bars of V1, V2 and V10: E = 900, ρ = 1, length 10, section 1.
constexpr double wave_speed = 30;
constexpr double impedance = 30;
constexpr double crossing = 2 * 10 / wave_speed;
constexpr double speed = 10;
constexpr double kinetic_energy = 500;

/// Part of the contact at its beginning that pressure errors leave out.
constexpr double settling = 0.05;
/// A sphere's forces below this part of the largest are none.
constexpr double touch = 1e-6;

/// Stored energy less the work of the loads.
std::vector<double> own_energy(const results::Table& energy) {
  auto sum = column(energy, "kinetic");
  const auto add = [&](const char* name, double sign) {
    const auto values = column(energy, name);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += sign * values[i];
  };
  add("strain", 1);
  add("contact", 1);
  add("external_work", -1);
  return sum;
}

/// When the forces of a run are what they are: at the ends of steps, or in their middle where they are means.
std::vector<double> instants_of_forces(const CaseRun& run, const std::vector<double>& t) {
  auto instants = t;
  if (run.study.time.scheme == study::SchemeKind::moreau_jean)
    for (std::size_t i = 0; i < t.size(); ++i)
      instants[i] -= (t[i] - (i > 0 ? t[i - 1] : run.study.time.begin)) / 2;
  return instants;
}

/// Where the line between two points crosses a height.
double crossing_of(double height, double x0, double y0, double x1, double y1) {
  return x0 + (x1 - x0) * (height - y0) / (y1 - y0);
}

} // namespace

ImpactTheory bar_on_wall() {
  return {0.5, 0.5 + crossing, [](double) { return impedance * speed; }, kinetic_energy};
}

ImpactTheory dropped_bar() {
  constexpr double gravity = 10;
  return {1, 1 + crossing, [](double t) { return impedance * (speed + gravity * (t - 1)); }, kinetic_energy};
}

ImpactTheory rod_on_rod() {
  return {0.1, 0.1 + crossing, [](double) { return impedance * speed / 2; }, kinetic_energy};
}

Impact measure_impact(const CaseRun& run, const std::string& zone, const ImpactTheory& theory) {
  const auto& table = run.resultants.at(zone);
  const auto t = column(table, "t");
  const auto force = column(table, "normal");
  const auto at = instants_of_forces(run, t);
  const double first = theory.force(theory.begin);
  const double last = theory.force(theory.end);
  const double from = theory.begin + settling * (theory.end - theory.begin);
  Impact impact;
  double squares = 0;
  int count = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    impact.impulse += force[i] * (t[i] - (i > 0 ? t[i - 1] : run.study.time.begin));
    impact.largest_force = std::max(impact.largest_force, force[i]);
    if (impact.begin == 0 && i > 0 && force[i] > first / 2)
      impact.begin = crossing_of(first / 2, at[i - 1], force[i - 1], at[i], force[i]);
    if (i + 1 < t.size() && force[i] > last / 2)
      impact.end = crossing_of(last / 2, at[i], force[i], at[i + 1], force[i + 1]);
    if (at[i] >= from && at[i] < theory.end) {
      squares += std::pow((force[i] - theory.force(at[i])) / first, 2);
      ++count;
    }
  }
  impact.pressure_error = std::sqrt(squares / count);
  const auto energy = own_energy(run.energy);
  for (const double value : energy)
    impact.energy_error = std::max(impact.energy_error, std::abs(value - energy.front()) / theory.energy);
  return impact;
}

SphereImpact hertz_impact(double radius, double young, double poisson, double density, double velocity) {
  const double mass = 4.0 / 3.0 * std::numbers::pi * std::pow(radius, 3) * density;
  const double modulus = young / (1 - poisson * poisson);
  const double approach =
      std::pow(15 * mass * velocity * velocity / (16 * modulus * std::sqrt(radius)), 2.0 / 5.0);
  // 2 ∫₀¹ dx/√(1 − x^{5/2})
  const double crossing_integral = 2 * std::sqrt(std::numbers::pi) * std::tgamma(1.4) / std::tgamma(0.9);
  return {4.0 / 3.0 * modulus * std::sqrt(radius) * std::pow(approach, 1.5), approach,
          crossing_integral * approach / velocity};
}

SphereImpact measure_sphere(const CaseRun& run) {
  const auto& table = run.resultants.at("wall");
  const auto t = column(table, "t");
  const auto force = column(table, "normal");
  SphereImpact impact;
  impact.force = *std::ranges::max_element(force);
  for (std::size_t i = 0; i < t.size(); ++i)
    if (force[i] > touch * impact.force)
      impact.duration += t[i] - (i > 0 ? t[i - 1] : run.study.time.begin);
  const auto height = column(run.probes, "centre.y");
  impact.approach = -*std::ranges::min_element(height);
  return impact;
}

} // namespace rubato::verification
