// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/pressed_afar.hpp"

#include "rubato/contact/motion.hpp"
#include "rubato/contact/point_tree.hpp"
#include "rubato/contact/springs.hpp"
#include "rubato/model/model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::step {
namespace {

bool is_between_moving_surfaces(const contact::Zone& zone) {
  return zone.mortar && !zone.obstacle && !zone.meets_itself() && !zone.holds_geometry() &&
         contact::closes_gaps(zone);
}

/// A diagonal of a face is longer than its edges.
double faces_of_both(const contact::Zone& zone) {
  return zone.mortar->longest_face + std::numbers::sqrt2 * zone.master.longest_edge;
}

std::optional<Unmet> in_zone(const model::Model& model, int index, const State& state) {
  const auto& zone = model.zones[static_cast<std::size_t>(index)];
  const auto& outcomes = state.zones[static_cast<std::size_t>(index)].outcomes;
  if (std::ranges::none_of(outcomes, [](const auto& outcome) { return outcome.pressure > 0; }))
    return std::nullopt;
  const contact::Configuration now{&model.mesh,     &model.dofs, &state.motion.u,
                                   &state.motion.u, state.t,     state.t};
  const auto master = contact::positions_of(zone.master, now);
  const contact::PointTree tree(master);
  const double faces = faces_of_both(zone);
  std::optional<Unmet> farthest;
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (!(outcomes[i].pressure > 0))
      continue;
    const auto node = zone.slave.nodes[i];
    const double distance = std::sqrt(tree.nearest(now.position(node)).squared_distance);
    const double allowed =
        faces + std::abs(outcomes[i].gap) + std::abs(zone.offset.at(zone.points[i].place, state.t));
    if (distance > allowed && (!farthest || distance > farthest->value))
      farthest = {Criterion::distance, index, node, distance, allowed};
  }
  return farthest;
}

} // namespace

std::optional<Unmet> pressed_afar(const model::Model& model, const State& state) {
  std::optional<Unmet> farthest;
  for (std::size_t z = 0; z < model.zones.size(); ++z)
    if (is_between_moving_surfaces(model.zones[z]))
      if (const auto found = in_zone(model, static_cast<int>(z), state);
          found && (!farthest || found->value > farthest->value))
        farthest = found;
  return farthest;
}

} // namespace rubato::step
