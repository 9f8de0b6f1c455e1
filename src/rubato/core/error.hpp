// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a user did wrong, and where. Programs end on it with exit code 2 and these sentences.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace rubato {

/// A place in an input file. Lines and columns count from 1; 0 means unknown.
struct Location {
  std::string file;
  int line = 0;
  int column = 0;
  /// Two inputs that say the same thing are equal wherever they stand.
  bool operator==(const Location&) const { return true; }
};

/// "file:line:column", as much of it as is known; empty when nothing is.
std::string to_string(const Location& at);

/// One fault of an input: a whole sentence that says what was found and what was expected.
struct Fault {
  Location at;
  std::string text;
};

/// Bad input: one or several faults, reported together.
class InputError : public std::runtime_error {
public:
  explicit InputError(std::vector<Fault> faults);
  explicit InputError(std::string text, Location at = {});
  const std::vector<Fault>& faults() const { return faults_; }

private:
  std::vector<Fault> faults_;
};

/// The candidate nearest to `word` by edit distance, or an empty string when none is near enough to be meant.
std::string nearest_word(const std::string& word, const std::vector<std::string>& candidates);

} // namespace rubato
