// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/nodal_pressure.hpp"

#include <cmath>
#include <cstddef>

namespace rubato::contact {
namespace {

constexpr int pressure_variable = 0;

/// Forces of nodal methods are no pressures.
bool has_pressure_multipliers(const Zone& zone) {
  const auto variables = zone.multiplier_variables();
  return !variables.empty() && variables.front() == pressure_variable && !zone.unit_weights;
}

std::vector<double> multipliers(const Zone& zone, const ZoneState& state) {
  std::vector<double> pressure(zone.slave.nodes.size());
  for (std::size_t i = 0; i < pressure.size(); ++i)
    pressure[i] = state.multipliers[static_cast<Eigen::Index>(i) * zone.multipliers_per_node()];
  for (std::size_t i = 0; i < zone.points.size(); ++i)
    if (zone.points[i].axis_pressure || zone.mortar)
      pressure[static_cast<std::size_t>(zone.points[i].node_position)] = state.outcomes[i].pressure;
  return pressure;
}

std::vector<double> means(const Zone& zone, const ZoneState& state) {
  std::vector<double> pressure(zone.slave.nodes.size(), 0.0);
  std::vector<double> share(pressure.size(), 0.0);
  for (std::size_t i = 0; i < zone.points.size(); ++i) {
    const auto& point = zone.points[i];
    for (std::size_t j = 0; j < point.multipliers.size(); ++j) {
      const auto node = static_cast<std::size_t>(point.multipliers[j]);
      const double part = point.area * std::abs(point.multiplier_shape[j]);
      pressure[node] += part * state.outcomes[i].pressure;
      share[node] += part;
    }
  }
  for (std::size_t i = 0; i < pressure.size(); ++i)
    if (share[i] > 0)
      pressure[i] /= share[i];
  return pressure;
}

} // namespace

std::vector<double> nodal_pressure(const Zone& zone, const ZoneState& state) {
  return has_pressure_multipliers(zone) ? multipliers(zone, state) : means(zone, state);
}

} // namespace rubato::contact
