// SPDX-License-Identifier: LGPL-3.0-or-later
/// The line that shows how far a run is.
#pragma once

#include "rubato/run/progress_text.hpp"

#include <chrono>
#include <cstddef>
#include <string>

namespace rubato::app {

/// Columns of the terminal; a longer line would wrap and could not be rewritten.
std::size_t terminal_columns();

/// On a terminal one line that is rewritten; elsewhere a plain line now and then. Everything goes to standard
/// error, so that standard output keeps the results.
class ProgressLine {
public:
  explicit ProgressLine(bool quiet);
  void update(const run::Progress& progress);
  /// Prints a sentence of its own, as a run does that is about to take its first step.
  void say(const std::string& text);
  /// Prints what is to be known even when nothing else is.
  void warn(const std::string& text);
  /// Ends the rewritten line.
  void close();

private:
  using Clock = run::Pace::Clock;

  bool quiet_;
  bool terminal_;
  bool open_ = false;
  Clock::time_point start_ = Clock::now(); ///< when the run's first step began
  run::Pace pace_;
};

} // namespace rubato::app
