// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/chosen_runs.hpp"

#include "rubato/core/naming.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>

namespace rubato::deck {
namespace {

std::vector<std::string> names_of_written(const std::vector<WrittenRun>& runs) {
  std::vector<std::string> names;
  names.reserve(runs.size());
  for (const auto& run : runs)
    names.push_back(run.name.text);
  return names;
}

void check_names(std::span<const std::string> only, const std::vector<std::string>& names, Faults& faults) {
  for (const auto& name : only) {
    if (std::ranges::find(names, name) != names.end())
      continue;
    const auto nearest = nearest_word(name, names);
    faults.add({"--only"}, fmt::format("found '{}', expected one of {}{}", name, fmt::join(names, ", "),
                                       nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  }
}

/// The run that a run starts from, as it is written; empty when there is none.
std::string source_of(const Tree& tree) {
  const auto* node = &tree;
  for (const auto* key : {"time", "start", "from"})
    if (node = node->find(key); node == nullptr)
      return "";
  return node->text;
}

bool means_something(const Tree::Entry& entry) {
  return !entry.value.is(Tree::Kind::removed) && !entry.value.is(Tree::Kind::nothing);
}

/// Wherever they were written.
bool same(const Tree& a, const Tree& b) {
  if (a.kind != b.kind || a.text != b.text || !std::ranges::equal(a.items, b.items, same))
    return false;
  const auto found_in = [](const Tree& other) {
    return [&other](const Tree::Entry& entry) {
      const auto* value = other.find(entry.key);
      return !means_something(entry) || (value != nullptr && same(entry.value, *value));
    };
  };
  return std::ranges::all_of(a.entries, found_in(b)) && std::ranges::all_of(b.entries, found_in(a));
}

} // namespace

std::vector<ChosenRun> choose_runs(const Tree& deck, const std::vector<WrittenRun>& runs,
                                   std::span<const Change> changes, std::span<const std::string> only,
                                   Faults& faults) {
  check_names(only, names_of_written(runs), faults);
  std::vector<std::string> sources;
  std::vector<ChosenRun> chosen;
  for (std::size_t left = runs.size(); left-- > 0;) {
    const auto& run = runs[left];
    const auto& name = run.name.text;
    const bool asked = only.empty() || std::ranges::find(only, name) != only.end();
    if (!asked && std::ranges::find(sources, name) == sources.end())
      continue;
    ChosenRun one{&run, asked};
    Faults told_later;
    const auto tree = tree_of(deck, one, changes, told_later);
    one.left = !asked && !same(tree, tree_of(deck, {&run, true}, changes, told_later));
    sources.push_back(source_of(tree));
    chosen.push_back(one);
  }
  std::ranges::reverse(chosen);
  return chosen;
}

Tree tree_of(const Tree& deck, const ChosenRun& chosen, std::span<const Change> changes, Faults& faults) {
  auto tree = deck;
  lay_over(tree, chosen.run->over);
  for (const auto& change : changes)
    if (change.run.empty() ? chosen.asked : change.run == chosen.run->name.text)
      apply(tree, change, faults);
  return tree;
}

} // namespace rubato::deck
