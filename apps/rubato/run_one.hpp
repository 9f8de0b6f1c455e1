// SPDX-License-Identifier: LGPL-3.0-or-later
/// One run of a deck: its folder, what is said at its end, and its exit code.
#pragma once

#include "rubato/run/run_study.hpp"
#include "rubato/study/study.hpp"

#include "commands.hpp"
#include "progress.hpp"
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::app {

/// What the runs of a deck have in common.
struct RunSettings {
  std::filesystem::path output; ///< has a folder for each run
  run::Begin begin = run::Begin::anew;
  std::vector<std::string> only; ///< runs that are asked for; empty: all
  bool quiet = false;
  int threads = 1; ///< of each run, on each rank
  Ranks ranks = {};
};

struct RunEnd {
  int code = done;
  bool complete = false;
  bool kept = false; ///< its checkpoint has the state
  step::State state;
};

/// A watch whose lines go to `line`; it asks nobody whether to stop. `line` must outlive it.
run::Watch watch_of(ProgressLine& line);

/// Runs the study, prints its summary or why it is not complete.
RunEnd run_one(const study::Study& study, const RunSettings& settings, const run::Watch& watch,
               ProgressLine& line, const step::State* previous);

/// That a run did not start for want of the end of the one it starts from.
void print_not_run(const study::Study& study);

} // namespace rubato::app
