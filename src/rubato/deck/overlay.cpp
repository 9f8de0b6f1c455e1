// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace rubato::deck {
namespace {

constexpr std::size_t longest_path = 32;
constexpr std::array<std::string_view, 4> parts_of_named_entries{"materials", "functions", "contact",
                                                                 "probes"};

void remove(Tree& node, const Tree& by) {
  node = Tree{};
  node.kind = Tree::Kind::removed;
  node.at = by.at;
}

void merge(Tree& node, const Tree& over);

void merge_entry(Tree& map, const Tree::Entry& over) {
  auto* value = map.find(over.key);
  if (value == nullptr)
    value = &map.entries.emplace_back(Tree::Entry{over.key, over.at, {}}).value;
  merge(*value, over.value);
}

void merge(Tree& node, const Tree& over) {
  if (over.is(Tree::Kind::nothing))
    return remove(node, over);
  if (!over.is(Tree::Kind::map)) {
    node = over;
    return;
  }
  if (!node.is(Tree::Kind::map)) {
    node = over;
    node.entries.clear();
  }
  for (const auto& entry : over.entries)
    merge_entry(node, entry);
}

bool gives(const Tree& map, std::string_view key) {
  const auto* value = map.find(key);
  return value != nullptr && !value->is(Tree::Kind::nothing);
}

/// A mesh has one source: the one about to be given drives out the other.
void drop_other_source(Tree& deck, bool gives_file, bool gives_bodies) {
  auto* mesh = deck.find("mesh");
  if (mesh == nullptr || gives_file == gives_bodies)
    return;
  std::erase_if(mesh->entries, [&](const Tree::Entry& entry) {
    return gives_file ? entry.key == "generate" : entry.key == "file" || entry.key == "name";
  });
}

std::vector<std::string> split(std::string_view path) {
  std::vector<std::string> steps;
  for (;;) {
    const auto dot = path.find('.');
    steps.emplace_back(path.substr(0, dot));
    if (dot == std::string_view::npos)
      return steps;
    path.remove_prefix(dot + 1);
  }
}

std::optional<Change> parse_change(const Setting& setting, const std::vector<std::string>& runs,
                                   Faults& faults) {
  const auto place = "--set " + setting.path;
  Change change{"", split(setting.path), {}};
  if (std::ranges::find(change.path, "") != change.path.end() || change.path.size() > longest_path) {
    faults.add({place}, fmt::format("found the path {}, expected keys joined by dots, as in time.step",
                                    shown(setting.path)));
    return std::nullopt;
  }
  if (change.path.front() == "runs") {
    if (change.path.size() < 3) {
      faults.add({place}, "expected a key of one run, as in runs.NAME.time.step");
      return std::nullopt;
    }
    change.run = change.path[1];
    change.path.erase(change.path.begin(), change.path.begin() + 2);
    if (std::ranges::find(runs, change.run) == runs.end()) {
      faults.add({place},
                 fmt::format("no run is called {}{}", shown(change.run), suggestion(change.run, runs)));
      return std::nullopt;
    }
  }
  change.value.at.file = place;
  if (setting.value.find_first_not_of(" \t\r\n") == std::string::npos)
    return change;
  auto value = parse_tree(setting.value, place, faults, true);
  if (!value)
    return std::nullopt;
  change.value = std::move(*value);
  return change;
}

/// The item of a list that a step of a setting's path means.
Tree* item(Tree& list, const std::string& step, const Location& at, Faults& faults) {
  std::size_t index = 0;
  const auto* end = step.data() + step.size();
  const auto [stop, error] = std::from_chars(step.data(), end, index);
  if (error == std::errc{} && stop == end && index < list.items.size())
    return &list.items[index];
  const auto valid = list.items.empty() ? "the list is empty"
                     : list.items.size() == 1
                         ? "expected 0, the list has one entry"
                         : fmt::format("expected a number from 0 to {}", list.items.size() - 1);
  faults.add(at, fmt::format("found {} as place in a list, {}", shown(step), valid));
  return nullptr;
}

std::vector<std::string> present_keys(const Tree& map) {
  std::vector<std::string> keys;
  for (const auto& entry : map.entries)
    if (!entry.value.is(Tree::Kind::removed))
      keys.push_back(entry.key);
  return keys;
}

/// Walks to the map or list that holds the last step, making maps that are missing on the way.
Tree* walk(Tree& deck, const Change& change, Faults& faults) {
  const auto& at = change.value.at;
  auto* node = &deck;
  for (std::size_t i = 0; i + 1 < change.path.size(); ++i) {
    const auto& step = change.path[i];
    if (node->is(Tree::Kind::list)) {
      node = item(*node, step, at, faults);
    } else {
      auto* next = node->find(step);
      const bool missing = next == nullptr || next->is(Tree::Kind::removed);
      const bool names_entry =
          i == 1 && std::ranges::find(parts_of_named_entries, change.path[0]) != parts_of_named_entries.end();
      if (missing && names_entry) {
        faults.add(at, fmt::format("{} has no {}{}", change.path[0], shown(step),
                                   suggestion(step, present_keys(*node))));
        return nullptr;
      }
      if (next == nullptr)
        next = &node->entries.emplace_back(Tree::Entry{step, at, {}}).value;
      if (missing || next->is(Tree::Kind::nothing)) {
        *next = Tree{};
        next->kind = Tree::Kind::map;
        next->at = at;
      }
      node = next;
    }
    if (node == nullptr)
      return nullptr;
    if (node->is(Tree::Kind::word)) {
      faults.add(at, fmt::format("found {} at {}, which has no {}", described(*node), shown(step),
                                 shown(change.path[i + 1])));
      return nullptr;
    }
  }
  return node;
}

} // namespace

void lay_over(Tree& deck, const Tree& over) {
  if (!over.is(Tree::Kind::map))
    return;
  if (const auto* mesh = over.find("mesh"))
    drop_other_source(deck, gives(*mesh, "file"), gives(*mesh, "generate"));
  merge(deck, over);
}

Setting parse_setting(std::string_view argument) {
  const auto equals = argument.find('=');
  if (equals == std::string_view::npos || equals == 0)
    throw InputError(fmt::format("found {}, expected path.to.key=value", shown(std::string(argument))),
                     {"--set"});
  return {std::string(argument.substr(0, equals)), std::string(argument.substr(equals + 1))};
}

std::vector<Change> parse_changes(std::span<const Setting> settings, const std::vector<std::string>& runs,
                                  Faults& faults) {
  std::vector<Change> changes;
  for (const auto& setting : settings)
    if (auto change = parse_change(setting, runs, faults))
      changes.push_back(std::move(*change));
  return changes;
}

void apply(Tree& deck, const Change& change, Faults& faults) {
  auto* holder = walk(deck, change, faults);
  if (holder == nullptr)
    return;
  if (holder->is(Tree::Kind::list)) {
    if (auto* place = item(*holder, change.path.back(), change.value.at, faults))
      merge(*place, change.value);
    return;
  }
  const auto& path = change.path;
  const bool whole = path.size() == 1 && path[0] == "mesh";
  const bool part = path.size() == 2 && path[0] == "mesh" && !change.value.is(Tree::Kind::nothing);
  drop_other_source(deck, whole ? gives(change.value, "file") : part && path[1] == "file",
                    whole ? gives(change.value, "generate") : part && path[1] == "generate");
  merge_entry(*holder, {path.back(), change.value.at, change.value});
}

} // namespace rubato::deck
