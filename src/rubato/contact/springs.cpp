// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/springs.hpp"

#include "rubato/study/contact_methods.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::contact {
namespace {

const study::FrictionMethodEntry& friction_of(const Zone& zone) {
  return study::entry_of(zone.settings.friction_method);
}

} // namespace

bool closes_gaps(const Zone& zone) {
  return study::entry_of(zone.settings.method).exact;
}

bool rubs_by_springs(const Zone& zone) {
  return zone.settings.friction > 0 && !friction_of(zone).exact;
}

bool has_augmentation(const Zone& zone) {
  return closes_gaps(zone) || (zone.settings.friction > 0 && friction_of(zone).exact);
}

double penetration_compliance(const Zone& zone, const ZoneCoefficients& coefficients, std::size_t point) {
  return closes_gaps(zone) ? 0.0 : 1 / (coefficients.normal[point] * zone.points[point].weight);
}

double spring_stiffness(const Zone& zone, const ZoneCoefficients& coefficients, std::size_t point) {
  double stiffness = 0;
  if (!closes_gaps(zone))
    stiffness = std::abs(zone.points[point].weight) * coefficients.normal[point];
  if (zone.settings.friction > 0 && friction_of(zone).nodal)
    stiffness = std::max(stiffness, coefficients.tangential[point]);
  return stiffness;
}

double rest_gap(const Zone& zone, const PointOutcome& outcome) {
  return closes_gaps(zone) ? outcome.gap : 0.0;
}

double stored_energy(const Zone& zone, const ZoneState& state) {
  double sum = 0;
  for (const auto& outcome : state.outcomes)
    if (outcome.gap < rest_gap(zone, outcome))
      sum -= 0.5 * outcome.gap * outcome.normal.norm();
  return sum;
}

void scale_augmentations(const Zone& zone, double normal, double tangential, ZoneCoefficients& coefficients) {
  if (closes_gaps(zone))
    for (auto& value : coefficients.normal)
      value *= normal;
  if (friction_of(zone).exact)
    for (auto& value : coefficients.tangential)
      value *= tangential;
}

void limit_augmentations(const Zone& zone, double most, ZoneCoefficients& coefficients) {
  if (!closes_gaps(zone) || zone.settings.normal_coefficient)
    return;
  for (std::size_t i = 0; i < zone.points.size(); ++i)
    coefficients.normal[i] = std::min(coefficients.normal[i], most / std::abs(zone.points[i].weight));
}

void keep_springs(const Zone& zone, const std::function<ZoneCoefficients()>& make,
                  ZoneCoefficients& coefficients) {
  if (!closes_gaps(zone))
    coefficients = make();
  else if (friction_of(zone).nodal)
    coefficients.tangential = make().tangential;
}

} // namespace rubato::contact
