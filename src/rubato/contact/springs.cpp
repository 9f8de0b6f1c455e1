// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/springs.hpp"

#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::contact {
namespace {

const Coefficient& normal_of(const Zone& zone) {
  return *normal_law(zone.settings.method).coefficient;
}

const Coefficient& tangential_of(const Zone& zone) {
  return *friction_law(zone.settings.friction_method).role;
}

/// Coefficients of friction mean nothing without any.
bool has_friction(const Zone& zone) {
  return zone.settings.friction > 0;
}

} // namespace

bool closes_gaps(const Zone& zone) {
  return !normal_of(zone).is_spring;
}

bool has_augmentation(const Zone& zone) {
  return closes_gaps(zone) || (has_friction(zone) && !tangential_of(zone).is_spring);
}

std::vector<GivenSpring> given_springs(const Zone& zone) {
  std::vector<GivenSpring> given;
  const auto add = [&](const Coefficient& coefficient, std::string_view key, std::optional<double> value) {
    if (coefficient.is_spring && value)
      given.push_back({key, *value});
  };
  if (has_friction(zone))
    add(tangential_of(zone), "tangential", zone.settings.tangential_coefficient);
  add(normal_of(zone), "normal", zone.settings.normal_coefficient);
  return given;
}

Penetration penetration(const ZoneLaw& law, std::size_t point, double weight, double force, double gap,
                        double exact) {
  const auto& zone = *law.zone;
  const auto line =
      normal_law(zone.settings.method).line({.gap = gap, .pressure = force / weight}, law.of_point(point));
  return {.rest_gap = line.rest_gap,
          .compliance = normal_of(zone).compliance(line.stiffness * weight, exact)};
}

std::vector<double> spring_stiffness(const ZoneLaw& law, std::span<const PointEvaluation> points) {
  const auto& zone = *law.zone;
  const auto& normal = normal_law(zone.settings.method);
  std::vector<double> stiffness(points.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double tangential =
        has_friction(zone) ? tangential_of(zone).stiffness(law.coefficients->tangential[i]) : 0.0;
    stiffness[i] = std::max(std::abs(weight_of(zone.points[i], points[i])) *
                                normal.stiffness(points[i].variables, law.of_point(i)),
                            tangential);
  }
  return stiffness;
}

double reach(const Zone& zone) {
  return normal_law(zone.settings.method).reach(zone.settings);
}

double spring_depth(const Zone& zone, const PointOutcome& outcome) {
  return 2 * normal_law(zone.settings.method).energy_length(outcome.gap, zone.settings);
}

double stored_energy(const Zone& zone, const ZoneState& state) {
  double sum = 0;
  for (const auto& outcome : state.outcomes)
    sum += 0.5 * spring_depth(zone, outcome) * length_of(outcome.normal);
  return sum;
}

void scale_augmentations(const Zone& zone, double normal, double tangential, ZoneCoefficients& coefficients) {
  for (auto& value : coefficients.normal)
    value = normal_of(zone).scaled(value, normal);
  for (auto& value : coefficients.tangential)
    value = tangential_of(zone).scaled(value, tangential);
}

void limit_augmentations(const Zone& zone, double most, ZoneCoefficients& coefficients) {
  if (zone.settings.normal_coefficient)
    return;
  for (std::size_t i = 0; i < zone.points.size(); ++i)
    coefficients.normal[i] =
        normal_of(zone).limited(coefficients.normal[i], most / std::abs(zone.points[i].weight));
}

void keep_springs(const Zone& zone, const ZoneCoefficients& usual, ZoneCoefficients& coefficients) {
  const auto keep = [](const Coefficient& coefficient, const std::vector<double>& from,
                       std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = coefficient.at_length(values[i], from[i]);
  };
  keep(normal_of(zone), usual.normal, coefficients.normal);
  keep(normal_of(zone), usual.resistance, coefficients.resistance);
  keep(tangential_of(zone), usual.tangential, coefficients.tangential);
}

} // namespace rubato::contact
