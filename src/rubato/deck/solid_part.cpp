// SPDX-License-Identifier: LGPL-3.0-or-later
// Supports and loads.
#include "rubato/deck/parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rubato::deck {
namespace {

std::vector<std::string> axes_of(const Context& context) {
  const auto dimension = context.physics ? study::dimension_of(*context.physics) : 3;
  return {study::axis_words.begin(), study::axis_words.begin() + dimension};
}

/// Axes that are written as one word, "xy" or "all".
std::vector<std::string> axes_in(std::string_view word, const std::vector<std::string>& axes) {
  if (word == "all")
    return axes;
  std::vector<std::string> found;
  for (const char letter : word)
    found.emplace_back(1, letter);
  const bool known = std::ranges::all_of(
      found, [&](const std::string& axis) { return std::ranges::find(axes, axis) != axes.end(); });
  return known && found.size() > 1 ? found : std::vector<std::string>{};
}

void read_fixed(const Value& fix, const Context& context, study::Support& support) {
  const auto axes = axes_of(context);
  const bool is_list = fix.tree().is(Tree::Kind::list);
  if (const auto meant = axes_in(fix.tree().text, axes); fix.tree().is(Tree::Kind::word) && !meant.empty()) {
    fix.fault(fmt::format("found '{}', expected one of {} or a list of them; did you mean [{}]?",
                          fix.tree().text, fmt::join(axes, ", "), fmt::join(meant, ", ")));
    return fix.spoil();
  }
  for (const auto& word : is_list ? items(fix) : std::vector<Value>{fix}) {
    const auto axis = read_choice(word, axes);
    if (!axis) {
      fix.spoil();
      continue;
    }
    auto& component = support.components[*axis];
    if (component)
      word.fault(fmt::format("{} is given a second time", study::axis_words[*axis]));
    component = study::Field();
  }
}

/// A direction and the displacement along it.
std::optional<study::ObliqueSupport> read_along(MapReader& map, const Context& context) {
  const auto direction = map.find("along");
  const auto value = map.find("value");
  if (!direction) {
    if (value)
      value->fault("goes with 'along' only, expected x, y or z beside it, or 'along'");
    return std::nullopt;
  }
  study::ObliqueSupport along;
  if (direction->tree().is(Tree::Kind::list))
    read_point(direction, context, along.direction);
  else if (read_choice(direction, {std::string(study::normal_word)}))
    along.normal = true;
  else
    direction->spoil();
  if (value)
    along.value = read_motion(*value, context);
  return along;
}

study::Support read_support(const Value& value, const Context& context) {
  study::Support support;
  MapReader map(value);
  read_name(map.require("on"), support.on);
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto given = map.find(study::axis_words[axis]))
      support.components[axis] = read_motion(*given, context);
  if (const auto fix = map.find("fix"))
    read_fixed(*fix, context, support);
  support.along = read_along(map, context);
  if (const auto turn = map.find("turn")) {
    MapReader axes(*turn);
    for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
      if (const auto given = axes.find(study::axis_words[axis]))
        support.turns[axis] = read_motion(*given, context);
    axes.finish();
  }
  if (const auto rotate = map.find("rotate"))
    support.rotate = read_rotation(*rotate, context);
  read(map.find("until"), support.until);
  map.finish();
  return support;
}

void read_components(MapReader& map, const Context& context, study::Load& load) {
  bool given = false;
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto component = map.find(study::axis_words[axis])) {
      read_field_value(component, context, load.components[axis]);
      given = true;
      // 0 stands for no component in the study
      if (load.kind != study::LoadKind::moment && context.physics &&
          axis >= static_cast<std::size_t>(study::dimension_of(*context.physics)))
        component->fault(fmt::format("{} has no {}, expected x or y",
                                     study::word_of(study::physics_words, *context.physics),
                                     study::axis_words[axis]));
    }
  if (!given && map.is_map())
    map.value().fault("has no component, expected at least one of x, y, z");
}

study::Load read_load(const Value& value, study::LoadKind kind, const Context& context) {
  study::Load load;
  load.kind = kind;
  MapReader map(value);
  read_name(kind == study::LoadKind::gravity ? map.find("on") : map.require("on"), load.on);
  if (kind == study::LoadKind::pressure) {
    read_field_value(map.require("value"), context, load.components[0]);
    read(map.find("follower"), load.follower);
  } else {
    read_components(map, context, load);
  }
  read_name(map.find("function"), load.function);
  map.finish();
  return load;
}

} // namespace

study::Rotation read_rotation(const Value& value, const Context& context) {
  study::Rotation rotation;
  MapReader map(value);
  read_point(map.require("about"), context, rotation.about);
  if (context.physics && study::dimension_of(*context.physics) == 2)
    map.refuse("axis", fmt::format("{} turns about z, expected 'about' and 'angle'",
                                   study::word_of(study::physics_words, *context.physics)));
  else
    read_point(context.physics ? map.require("axis") : map.find("axis"), context, rotation.axis);
  if (const auto angle = map.require("angle"))
    rotation.angle = read_motion(*angle, context);
  map.finish();
  return rotation;
}

bool read_point(const Found& value, const Context& context, std::array<double, 3>& point) {
  std::vector<double> numbers;
  if (!read(value, numbers))
    return false;
  const auto wanted =
      context.physics ? static_cast<std::size_t>(study::dimension_of(*context.physics)) : numbers.size();
  if (numbers.size() != wanted || numbers.size() > point.size()) {
    value->fault(fmt::format("found {} coordinates, expected {}", numbers.size(),
                             std::min<std::size_t>(wanted, point.size())));
    return false;
  }
  std::ranges::copy(numbers, point.begin());
  return true;
}

void read_supports(const Found& value, const Context& context, std::vector<study::Support>& supports) {
  for (const auto& item : items(value))
    supports.push_back(read_support(item, context));
}

void read_base_motion(const Found& value, const Context& context,
                      std::optional<study::BaseMotion>& base_motion) {
  if (!value)
    return;
  MapReader map(*value);
  auto& base = base_motion.emplace();
  for (std::size_t axis = 0; axis < study::axis_words.size(); ++axis)
    if (const auto given = map.find(study::axis_words[axis]))
      base.components[axis] = read_motion(*given, context);
  read(map.find("frame"), base.frame, study::base_frame_words);
  map.finish();
}

void read_loads(const Found& value, const Context& context, std::vector<study::Load>& loads) {
  for (const auto& item : items(value)) {
    MapReader map(item);
    std::size_t kinds = 0;
    for (const auto& word : study::load_words)
      if (const auto load = map.find(word.text)) {
        loads.push_back(read_load(*load, word.value, context));
        ++kinds;
      }
    map.finish();
    const bool unknown_key_told = kinds == 0 && !item.tree().entries.empty();
    if (map.is_map() && kinds != 1 && !unknown_key_told)
      item.fault(fmt::format("found {} kinds of load in one entry, expected one", kinds));
  }
}

} // namespace rubato::deck
