// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/places.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace rubato::deck {
namespace {

/// The maps whose keys are names the user chose.
constexpr std::array<std::string_view, 4> parts_of_named{"materials", "contact", "probes", "mesh.groups"};

} // namespace

Places::Places(const Tree& tree) {
  add("", tree.at, tree);
}

void Places::add(const std::string& path, const Location& at, const Tree& tree) {
  by_path_[path] = at;
  const bool has_names = std::ranges::find(parts_of_named, path) != parts_of_named.end();
  for (const auto& entry : tree.entries)
    add(joined(path, entry.key), has_names ? entry.at : entry.value.at, entry.value);
  for (std::size_t i = 0; i < tree.items.size(); ++i)
    add(joined(path, std::to_string(i)), tree.items[i].at, tree.items[i]);
}

Location Places::of(std::string_view path) const {
  for (;;) {
    if (const auto found = by_path_.find(path); found != by_path_.end())
      return found->second;
    const auto dot = path.rfind('.');
    path = dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
    if (path.empty())
      break;
  }
  const auto whole = by_path_.find("");
  return whole == by_path_.end() ? Location{} : whole->second;
}

InputError Places::located(const InputError& error) const {
  auto faults = error.faults();
  for (auto& fault : faults)
    if (to_string(fault.at).empty() && !fault.path.empty())
      fault.at = of(fault.path);
  return InputError(std::move(faults));
}

void throw_if_any(const std::vector<std::vector<Fault>>& faults, const std::vector<Places>& places) {
  std::vector<Fault> all;
  for (std::size_t run = 0; run < faults.size(); ++run) {
    const auto located = places[run].located(InputError(faults[run]));
    for (const auto& fault : located.faults()) {
      const auto same = [&](const Fault& known) {
        return known.text == fault.text && place_of(known) == place_of(fault);
      };
      if (std::ranges::none_of(all, same))
        all.push_back(fault);
    }
  }
  if (!all.empty())
    throw InputError(std::move(all));
}

} // namespace rubato::deck
