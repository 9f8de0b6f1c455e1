// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/overlap_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

namespace rubato::run {
namespace {

/// In lengths of the slave's longest edge: depth that is seen as new, and the depth before.
constexpr double deep = 1, shallow = 0.5;

struct Deepest {
  std::size_t point = 0;
  double depth = 0;
};

std::optional<Deepest> newly_deep(const contact::Zone& zone, const contact::ZoneState& before,
                                  const contact::ZoneState& now) {
  Deepest deepest;
  for (std::size_t i = 0; i < now.outcomes.size(); ++i)
    if (before.outcomes[i].gap > -shallow * zone.slave.longest_edge && -now.outcomes[i].gap > deepest.depth)
      deepest = {i, -now.outcomes[i].gap};
  return deepest.depth > deep * zone.slave.longest_edge ? std::optional(deepest) : std::nullopt;
}

std::string sentence(const model::Model& model, const contact::Zone& zone, const Deepest& found, double begin,
                     double end) {
  const auto node = zone.points[found.point].nodes.front();
  const bool springs = !study::entry_of(zone.settings.method).exact;
  return fmt::format(
      "{}: in the step from t = {:g} to {:g} the surfaces of contact.{} came to overlap by {:.3g} "
      "at node {}, more than its faces are long ({:.3g}); results may be wrong from there on, "
      "expected shorter steps{}",
      model.study.name, begin, end, zone.settings.name, found.depth, model::node_label(model.mesh, node),
      zone.slave.longest_edge, springs ? " or a larger coefficients.normal" : "");
}

} // namespace

void OverlapWatch::note(const step::State& before, const step::State& now) {
  for (std::size_t z = 0; z < model_.zones.size() && !warned_; ++z)
    if (const auto found = newly_deep(model_.zones[z], before.zones[z], now.zones[z])) {
      warned_ = true;
      watch_.warn(sentence(model_, model_.zones[z], *found, before.t, now.t));
    }
}

} // namespace rubato::run
