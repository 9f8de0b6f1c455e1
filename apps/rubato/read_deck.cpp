// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read_deck.hpp"

#include "rubato/study/echo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iostream>
#include <iterator>
#include <vector>

namespace rubato::app {
namespace {

/// A tree that has a value at each path, where it is written: that deck::Places is made of.
deck::Tree tree_of(const inp::Places& places) {
  deck::Tree tree;
  for (const auto& [path, at] : places) {
    auto* node = &tree;
    for (std::size_t begin = 0; begin < path.size();) {
      const auto end = std::min(path.find('.', begin), path.size());
      const auto key = path.substr(begin, end - begin);
      auto* child = node->find(key);
      if (child == nullptr)
        child = &node->entries.emplace_back(deck::Tree::Entry{key, at, {}}).value;
      child->at = child->at.file.empty() ? at : child->at;
      node = child;
      begin = end + 1;
    }
    node->at = at;
  }
  return tree;
}

/// The deck that the steps make, with changes. Lines of that text mean nothing to whoever wrote the .inp
/// file.
deck::Deck changed(deck::Deck deck, const std::filesystem::path& file, std::span<const deck::Setting> changes,
                   std::span<const std::string> only) {
  for (auto& study : deck.runs)
    study.mesh.file = file.filename().string();
  try {
    auto with_changes = deck::parse_deck(deck_text(deck.runs), file.string(), changes, only);
    with_changes.title = deck.title;
    with_changes.notes.insert(with_changes.notes.begin(), deck.notes.begin(), deck.notes.end());
    with_changes.places.clear();
    for (const auto& study : with_changes.runs) {
      const auto run = std::ranges::find(deck.runs, study.name, &study::Study::name);
      with_changes.places.push_back(deck.places[static_cast<std::size_t>(run - deck.runs.begin())]);
    }
    return with_changes;
  } catch (const InputError& error) {
    auto faults = error.faults();
    for (auto& fault : faults)
      if (fault.at.file == file.string())
        fault.at = {file.string(), 0, 0};
    throw InputError(std::move(faults));
  }
}

deck::Deck deck_of(inp::Input input, const std::filesystem::path& file,
                   std::span<const deck::Setting> changes, std::span<const std::string> only) {
  deck::Deck deck{std::move(input.title), std::move(input.runs), {}, std::move(input.notes)};
  for (const auto& places : input.places)
    deck.places.emplace_back(tree_of(places));
  return changes.empty() && only.empty() ? deck : changed(std::move(deck), file, changes, only);
}

std::vector<deck::Setting> changes_of(std::span<const std::string> settings) {
  std::vector<deck::Setting> changes;
  for (const auto& text : settings)
    changes.push_back(deck::parse_setting(text));
  return changes;
}

/// The echo of a run without the name of the run, which comes last.
std::string entries_of(const study::Study& study) {
  auto text = study::to_json(study);
  text.erase(text.rfind(",\n  \"runs\":"));
  return text + "\n}";
}

} // namespace

bool is_standard_input(const std::filesystem::path& argument) {
  return argument == "-";
}

bool is_inp(const std::filesystem::path& argument) {
  auto ending = argument.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char letter) { return std::tolower(letter); });
  return ending == ".inp";
}

deck::Deck read_deck(const std::filesystem::path& argument, std::span<const std::string> settings,
                     std::span<const std::string> only) {
  const auto changes = changes_of(settings);
  if (is_inp(argument))
    return deck_of(inp::read_input(argument), argument, changes, only);
  if (!is_standard_input(argument))
    return deck::read_deck(argument, changes, only);
  const std::string text(std::istreambuf_iterator<char>(std::cin), {});
  return deck::parse_deck(text, "<stdin>", changes, only);
}

ModesDeck read_modes_deck(const std::filesystem::path& argument, std::span<const std::string> settings,
                          std::span<const std::string> only) {
  if (!is_inp(argument))
    return {read_deck(argument, settings, only), std::nullopt};
  auto input = inp::read_input(argument, inp::Purpose::modes);
  const auto number = input.mode_count;
  return {deck_of(std::move(input), argument, changes_of(settings), only), number};
}

std::string deck_text(std::span<const study::Study> runs) {
  if (runs.size() == 1)
    return study::to_json(runs.front());
  std::string text;
  for (const auto& study : runs)
    text += fmt::format("{}\"{}\": {}", text.empty() ? "" : ",\n", study.name, entries_of(study));
  return fmt::format("{{\"runs\": {{\n{}\n}}}}\n", text);
}

} // namespace rubato::app
