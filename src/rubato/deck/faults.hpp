// SPDX-License-Identifier: LGPL-3.0-or-later
/// What is wrong with a deck, gathered until everything has been read.
#pragma once

#include "rubato/core/error.hpp"

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace rubato::deck {

/// Faults by place. A part of the deck that several runs inherit is read once for each of them, so the same
/// sentence at the same place is kept once, with the runs that met it.
class Faults {
public:
  void add(const Location& at, const std::string& text);

  /// What is added from here on was met while reading that run.
  void enter_run(std::string name);

  bool empty() const { return met_by_.empty(); }

  /// Throws one InputError with every fault in the order of the file. A fault that only some of the runs have
  /// says which.
  void throw_if_any() const;

private:
  using Key = std::tuple<std::string, int, int, std::string>; // file, line, column, sentence
  std::map<Key, std::vector<std::string>> met_by_;
  std::vector<std::string> runs_;
};

/// `word` between quotes as a sentence may show it: long ones are cut.
std::string shown(const std::string& word);

/// "; did you mean 'step'?", or, when no candidate is near, "; expected one of a, b, c".
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

} // namespace rubato::deck
