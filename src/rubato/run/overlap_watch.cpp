// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/overlap_watch.hpp"

#include "rubato/contact/buried_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <span>
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

/// A master whose nodes could lie unfelt behind another slave.
bool has_another_side(const contact::Zone& zone) {
  return !zone.obstacle && !zone.meets_itself() && !zone.holds_geometry();
}

/// How deep the slave's own points lie, by a soft spring or because the step was long.
double felt_depth(const contact::ZoneState& state) {
  double depth = 0;
  for (const auto& outcome : state.outcomes)
    depth = std::max(depth, -outcome.gap);
  return depth;
}

/// Of every node of the master [length].
std::vector<double> unfelt_depths(const model::Model& model, std::size_t z, const step::State& state) {
  const double felt = felt_depth(state.zones[z]);
  auto depths = contact::buried_depths(model.zones[z], at(model, state));
  for (auto& depth : depths)
    depth -= felt;
  return depths;
}

/// The node that lies deepest in its edges, of those that did not lie as deep before; its position in the
/// master's nodes.
std::optional<Deepest> newly_buried(const model::Model& model, std::size_t z, std::span<const double> edges,
                                    const step::State& before, const step::State& now) {
  const auto depths = unfelt_depths(model, z, now);
  const auto in_edges = [&](const std::vector<double>& of, std::size_t i) { return of[i] / edges[i]; };
  std::vector<double> former;
  std::optional<Deepest> deepest;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (in_edges(depths, i) <= buried || (deepest && in_edges(depths, i) <= in_edges(depths, deepest->point)))
      continue;
    if (former.empty())
      former = unfelt_depths(model, z, before);
    if (in_edges(former, i) <= buried)
      deepest = {i, depths[i]};
  }
  if (deepest)
    deepest->depth += felt_depth(now.zones[z]);
  return deepest;
}

std::string sentence_of_buried(const model::Model& model, const contact::Zone& zone, const Deepest& found,
                               double t) {
  return fmt::format(
      "{}: at t = {:g} node {} of the master of contact.{} lies {:.3g} behind the slave, whose "
      "faces (up to {:.3g} long) do not feel it; results may be wrong from there on, expected "
      "the finer surface as slave, or smaller faces",
      model.study.name, t, model::node_label(model.mesh, zone.master.nodes[found.point]), zone.settings.name,
      found.depth, zone.slave.longest_edge);
}

} // namespace

OverlapWatch::OverlapWatch(const model::Model& model, const Watch& watch) : model_(model), watch_(watch) {
  for (const auto& zone : model.zones)
    edges_.push_back(has_another_side(zone) ? contact::edges_around(model.mesh, zone.master)
                                            : std::vector<double>());
}

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
    if (edges_[z].empty())
      continue;
    if (const auto found = newly_buried(model_, z, edges_[z], before, now)) {
      buried_ = true;
      watch_.warn(sentence_of_buried(model_, zone, *found, now.t));
    }
  }
}

} // namespace rubato::run
