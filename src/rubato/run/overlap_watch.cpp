// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/overlap_watch.hpp"

#include "rubato/contact/buried_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

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

/// Part of a master node's shortest edge.
constexpr double buried = 0.5;

contact::Configuration at(const model::Model& model, const step::State& state) {
  return {&model.mesh, &model.dofs, &state.motion.u, &state.motion.u, state.t, state.t};
}

bool has_sides_to_swap(const contact::Zone& zone) {
  return !zone.obstacle && zone.settings.self.empty() && !zone.holds_geometry();
}

/// How deep the slave's own points lie, by a soft spring or because the step was long.
double felt_depth(const contact::ZoneState& state) {
  double depth = 0;
  for (const auto& outcome : state.outcomes)
    depth = std::max(depth, -outcome.gap);
  return depth;
}

/// Of every node of the master how much deeper it lies than the slave feels, in its edges.
std::vector<double> unfelt_depths(const model::Model& model, std::size_t z, const step::State& state) {
  const auto& zone = model.zones[z];
  const auto edges = contact::edges_around(model.mesh, zone.master);
  const double felt = felt_depth(state.zones[z]);
  auto depths = contact::buried_depths(zone, at(model, state));
  for (std::size_t i = 0; i < depths.size(); ++i)
    depths[i] = (depths[i] - felt) / edges[i];
  return depths;
}

/// The deepest of those that were not as deep before: its position in the master's nodes.
std::optional<std::size_t> newly_buried(const model::Model& model, std::size_t z, const step::State& before,
                                        const step::State& now) {
  const auto depths = unfelt_depths(model, z, now);
  if (std::ranges::max(depths) <= buried)
    return std::nullopt;
  const auto former = unfelt_depths(model, z, before);
  std::optional<std::size_t> deepest;
  for (std::size_t i = 0; i < depths.size(); ++i)
    if (depths[i] > buried && former[i] <= buried && (!deepest || depths[i] > depths[*deepest]))
      deepest = i;
  return deepest;
}

std::string sentence_of_buried(const model::Model& model, const contact::Zone& zone, std::size_t found,
                               const step::State& now) {
  const double depth = contact::buried_depths(zone, at(model, now))[found];
  return fmt::format(
      "{}: at t = {:g} node {} of the master of contact.{} lies {:.3g} behind the slave, whose "
      "faces (up to {:.3g} long) do not feel it; results may be wrong from there on, expected "
      "the finer surface as slave, or smaller faces",
      model.study.name, now.t, model::node_label(model.mesh, zone.master.nodes[found]), zone.settings.name,
      depth, zone.slave.longest_edge);
}

} // namespace

void OverlapWatch::note(const step::State& before, const step::State& now) {
  for (std::size_t z = 0; z < model_.zones.size() && !warned_; ++z)
    if (const auto found = newly_deep(model_.zones[z], before.zones[z], now.zones[z])) {
      warned_ = true;
      watch_.warn(sentence(model_, model_.zones[z], *found, before.t, now.t));
    }
  if (!warned_)
    note_buried(before, now);
}

void OverlapWatch::note_buried(const step::State& before, const step::State& now) {
  for (std::size_t z = 0; z < model_.zones.size() && !buried_; ++z) {
    const auto& zone = model_.zones[z];
    if (!has_sides_to_swap(zone))
      continue;
    if (const auto found = newly_buried(model_, z, before, now)) {
      buried_ = true;
      watch_.warn(sentence_of_buried(model_, zone, *found, now));
    }
  }
}

} // namespace rubato::run
