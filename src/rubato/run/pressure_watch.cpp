// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/pressure_watch.hpp"

#include "rubato/contact/face_edges.hpp"
#include "rubato/contact/nodal_pressure.hpp"
#include "rubato/contact/springs.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace rubato::run {
namespace {

/// A point that the motion opens and closes stays open, or closed, for some steps.
constexpr double changes_limit = 8;
/// Of the largest pressure. Few nodes under a narrow peak make 0.15, rubber in quadratic cells without
/// averaged volume 0.65 to 0.83.
constexpr double oscillation_limit = 0.2;

bool is_exact(const contact::Zone& zone) {
  return contact::closes_gaps(zone) && !zone.settings.tie;
}

/// The neighbours of each slave node along edges of faces, mid-edge nodes between corners; a node inside a
/// face has the middle nodes of its edges.
std::vector<std::vector<int>> neighbours_of(const contact::Surface& surface) {
  std::vector<std::vector<int>> around(surface.nodes.size());
  const auto join = [&](int i, int j) {
    auto& of_i = around[static_cast<std::size_t>(i)];
    if (std::ranges::find(of_i, j) == of_i.end()) {
      of_i.push_back(j);
      around[static_cast<std::size_t>(j)].push_back(i);
    }
  };
  for (const auto& face : surface.faces)
    contact::for_each_edge(face.type, [&](const contact::LocalEdge& edge) {
      const auto at = [&](int node) { return face.positions[static_cast<std::size_t>(node)]; };
      if (edge.middle < 0)
        return join(at(edge.from), at(edge.to));
      join(at(edge.from), at(edge.middle));
      join(at(edge.middle), at(edge.to));
      if (contact::has_node_inside(face.type))
        join(at(edge.middle), face.position_span().back());
    });
  return around;
}

/// The pressure of each node above the mean of its neighbours, where the node lies inside the surface and all
/// of them are pressed; NaN of other nodes.
std::vector<double> bumps_of(const contact::Surface& surface, const std::vector<double>& pressure,
                             const std::vector<std::vector<int>>& around) {
  std::vector<double> bumps(pressure.size(), NAN);
  for (std::size_t i = 0; i < pressure.size(); ++i) {
    if (!(pressure[i] > 0) || surface.at_edge[i] != 0 || around[i].empty())
      continue;
    double sum = 0;
    const bool inner = std::ranges::all_of(around[i], [&](int j) {
      sum += pressure[static_cast<std::size_t>(j)];
      return pressure[static_cast<std::size_t>(j)] > 0;
    });
    if (inner)
      bumps[i] = pressure[i] - sum / static_cast<double>(around[i].size());
  }
  return bumps;
}

/// The amplitude of an oscillation at a node: the lesser of its bump and the mean bump of its neighbours,
/// where at least two of these have bumps and all have the other sign; else 0.
double amplitude_at(std::size_t node, const std::vector<double>& bumps,
                    const std::vector<std::vector<int>>& around) {
  double sum = 0;
  int count = 0;
  for (const int j : around[node]) {
    const double other = bumps[static_cast<std::size_t>(j)];
    if (std::isnan(other))
      continue;
    if (!(bumps[node] * other < 0))
      return 0;
    sum += std::abs(other);
    ++count;
  }
  return count < 2 ? 0 : std::min(std::abs(bumps[node]), sum / count);
}

} // namespace

PressureWatch::PressureWatch(const model::Model& model) : model_(model) {
  for (const auto& zone : model.zones) {
    const bool exact = is_exact(zone);
    any_exact_ = any_exact_ || exact;
    changes_.emplace_back(exact ? zone.points.size() : 0, std::uint16_t{0});
    around_.push_back(exact ? neighbours_of(zone.slave) : std::vector<std::vector<int>>());
  }
}

void PressureWatch::note(const step::State& before, const step::State& now) {
  for (std::size_t z = 0; z < changes_.size(); ++z)
    for (std::size_t i = 0; i < changes_[z].size(); ++i) {
      const bool touched = before.zones[z].status[i] != contact::Status::open;
      const bool touches = now.zones[z].status[i] != contact::Status::open;
      auto& changes = changes_[z][i];
      changes = touches != touched ? static_cast<std::uint16_t>(std::min(changes + 1, 0xffff)) : 0;
      if (changes > changing_.value)
        changing_ = {static_cast<double>(changes), now.t, z, model_.zones[z].points[i].nodes.front()};
    }
}

void PressureWatch::note_pressures(const step::State& now) {
  for (std::size_t z = 0; z < around_.size(); ++z) {
    if (around_[z].empty())
      continue;
    const auto& zone = model_.zones[z];
    const auto pressure = contact::nodal_pressure(zone, now.zones[z]);
    const double peak = *std::ranges::max_element(pressure);
    const auto bumps = bumps_of(zone.slave, pressure, around_[z]);
    for (std::size_t i = 0; i < bumps.size(); ++i)
      if (const double size = amplitude_at(i, bumps, around_[z]) / peak; size > oscillation_.value)
        oscillation_ = {size, now.t, z, zone.slave.nodes[i]};
  }
}

std::string PressureWatch::place_of(const Worst& worst) const {
  return worst.node < 0 ? ""
                        : fmt::format("contact.{} at node {}", model_.zones[worst.zone].settings.name,
                                      model::node_label(model_.mesh, worst.node));
}

std::vector<results::Plausibility> PressureWatch::checks() const {
  if (!any_exact_)
    return {};
  return {{"alternating_points", changing_.value, changes_limit, changing_.t, place_of(changing_),
           "the point opens and closes in so many steps in a row; expected a shorter step, or 'scheme: hht'"},
          {"pressure_oscillation", oscillation_.value, oscillation_limit, oscillation_.t,
           place_of(oscillation_),
           "pressures of neighbours lie above and below their means by this part of the peak; expected a "
           "finer slave, the other side as slave, or a formulation that keeps volume without locking"}};
}

} // namespace rubato::run
