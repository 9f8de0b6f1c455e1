// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the values of a study are written.
#pragma once

#include "rubato/core/error.hpp"
#include "rubato/deck/tree.hpp"

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::deck {

/// The places of one run's values, by their paths: "contact.slide.slave", "supports.0.on".
class Places {
public:
  Places() = default;
  explicit Places(const Tree& tree);

  /// Of the value, or of the nearest one around it that is written. Entries of maps whose keys are names the
  /// user chose are where their names are.
  Location of(std::string_view path) const;

  /// The error with a place for each fault that has only a path.
  InputError located(const InputError& error) const;

private:
  void add(const std::string& path, const Location& at, const Tree& tree);

  std::map<std::string, Location, std::less<>> by_path_;
};

/// Throws one InputError with the faults of all runs, each at its place. A fault of a part that several runs
/// have is told once.
void throw_if_any(const std::vector<std::vector<Fault>>& faults, const std::vector<Places>& places);

} // namespace rubato::deck
