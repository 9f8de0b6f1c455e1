// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/overlap_watch.hpp"

#include "rubato/model/model.hpp"
#include "rubato/model/node_label.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rubato::run {
namespace {

/// In lengths of the slave's longest edge: depth that is seen as new, and the depth before.
constexpr double deep = 1, shallow = 0.5;

struct Deepest {
  std::size_t point = 0;
  double depth = 0; ///< [length]
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

/// In lengths of the slave's longest edge: depth that a point brings along from beyond the master.
constexpr double brought = 0.02;

/// Springs of explicit steps keep the depth of points that come onto the master from beyond its border.
bool keeps_depth(const model::Model& model, const contact::Zone& zone) {
  return study::is_explicit(model.study.time.scheme) && !zone.settings.tie;
}

std::optional<Deepest> deepest_from_beyond(const contact::Zone& zone, const contact::ZoneState& before,
                                           const contact::ZoneState& now) {
  Deepest deepest;
  for (std::size_t i = 0; i < now.outcomes.size(); ++i)
    if (!std::isfinite(before.outcomes[i].gap) && -now.outcomes[i].gap > deepest.depth)
      deepest = {i, -now.outcomes[i].gap};
  return deepest.depth > brought * zone.slave.longest_edge ? std::optional(deepest) : std::nullopt;
}

std::string sentence_of_beyond(const model::Model& model, const contact::Zone& zone, const Deepest& found,
                               double t) {
  return fmt::format(
      "{}: at t = {:g} node {} of the slave of contact.{} came onto the master from beyond its border and "
      "lies {:.3g} behind it; its spring keeps this depth, so forces there are too small, expected the other "
      "side as slave, or an implicit scheme",
      model.study.name, t, model::node_label(model.mesh, zone.points[found.point].nodes.front()),
      zone.settings.name, found.depth);
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

/// The node of a master that lies deepest in its limit, of those that did not lie as deep before: its
/// position there. What the slave feels is added to each limit.
std::optional<Deepest> newly_buried(const model::Model& model, BuriedMaster& master,
                                    const step::State& before, const step::State& now) {
  const auto depths = master.nodes.depths(at(model, now));
  const double felt = felt_depth(now.zones[master.zone]), felt_before = felt_depth(before.zones[master.zone]);
  std::vector<double> former;
  std::optional<Deepest> deepest;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i] <= master.limits[i] + felt)
      continue;
    if (former.empty())
      former = master.nodes.depths(at(model, before));
    const bool deeper =
        !deepest || depths[i] / master.limits[i] > deepest->depth / master.limits[deepest->point];
    if (former[i] <= master.limits[i] + felt_before && deeper)
      deepest = {i, depths[i]};
  }
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
  for (std::size_t z = 0; z < model.zones.size(); ++z)
    if (const auto& zone = model.zones[z]; has_another_side(zone)) {
      auto limits = contact::edges_around(model.mesh, zone.master);
      for (auto& limit : limits)
        limit *= buried;
      masters_.push_back({z, limits, contact::BuriedNodes(zone, limits)});
    }
}

void OverlapWatch::note(const step::State& before, const step::State& now) {
  for (std::size_t z = 0; z < model_.zones.size() && !warned_; ++z)
    if (const auto found = newly_deep(model_.zones[z], before.zones[z], now.zones[z])) {
      warned_ = true;
      watch_.warn(sentence(model_, model_.zones[z], *found, before.t, now.t));
    }
  note_from_beyond(before, now);
  if (!warned_ && !buried_)
    note_buried(before, now);
}

void OverlapWatch::note_from_beyond(const step::State& before, const step::State& now) {
  for (std::size_t z = 0; z < model_.zones.size() && !from_beyond_; ++z)
    if (const auto& zone = model_.zones[z]; keeps_depth(model_, zone))
      if (const auto found = deepest_from_beyond(zone, before.zones[z], now.zones[z])) {
        from_beyond_ = true;
        watch_.warn(sentence_of_beyond(model_, zone, *found, now.t));
      }
}

void OverlapWatch::note_buried(const step::State& before, const step::State& now) {
  for (auto& master : masters_)
    if (const auto found = newly_buried(model_, master, before, now); found && !std::exchange(buried_, true))
      watch_.warn(sentence_of_buried(model_, model_.zones[master.zone], *found, now.t));
}

} // namespace rubato::run
