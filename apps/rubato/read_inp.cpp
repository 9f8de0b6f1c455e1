// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read_inp.hpp"

#include <algorithm>
#include <utility>

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

/// The deck of the steps, with changes. Faults of its text name the .inp file without a line, because lines
/// of the text are not those of the file.
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

} // namespace

StepsDeck read_inp(const std::filesystem::path& file, inp::Purpose purpose,
                   std::span<const deck::Setting> changes, std::span<const std::string> only) {
  auto input = inp::read_input(file, purpose);
  auto modes = input.modes;
  auto deck = deck_of(std::move(input), file, changes, only);
  std::erase_if(modes, [&](const auto& entry) {
    return std::ranges::find(deck.runs, entry.first, &study::Study::name) == deck.runs.end();
  });
  return {std::move(deck), std::move(modes)};
}

} // namespace rubato::app
