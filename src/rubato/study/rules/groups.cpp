// SPDX-License-Identifier: LGPL-3.0-or-later
// Groups that are made of what the mesh has.
#include "rubato/study/groups.hpp"

#include "rubato/study/rules/rules.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace rubato::study {
namespace {

/// Each may wait for all others.
constexpr std::size_t most_groups = 1000;

void check_coordinates(Rules& rules, const std::array<double, 3>& numbers, const std::string& path) {
  for (std::size_t axis = 0; axis < numbers.size(); ++axis) {
    const auto at = fmt::format("{}.{}", path, axis);
    rules.number(at, numbers[axis]);
    if (numbers[axis] != 0)
      rules.axis(at, axis);
  }
}

void check_vector(Rules& rules, const std::array<double, 3>& numbers, const std::string& path) {
  check_coordinates(rules, numbers, path);
  if (std::ranges::all_of(numbers, [](double x) { return x == 0; }))
    rules.broken({path}, "found a vector of length 0, expected one that points somewhere");
}

void check_corners(Rules& rules, const MadeGroup& group, const std::string& path) {
  check_coordinates(rules, group.from, path + ".from");
  check_coordinates(rules, group.to, path + ".to");
  for (std::size_t axis = 0; axis < group.to.size(); ++axis)
    if (group.to[axis] < group.from[axis])
      rules.broken({fmt::format("{}.to.{}", path, axis), path + ".to", path + ".from"},
                   fmt::format("found {} for {}, expected at least the {} of 'from'", group.to[axis],
                               axis_words.at(axis), group.from[axis]));
}

void check_shape(Rules& rules, const MadeGroup& group, const std::string& path) {
  switch (group.kind) {
  case GroupKind::box:
    return check_corners(rules, group, path);
  case GroupKind::sphere:
    check_coordinates(rules, group.point, path + ".point");
    return rules.number(path + ".radius", group.radius, bounds::radius);
  case GroupKind::cylinder:
    check_coordinates(rules, group.point, path + ".point");
    check_vector(rules, group.direction, path + ".axis");
    if (dimension_of(rules.study.physics) == 2)
      rules.broken({path, "physics"}, fmt::format("{} has no cylinder, expected sphere, a circle there",
                                                  word_of(physics_words, rules.study.physics)));
    return rules.number(path + ".radius", group.radius, bounds::radius);
  case GroupKind::plane:
    check_coordinates(rules, group.point, path + ".point");
    return check_vector(rules, group.direction, path + ".normal");
  case GroupKind::normal:
  case GroupKind::along:
    return check_vector(rules, group.direction, path);
  default:
    return;
  }
}

std::string expected_sources(GroupSources sources) {
  switch (sources) {
  case GroupSources::list:
    return "two or more";
  case GroupSources::any_of:
    return "one or none";
  default:
    return "one";
  }
}

bool fits(GroupSources sources, std::size_t count) {
  return sources == GroupSources::list ? count > 1
                                       : count == 1 || (count == 0 && sources == GroupSources::any_of);
}

void check_group(Rules& rules, const MadeGroup& group) {
  const auto path = path_of(group);
  const auto& entry = entry_of(group.kind);
  const auto below = fmt::format("{}.{}", path, entry.name);
  if (group.name == everywhere)
    rules.broken({path}, "found the name 'all', which stands for everything, expected another one");
  if (!fits(entry.sources, group.of.size()))
    rules.broken(
        {entry.sources == GroupSources::of ? path + ".of" : below, path},
        fmt::format("found {} groups, expected {}", group.of.size(), expected_sources(entry.sources)));
  for (std::size_t i = 0; i < group.of.size(); ++i) {
    rules.name(path_of_source(group, i), group.of[i]);
    if (std::find(group.of.begin(), group.of.begin() + static_cast<std::ptrdiff_t>(i), group.of[i]) !=
        group.of.begin() + static_cast<std::ptrdiff_t>(i))
      rules.broken({path_of_source(group, i)}, fmt::format("found {} a second time", shown(group.of[i])));
  }
  check_shape(rules, group, below);
  if (group.within)
    rules.number(path + ".within", *group.within, bounds::within);
  if (entry.angle)
    rules.number(path + ".angle", group.angle, bounds::normal_angle);
}

} // namespace

void check_groups(Rules& rules) {
  const auto& groups = rules.study.mesh.groups;
  if (groups.size() > most_groups)
    return rules.broken({"mesh.groups"},
                        fmt::format("found {} groups, expected at most {}", groups.size(), most_groups));
  std::vector<std::string> names;
  for (const auto& group : groups) {
    rules.chosen_name(path_of(group), group.name, names);
    check_group(rules, group);
    names.push_back(group.name);
  }
  const auto cycle = order_of(groups).cycle;
  if (!cycle.empty())
    rules.broken({"mesh.groups." + cycle.front()},
                 fmt::format("found groups that are made of one another, {}, expected an end",
                             fmt::join(cycle, " of ")));
}

} // namespace rubato::study
