// SPDX-License-Identifier: LGPL-3.0-or-later
#include "read_deck.hpp"

#include "rubato/study/echo.hpp"

#include <fmt/format.h>

#include "read_inp.hpp"
#include <algorithm>
#include <cctype>
#include <iostream>
#include <iterator>
#include <vector>

namespace rubato::app {
namespace {

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
  if (is_inp(argument)) {
    const auto steps = read_inp(argument, inp::Purpose::run, changes, only);
    return steps.modes.size() < steps.deck.runs.size() ? without_modes(steps) : steps.deck;
  }
  if (!is_standard_input(argument))
    return deck::read_deck(argument, changes, only);
  const std::string text(std::istreambuf_iterator<char>(std::cin), {});
  return deck::parse_deck(text, "<stdin>", changes, only);
}

StepsDeck read_steps_deck(const std::filesystem::path& argument, std::span<const std::string> settings,
                          std::span<const std::string> only) {
  if (!is_inp(argument))
    return {read_deck(argument, settings, only), {}};
  return read_inp(argument, inp::Purpose::run, changes_of(settings), only);
}

StepsDeck read_modes_deck(const std::filesystem::path& argument, std::span<const std::string> settings,
                          std::span<const std::string> only) {
  if (!is_inp(argument))
    return {read_deck(argument, settings, only), {}};
  return read_inp(argument, inp::Purpose::modes, changes_of(settings), only);
}

deck::Deck without_modes(const StepsDeck& steps) {
  deck::Deck deck{steps.deck.title, {}, {}, steps.deck.notes};
  for (std::size_t i = 0; i < steps.deck.runs.size(); ++i)
    if (!steps.modes.contains(steps.deck.runs[i].name)) {
      deck.runs.push_back(steps.deck.runs[i]);
      deck.places.push_back(steps.deck.places[i]);
    }
  return deck;
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
