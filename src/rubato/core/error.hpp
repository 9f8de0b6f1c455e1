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
};

/// "file:line:column", as much of it as is known; empty when nothing is.
std::string to_string(const Location& at);

/// One fault of an input: a whole sentence that says what was found and what was expected.
struct Fault {
  Location at;
  std::string text;
  std::string path =
      {}; ///< of the value in the study, "supports.0.on", where its place in a file is not known
};

/// A fault of the value of a study at that path.
Fault fault_at(std::string path, std::string text);

/// "file:line:column", the path where that is not known, or nothing.
std::string place_of(const Fault& fault);

/// Bad input: one or several faults, reported together.
class InputError : public std::runtime_error {
public:
  explicit InputError(std::vector<Fault> faults);
  explicit InputError(std::string text, Location at = {});
  const std::vector<Fault>& faults() const { return faults_; }

private:
  std::vector<Fault> faults_;
};

} // namespace rubato
