// SPDX-License-Identifier: LGPL-3.0-or-later
/// A library that the loader refuses, for programs that are started while it lives.
#pragma once

#include "support/scratch_folder.hpp"
#include <cstdlib>
#include <fstream>
#include <optional>
#include <string>

namespace rubato::test {

/// Puts a text file under the name of the library where the loader searches first.
class BrokenLibrary {
public:
  explicit BrokenLibrary(const std::string& soname) {
    std::ofstream(folder_ / soname) << "no library\n";
    if (const char* before = std::getenv(path_variable))
      before_ = before;
    setenv(path_variable, (folder_.path().string() + (before_ ? ":" + *before_ : "")).c_str(), 1);
  }
  ~BrokenLibrary() {
    if (before_)
      setenv(path_variable, before_->c_str(), 1);
    else
      unsetenv(path_variable);
  }
  BrokenLibrary(const BrokenLibrary&) = delete;
  BrokenLibrary& operator=(const BrokenLibrary&) = delete;

private:
  static constexpr const char* path_variable = "LD_LIBRARY_PATH";
  ScratchFolder folder_;
  std::optional<std::string> before_;
};

} // namespace rubato::test
