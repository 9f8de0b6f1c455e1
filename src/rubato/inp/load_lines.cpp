// SPDX-License-Identifier: LGPL-3.0-or-later
// How lines of loads replace those of steps before.
#include "rubato/inp/load_lines.hpp"

#include "rubato/core/naming.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace rubato::inp {

using mesh::inp::compact;

Options options_of(Reading& reading, const Block& block) {
  Options options;
  if (const auto* op = block.find("OP"); op != nullptr) {
    const auto word = compact(op->value.text);
    options.replace_all = word == "NEW";
    if (word != "NEW" && word != "MOD") {
      reading.faults.add(op->value.empty() ? op->name : op->value,
                         fmt::format("found OP={}, expected NEW or MOD", word));
      options.sound = false;
    }
  }
  if (const auto* amplitude = block.find("AMPLITUDE"); amplitude != nullptr) {
    options.curve = named(reading.curves, amplitude->value, "an *AMPLITUDE", reading.faults);
    options.sound = options.sound && options.curve != nullptr;
  }
  return options;
}

/// OP=NEW takes all of the kind away that earlier steps gave, at its first keyword of the step.
void begin_block(const Block& block, const Options& options, const Step& step, std::string_view kind,
                 std::vector<Active>& actives, History& history, Reading& reading) {
  if (!options.replace_all || !history.replaced_by_new.insert(std::string(kind)).second)
    return;
  std::vector<Active> left;
  for (auto& active : actives) {
    if (active.kind != kind || active.step == step.number) {
      left.push_back(std::move(active));
      continue;
    }
    const double value = active.course.to;
    if (kind == "BOUNDARY" && step.number > 1)
      note(reading, block.at,
           "supports that OP=NEW takes away let go at the begin of the step; Abaqus takes their "
           "forces away over a static step");
    if (kind == "BOUNDARY" || !step.ramp || value == 0)
      continue;
    active.course = {value, 0, nullptr, 1, history.time};
    left.push_back(std::move(active));
    note(reading, block.at,
         "loads that OP=NEW takes away in a static step fall to 0 over the step, as in Abaqus; "
         "CalculiX takes them away at its begin");
  }
  actives = std::move(left);
}

/// The value that what has this key had at the end of the step before.
std::optional<double> value_before(const History& history, const std::string& key) {
  std::optional<double> sum;
  for (const auto& active : history.before)
    if (active.key == key)
      sum = sum.value_or(0) + active.course.to;
  return sum;
}

void keep_rest(Reading& reading, const Active& other, const Active& taken, std::vector<Active>& actives) {
  Active rest = other;
  rest.items.clear();
  std::ranges::set_difference(other.items, taken.items, std::back_inserter(rest.items));
  if (rest.items.empty())
    return;
  const auto direction = other.key.substr(other.kind.size() + 1 + mesh::inp::folded(other.on).size());
  const auto key_on = [&](const std::string& on) {
    return fmt::format("{} {}{}", other.kind, mesh::inp::folded(on), direction);
  };
  const auto is_group = [&](const std::string& name) {
    const auto& sets = reading.content.node_sets;
    return std::ranges::any_of(sets, [&](const auto& set) { return set.second.group == name; });
  };
  if (is_group(other.on) && is_group(taken.on)) {
    auto& groups = reading.study.mesh.groups;
    const std::vector<std::string> of{other.on, taken.on};
    const auto made = std::ranges::find(groups, of, &study::MadeGroup::of);
    rest.on = made != groups.end()
                  ? made->name
                  : chosen_name(reading, relation_kind, fmt::format("{}_without_{}", other.on, taken.on));
    if (made == groups.end()) {
      study::MadeGroup group;
      group.name = rest.on;
      group.kind = study::GroupKind::difference;
      group.of = of;
      groups.push_back(std::move(group));
    }
    rest.key = key_on(rest.on);
    return actives.push_back(std::move(rest));
  }
  constexpr std::size_t most_nodes = 2000;
  if (rest.items.size() > most_nodes)
    return reading.faults.add(taken.at,
                              fmt::format("found a support of a part of the nodes of {}, which line "
                                          "{} holds, expected sets that share no node",
                                          shown(other.on), other.at.line));
  for (const auto node : std::vector<std::int32_t>(rest.items)) {
    rest.on = node_name(reading, node);
    rest.items = {node};
    rest.key = key_on(rest.on);
    actives.push_back(rest);
  }
}

/// Removes the nodes of `active` from the load of an earlier step that contains them; returns its force.
template <class IsOverlapped>
std::optional<double> take_nodes(Reading& reading, const Active& active, IsOverlapped is_overlapped,
                                 std::vector<Active>& actives) {
  const auto found = std::ranges::find_if(actives, is_overlapped);
  if (found == actives.end() || !std::ranges::includes(found->items, active.items) ||
      std::ranges::count_if(actives, is_overlapped) > 1)
    return std::nullopt;
  const auto other = *found;
  actives.erase(found);
  keep_rest(reading, other, active, actives);
  return other.course.to;
}

/// Puts a line in: it replaces those of former steps with its key and adds to those of the step.
void put(Reading& reading, Active active, const Options& options, const Step& step, double magnitude,
         std::vector<Active>& actives, const History& history) {
  std::erase_if(actives,
                [&](const Active& other) { return other.key == active.key && other.step != step.number; });
  const auto is_overlapped = [&](const Active& other) {
    return other.step != step.number && other.kind == active.kind && other.label == active.label &&
           share(other.items, active.items);
  };
  std::optional<double> taken;
  if (active.kind == "CLOAD")
    taken = take_nodes(reading, active, is_overlapped, actives);
  const bool overlaps = std::ranges::any_of(actives, is_overlapped);
  if (overlaps && !history.replaced_by_new.contains(active.kind))
    return reading.faults.add(active.at,
                              "found a load on a part of what another step loads, expected the same set and "
                              "direction, or OP=NEW: it is not known which of its loads it replaces");
  const auto same = std::ranges::find(actives, active.key, &Active::key);
  const double before = value_before(history, active.key).value_or(taken.value_or(0));
  active.course = {step.ramp ? before : magnitude, magnitude, options.curve, magnitude, history.time};
  if (same == actives.end())
    return actives.push_back(std::move(active));
  if (same->course.curve != options.curve)
    return reading.faults.add(active.at,
                              fmt::format("found a second load on the same place with another amplitude, "
                                          "expected one; the other is in line {}",
                                          same->at.line));
  same->course.to += magnitude;
  same->course.scale += magnitude;
  if (!step.ramp)
    same->course.from = same->course.to;
}

} // namespace rubato::inp
