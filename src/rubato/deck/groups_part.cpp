// SPDX-License-Identifier: LGPL-3.0-or-later
// Groups that are made of what the mesh has.
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/deck/groups.hpp"
#include "rubato/deck/parts.hpp"
#include "rubato/deck/places.hpp"
#include "rubato/study/groups.hpp"
#include "rubato/study/validate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rubato::deck {
namespace {

using study::GroupKind;
using study::GroupKindEntry;
using study::GroupSources;

void read_axes(MapReader& map, std::string_view key, const Context& context, std::array<double, 3>& target) {
  const auto found = map.require(key);
  if (found && !read_point(found, context, target))
    found->spoil();
}

void read_solid_shape(MapReader& map, const Context& context, study::MadeGroup& group) {
  if (group.kind == GroupKind::box) {
    read_axes(map, "from", context, group.from);
    read_axes(map, "to", context, group.to);
    return;
  }
  read_axes(map, "point", context, group.point);
  if (group.kind == GroupKind::plane)
    return read_axes(map, "normal", context, group.direction);
  if (group.kind == GroupKind::cylinder)
    read_axes(map, "axis", context, group.direction);
  read(map.require("radius"), group.radius);
}

void read_shape(const Value& value, const Context& context, study::MadeGroup& group) {
  switch (group.kind) {
  case GroupKind::box:
  case GroupKind::sphere:
  case GroupKind::cylinder:
  case GroupKind::plane: {
    MapReader map(value);
    read_solid_shape(map, context, group);
    return map.finish();
  }
  case GroupKind::normal:
  case GroupKind::along:
    if (!read_point(value, context, group.direction))
      value.spoil();
    return;
  default:
    if (study::entry_of(group.kind).sources == GroupSources::list && !value.tree().is(Tree::Kind::list))
      value.fault(fmt::format("found {}, expected a list of groups", described(value.tree())));
    else
      read_names(value, group.of);
  }
}

/// "box, sphere": the kinds that take a key.
template <class Takes> std::string kinds_that(Takes takes) {
  std::vector<std::string_view> names;
  for (const auto& entry : study::group_kinds)
    if (takes(entry))
      names.push_back(entry.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

bool has_of(const GroupKindEntry& entry) {
  return entry.sources == GroupSources::of || entry.sources == GroupSources::any_of;
}

/// Finds the key where the kind takes it, and refuses it elsewhere.
template <class Takes>
Found find_taken(MapReader& map, std::string_view key, const GroupKindEntry& entry, Takes takes) {
  if (takes(entry))
    return map.find(key);
  map.refuse(key, fmt::format("'{}' takes no '{}', these do: {}", entry.name, key, kinds_that(takes)));
  return std::nullopt;
}

void read_rest(MapReader& map, study::MadeGroup& group) {
  const auto& entry = study::entry_of(group.kind);
  std::string of;
  const bool required = entry.sources == GroupSources::of;
  if (read_name(required ? map.require("of") : find_taken(map, "of", entry, has_of), of))
    group.of = {of};
  read(find_taken(map, "within", entry, [](const auto& e) { return e.within; }), group.within);
  read(find_taken(map, "angle", entry, [](const auto& e) { return e.angle; }), group.angle);
  read(find_taken(map, "take", entry, [](const auto& e) { return e.take; }), group.take,
       study::group_take_words);
}

/// A kind that is not known: no other key can be judged.
void pass_rest(MapReader& map) {
  for (const auto* key : {"of", "within", "angle", "take"})
    map.find(key);
  map.value().spoil();
}

study::MadeGroup read_group(const NamedValue& named, const Context& context) {
  study::MadeGroup group;
  group.name = named.name.text;
  MapReader map(named.value);
  std::vector<std::string> given;
  Found shape;
  for (const auto& entry : study::group_kinds)
    if (const auto found = map.find(entry.name)) {
      given.emplace_back(entry.name);
      group.kind = entry.kind;
      shape = found;
    }
  if (given.size() == 1) {
    read_rest(map, group);
    read_shape(*shape, context, group);
  } else {
    pass_rest(map);
  }
  map.finish();
  const auto& entries = named.value.tree().entries;
  const bool unknown_key_told = std::ranges::any_of(entries, [](const auto& entry) {
    return entry.key != "of" && entry.key != "within" && entry.key != "angle" && entry.key != "take";
  });
  if (given.size() > 1)
    named.value.fault(fmt::format("found {} together, expected one of them", fmt::join(given, " and ")));
  else if (given.empty() && map.is_map() && !unknown_key_told)
    named.value.fault(fmt::format("does not say how it is made, expected one of {}",
                                  kinds_that([](const auto&) { return true; })));
  return group;
}

study::Study study_of(std::vector<study::MadeGroup> groups, study::Physics physics) {
  study::Study study;
  study.physics = physics;
  study.mesh.groups = std::move(groups);
  return study;
}

/// A deck of nothing else.
Tree deck_of(Tree groups) {
  Tree mesh;
  mesh.kind = Tree::Kind::map;
  mesh.entries.push_back({"groups", {}, std::move(groups)});
  Tree deck;
  deck.kind = Tree::Kind::map;
  deck.entries.push_back({"mesh", {}, std::move(mesh)});
  return deck;
}

/// Texts "NAME=VALUE" as a map.
Tree map_of(std::span<const std::string> options, Faults& faults) {
  Tree map;
  map.kind = Tree::Kind::map;
  for (const auto& text : options) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError(
          fmt::format("found {}, expected NAME={{...}}, as in 'top={{normal: [0, 0, 1]}}'", shown(text)),
          {"--group"});
    const auto name = text.substr(0, equals);
    const Location at{"--group " + name};
    if (map.find(name) != nullptr)
      faults.add(at, fmt::format("found a second group named {}", shown(name)));
    else if (auto tree = parse_tree(std::string_view(text).substr(equals + 1), at.file, faults, true))
      map.entries.push_back({name, at, std::move(*tree)});
  }
  return map;
}

} // namespace

void read_groups(const Found& value, const Context& context, std::vector<study::MadeGroup>& groups) {
  for (const auto& entry : named_entries(value))
    groups.push_back(read_group(entry, context));
}

std::vector<study::MadeGroup> parse_groups(std::span<const std::string> options, int dimension) {
  Faults faults;
  const auto map = map_of(options, faults);
  const Places places(deck_of(map));
  const auto forms = grammar::groups();
  const auto physics = dimension == 3 ? study::Physics::solid : study::Physics::plane_strain;
  std::vector<study::MadeGroup> groups;
  read_groups(Value(map, "mesh.groups", faults, forms), {.folder = {}, .physics = physics, .scheme = {}},
              groups);
  const auto judgement = study::judge_groups(study_of(groups, physics));
  faults.add_bounds(judgement.bounds);
  const auto is_spoiled = [&](const std::string& path) { return faults.is_spoiled(path); };
  for (const auto& rule : judgement.broken)
    if (std::ranges::none_of(rule.paths, is_spoiled))
      faults.add(places.of(rule.paths.front()), rule.paths.front() + ": " + rule.text);
  faults.throw_if_any();
  return groups;
}

} // namespace rubato::deck
