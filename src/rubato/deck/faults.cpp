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

void Faults::add_number(const Location& at, const std::string& text, std::string path) {
  spoil(path);
  numbers_.push_back({at, text, std::move(path)});
}

void Faults::add_bounds(const std::map<std::string, std::string>& bounds) {
  for (const auto& number : numbers_) {
    const auto found = bounds.find(number.path);
    add(number.at, number.text + (found == bounds.end() ? "" : found->second));
  }
  numbers_.clear();
}

void Faults::spoil(std::string path) {
  spoiled_.insert(std::move(path));
}

/// The value itself or one it is a part of.
bool Faults::is_spoiled(std::string_view path) const {
  while (!spoiled_.contains(path)) {
    const auto dot = path.rfind('.');
    if (dot == std::string_view::npos)
      return spoiled_.contains("");
    path = path.substr(0, dot);
  }
  return true;
}

void Faults::add_untold(const Faults& others) {
  std::map<Key, std::vector<std::string>> untold;
  for (const auto& [key, runs] : others.met_by_) {
    const auto& [file, line, column, text] = key;
    const auto near = met_by_.lower_bound(Key{file, line, column, ""});
    const bool told =
        near != met_by_.end() && std::tie(std::get<0>(near->first), std::get<1>(near->first),
                                          std::get<2>(near->first)) == std::tie(file, line, column);
    if (!told)
      untold.emplace(key, runs);
  }
  met_by_.merge(untold);
}

void Faults::enter_run(std::string name) {
  spoiled_.clear();
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

} // namespace rubato::deck
