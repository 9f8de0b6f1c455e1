// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/faults.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace rubato::deck {

void Faults::add(const Location& at, const std::string& text) {
  auto& runs = met_by_[Key{at.file, at.line, at.column, text}];
  if (!runs_.empty() && (runs.empty() || runs.back() != runs_.back()))
    runs.push_back(runs_.back());
}

void Faults::enter_run(std::string name) {
  runs_.push_back(std::move(name));
}

void Faults::throw_if_any() const {
  if (empty())
    return;
  std::vector<Fault> faults;
  for (const auto& [key, runs] : met_by_) {
    const auto& [file, line, column, text] = key;
    const bool by_some = !runs.empty() && runs.size() < runs_.size();
    const auto* plural = runs.size() > 1 ? "s" : "";
    const auto who = by_some ? fmt::format(" (run{} {})", plural, fmt::join(runs, ", ")) : "";
    faults.push_back({{file, line, column}, text + who});
  }
  throw InputError(std::move(faults));
}

std::string shown(const std::string& word) {
  constexpr std::size_t longest = 60;
  if (word.size() <= longest)
    return fmt::format("'{}'", word);
  auto end = longest;
  const auto inside_character = [&](std::size_t i) {
    return (static_cast<unsigned char>(word[i]) & 0xC0U) == 0x80U;
  };
  while (end > 0 && inside_character(end))
    --end;
  return fmt::format("'{}…'", word.substr(0, end));
}

std::string suggestion(const std::string& word, const std::vector<std::string>& candidates) {
  const auto nearest = nearest_word(word, candidates);
  if (!nearest.empty())
    return fmt::format("; did you mean '{}'?", nearest);
  return candidates.empty() ? "" : fmt::format("; expected one of {}", fmt::join(candidates, ", "));
}

} // namespace rubato::deck
