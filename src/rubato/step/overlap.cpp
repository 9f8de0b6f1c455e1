// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/overlap.hpp"

#include "rubato/contact/discretisation.hpp"
#include "rubato/contact/springs.hpp"
#include "rubato/model/model.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::step {
namespace {

bool presses(const contact::ZoneState& zone, std::size_t point) {
  return point < zone.outcomes.size() && !zone.outcomes[point].normal.isZero(0);
}

/// Depths along two normals differ by no more than this factor, or the point has gone elsewhere.
constexpr double most_turned = 2;

double moved_out(const State& trial, std::size_t zone, std::size_t point) {
  return trial.moved_out[zone].empty() ? 0.0 : trial.moved_out[zone][point];
}

/// The way that the force of an overlap acts over, and what its spring keeps, both with half that force.
double closed_part(const contact::Zone& zone, double overlap, double moved_out,
                   const contact::PointOutcome& outcome) {
  return std::clamp(moved_out + contact::spring_depth(zone, outcome), 0.0, most_turned * overlap);
}

/// The way that a force that leaves acts over beyond what its spring gives back.
double opening(const contact::Zone& zone, const contact::PointOutcome& before,
               const contact::PointOutcome& now) {
  if (!std::isfinite(now.gap))
    return 0;
  return std::max(0.0, now.gap - (before.gap + contact::spring_depth(zone, before)));
}

} // namespace

Overlaps overlaps_of(const model::Model& model, const State& start) {
  const contact::Configuration configuration{&model.mesh,     &model.dofs, &start.motion.u,
                                             &start.motion.u, start.t,     start.t};
  Overlaps overlaps;
  bool any = false;
  for (std::size_t z = 0; z < start.zones.size(); ++z) {
    const auto& zone = model.zones[z];
    const auto points = contact::evaluate(zone, start.zones[z].multipliers, configuration);
    auto& depths = overlaps.emplace_back(points.size(), 0.0);
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!zone.points[i].excluded && !presses(start.zones[z], i))
        depths[i] = std::max(0.0, contact::reach(zone) - points[i].variables.gap);
    any = any || std::ranges::any_of(depths, [](double depth) { return depth > 0; });
  }
  return any ? overlaps : Overlaps();
}

double work_of_overlaps(const model::Model& model, const Overlaps& overlaps, const State& trial) {
  double work = 0;
  for (std::size_t z = 0; z < overlaps.size(); ++z)
    for (std::size_t i = 0; i < overlaps[z].size(); ++i)
      if (overlaps[z][i] > 0 && presses(trial.zones[z], i)) {
        const auto& outcome = trial.zones[z].outcomes[i];
        work += 0.5 * outcome.normal.norm() *
                closed_part(model.zones[z], overlaps[z][i], moved_out(trial, z, i), outcome);
      }
  return work;
}

double work_of_rebound(const model::Model& model, const Overlaps& overlaps, const State& committed,
                       const State& trial) {
  double work = 0;
  for (std::size_t z = 0; z < overlaps.size(); ++z)
    for (std::size_t i = 0; i < overlaps[z].size(); ++i)
      if (overlaps[z][i] > 0 && presses(committed.zones[z], i) && !presses(trial.zones[z], i))
        work += 0.5 * committed.zones[z].outcomes[i].normal.norm() *
                opening(model.zones[z], committed.zones[z].outcomes[i], trial.zones[z].outcomes[i]);
  return work;
}

} // namespace rubato::step
