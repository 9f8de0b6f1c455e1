// SPDX-License-Identifier: LGPL-3.0-or-later
// Relations between displacements.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace rubato::deck {
namespace {

study::RelationTerm read_term(const Value& value) {
  study::RelationTerm term;
  MapReader map(value);
  read_name(map.require("on"), term.on);
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    read(map.find(study::axis_words[axis]), term.coefficients[axis]);
  map.finish();
  return term;
}

void read_axes(const Found& value, std::array<bool, 3>& components) {
  if (!value)
    return;
  components = {};
  const std::vector<std::string> axes(study::axis_words.begin(), study::axis_words.end());
  const bool is_list = value->tree().is(Tree::Kind::list);
  for (const auto& word : is_list ? items(value) : std::vector<Value>{*value}) {
    const auto axis = read_choice(word, axes);
    if (!axis)
      value->spoil();
    else if (components.at(*axis))
      word.fault(fmt::format("{} is given a second time", study::axis_words.at(*axis)));
    else
      components.at(*axis) = true;
  }
}

void read_difference(const Found& value, const Context& context, std::array<study::Field, 3>& difference) {
  if (!value)
    return;
  MapReader map(*value);
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto given = map.find(study::axis_words[axis]))
      difference[axis] = read_field(*given, context);
  map.finish();
}

/// Nodes, or a reference.
void read_embedded(MapReader& map, const Context& context, study::Relation& relation) {
  const auto on = map.find("on");
  const auto at = map.find("at");
  read_name(on, relation.on);
  if (std::array<double, 3> place{}; read_point(at, context, place))
    relation.at = place;
  read_name(map.find("in"), relation.cells);
  if (map.is_map() && on.has_value() == at.has_value())
    map.value().fault(on ? "found both 'on' and 'at', expected one of them" : "'on' or 'at' is missing");
}

void read_content(MapReader& map, const Context& context, study::Relation& relation) {
  if (relation.kind == study::RelationKind::equation) {
    for (const auto& term : items(map.require("terms")))
      relation.terms.push_back(read_term(term));
    if (const auto value = map.find("value"))
      relation.value = read_field(*value, context);
    return;
  }
  if (relation.kind == study::RelationKind::embedded)
    return read_embedded(map, context, relation);
  read_name(map.require("on"), relation.on);
  if (study::has_rotation(relation.kind)) {
    if (std::array<double, 3> at{}; read_point(map.find("at"), context, at))
      relation.at = at;
    return;
  }
  if (relation.kind == study::RelationKind::pairs) {
    read_name(map.require("with"), relation.with);
    read_difference(map.find("difference"), context, relation.difference);
  }
  read_axes(map.find("in"), relation.components);
}

} // namespace

void read_relations(const Found& value, const Context& context, std::vector<study::Relation>& relations) {
  for (const auto& entry : named_entries(value)) {
    MapReader map(entry.value);
    std::size_t kinds = 0;
    for (const auto& word : study::relation_words)
      if (const auto content = map.find(word.text)) {
        study::Relation relation;
        relation.name = entry.name.text;
        relation.kind = word.value;
        MapReader part(*content);
        read_content(part, context, relation);
        part.finish();
        if (kinds++ == 0)
          relations.push_back(std::move(relation));
      }
    map.finish();
    if (map.is_map() && kinds != 1 && (kinds > 0 || entry.value.tree().entries.empty()))
      entry.value.fault(fmt::format("found {} kinds of relation in one entry, expected one", kinds));
  }
}

} // namespace rubato::deck
