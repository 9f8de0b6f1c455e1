// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far a run is, in one line of text.
#pragma once

#include "rubato/run/watch.hpp"

#include <chrono>
#include <cstddef>
#include <span>
#include <string>

namespace rubato::run {

/// When a line is due.
class Pace {
public:
  using Clock = std::chrono::steady_clock;

  /// A terminal rewrites its line 20 times a second; a file gets a line a second as steps end, and inside a
  /// step one that comes 5 s after the last one, or before when waiting for the next would take longer.
  explicit Pace(bool terminal) : terminal_(terminal) {}

  /// The run's first step begins: its end is shown, whenever it comes.
  void begin(Clock::time_point now) {
    last_ = heard_ = now;
    shown_ = false;
  }
  /// Whether to show it; then it counts as shown. Failed attempts and the end of a run always are.
  bool is_due(const Progress& progress, Clock::time_point now);

private:
  bool terminal_;
  bool shown_ = false; ///< whether any line was
  Clock::time_point last_ = Clock::now();
  Clock::time_point heard_ = last_; ///< when the last progress came, shown or not
};

/// "42 s", "3:07 min", "1:02:03 h". `seconds` ≥ 0.
std::string duration_text(double seconds);

/// The line for a terminal of `columns` columns. It is shorter than that, as a line that wraps could not be
/// rewritten; the time left stays in it: the bar shortens first, then the step length, the points in contact
/// and the iterations go, and at last the name of the run is cut. `seconds`: time since the first step began.
std::string terminal_line(const Progress& progress, double seconds, std::size_t columns);

/// The part of the run that is done, in 0…1.
double part_done(const Progress& progress);

/// One of the runs that are computed at once.
struct RunPart {
  std::string name;
  bool begun = false; ///< the first step has
  double part = 0;    ///< that is done
  double seconds = 0; ///< since the first step began
};

/// A line for all of them, and for `waiting` others that have not started, shorter than `columns`. The times
/// left go first, then names are cut.
std::string terminal_line(std::span<const RunPart> runs, std::size_t waiting, std::size_t columns);

/// The line of one run for a file: a percentage instead of the bar, and everything whatever its length.
std::string plain_line(const Progress& progress, double seconds);

} // namespace rubato::run
