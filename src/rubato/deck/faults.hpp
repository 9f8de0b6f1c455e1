// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is wrong with a deck, gathered until everything has been read.
#pragma once

#include "rubato/core/error.hpp"
#include "rubato/core/naming.hpp"

#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace rubato::deck {

/// Faults by place. A part of the deck that several runs inherit is read once for each of them, so the same
/// sentence at the same place is kept once, with the runs that met it.
class Faults {
public:
  void add(const Location& at, const std::string& text);

  /// The same of a number that could not be read: what it may be is told by add_bounds.
  void add_number(const Location& at, const std::string& text, std::string path);
  /// Completes the sentences about numbers of the run by what they may be, by path.
  void add_bounds(const std::map<std::string, std::string>& bounds);

  /// The value there could not be read: no rule that is about it can be judged.
  void spoil(std::string path);
  bool is_spoiled(std::string_view path) const;

  /// Adds the faults of others at places where nothing is wrong yet. They are of every run.
  void add_untold(const Faults& others);

  /// What is added from here on was met while reading that run.
  void enter_run(std::string name);

  bool empty() const { return met_by_.empty(); }

  /// Throws one InputError with every fault in the order of the file. A fault that only some of the runs have
  /// says which.
  void throw_if_any() const;

private:
  struct Number {
    Location at;
    std::string text;
    std::string path;
  };
  using Key = std::tuple<std::string, int, int, std::string>; // file, line, column, sentence
  std::map<Key, std::vector<std::string>> met_by_;
  std::vector<std::string> runs_;
  std::vector<Number> numbers_;                ///< that could not be read, of the run that is being read
  std::set<std::string, std::less<>> spoiled_; ///< paths in the run that is being read
};

} // namespace rubato::deck
