// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/turn_watch.hpp"

#include "rubato/contact/small_vectors.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/rotations.hpp"
#include "rubato/study/formulation.hpp"
#include "rubato/study/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

namespace rubato::run {
namespace {

const study::Relation& relation_of(const study::Study& study, const std::string& name) {
  return *std::ranges::find(study.relations, name, &study::Relation::name);
}

/// Whether a support, a load or a connector knows the name.
bool is_used(const study::Study& study, const std::string& name) {
  const auto is_on = [&](const auto& entry) { return entry.on == name; };
  return std::ranges::any_of(study.supports, is_on) || std::ranges::any_of(study.loads, is_on) ||
         std::ranges::any_of(study.masses, is_on) ||
         std::ranges::any_of(study.connectors,
                             [&](const auto& one) { return one.on == name || one.to == name; });
}

/// A distributed reference that nothing holds and loads only looks at its group.
bool is_bound(const study::Study& study, const model::Reference& reference) {
  const auto kind = relation_of(study, reference.name).kind;
  return kind == study::RelationKind::rigid ||
         (kind == study::RelationKind::distributed && is_used(study, reference.name));
}

double turn_of(const model::Reference& reference, const step::State& state, int components) {
  const auto rows = reference.motion.rows() - components;
  return (reference.motion.bottomRows(rows) * state.motion.u(reference.dofs)).norm();
}

std::string_view remedy_for(const study::Study& study) {
  return study::takes_large_rotations(study)
             ? "expected a group that 'supports: rotate' turns where the rotation is given, or a stiff "
               "meshed body of a material with strain: green_lagrange in the relation's place"
             : "expected a material with strain: green_lagrange or logarithmic, as small strain stretches "
               "bodies alike, and 'supports: rotate' or a stiff meshed body in the relation's place";
}

double turn_of(const model::ConnectorWay& way, const step::State& state) {
  Eigen::Vector3d now = way.undeformed;
  for (std::size_t i = 0; i < way.moved.size(); ++i)
    for (const auto& term : way.moved[i])
      now[static_cast<Eigen::Index>(i)] += term.coefficient * state.motion.u[term.dof];
  return std::atan2(contact::length_of(contact::cross(way.undeformed, now)),
                    contact::dot(way.undeformed, now));
}

} // namespace

TurnWatch::TurnWatch(const model::Model& model, const Watch& watch) : model_(model), watch_(watch) {
  for (const auto& connector : model.connectors)
    if (connector.way && !connector.line)
      ways_.push_back(&*connector.way);
  for (const auto& reference : model.references)
    if (reference.turns && is_bound(model.study, reference))
      watched_.push_back(&reference);
}

void TurnWatch::note(const step::State& now) {
  note_relations(now);
  note_connectors(now);
}

void TurnWatch::note_connectors(const step::State& now) {
  std::erase_if(ways_, [&](const model::ConnectorWay* way) {
    const double turn = turn_of(*way, now);
    if (turn > largest_.turn)
      largest_ = {turn, now.t, fmt::format("the connector between '{}' and '{}'", way->on, way->to)};
    if (!(turn > model::largest_small_angle))
      return false;
    watch_.warn(
        fmt::format("{}: at t = {:g} the connector between '{}' and '{}' has turned by {:.3g} radians, "
                    "more than {}: its force keeps the direction that it had undeformed; expected "
                    "'rotates: true' at the connector, which then acts along the current line",
                    model_.study.name, now.t, way->on, way->to, turn, model::largest_small_angle));
    return true;
  });
}

void TurnWatch::note_relations(const step::State& now) {
  std::erase_if(watched_, [&](const model::Reference* reference) {
    const double turn = turn_of(*reference, now, model_.dofs.components);
    if (turn > largest_.turn)
      largest_ = {turn, now.t, fmt::format("the relation '{}'", reference->name)};
    if (!(turn > model::largest_small_angle))
      return false;
    const auto& relation = relation_of(model_.study, reference->name);
    watch_.warn(fmt::format(
        "{}: at t = {:g} the {} relation '{}' has turned by {:.3g} radians, more than {}: "
        "it holds for small rotations and stretches its group by {:.2g}; {}",
        model_.study.name, now.t, study::word_of(study::relation_words, relation.kind), reference->name, turn,
        model::largest_small_angle, turn * turn / 2, remedy_for(model_.study)));
    return true;
  });
}

std::vector<results::Plausibility> TurnWatch::checks() const {
  if (ways_.empty() && watched_.empty() && largest_.turn == 0)
    return {};
  return {{"relation_rotation", largest_.turn, model::largest_small_angle, largest_.t, largest_.where, "",
           largest_.turn > model::largest_small_angle}};
}

} // namespace rubato::run
