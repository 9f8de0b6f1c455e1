// SPDX-License-Identifier: LGPL-3.0-or-later
/// The whole story of a run: build the model, step through time, record, check.
#pragma once

#include "rubato/core/ranks.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/checks.hpp"
#include "rubato/results/run_status.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"
#include "rubato/study/study.hpp"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace rubato::run {

/// What a running computation tells whoever watches it.
struct Progress {
  std::string_view run;
  double t = 0;
  double begin = 0;
  double end = 0;
  double step = 0;
  int iterations = 0;
  int contact_points = 0; ///< in contact
  int cut_level = 0;
  bool accepted = true;
  const step::StepReport* report = nullptr;
  bool within = false; ///< inside the step to t, which is not known yet to be accepted
  double residual = std::numeric_limits<double>::quiet_NaN(); ///< inside a step, where it is known
};

struct Watch {
  /// After each attempt at a step.
  std::function<void(const Progress&)> progress = [](const Progress&) {};
  /// Inside an attempt, at least once an iteration.
  std::function<void(const Progress&)> within = [](const Progress&) {};
  std::function<void(const std::string&)> say = [](const std::string&) {};
  std::function<void(const std::string&)> warn = [](const std::string&) {};
  std::function<bool()> stop = [] { return false; };
  /// Before memory is taken for a factor [bytes]: may wait until there is some. With 0 once steps begin, when
  /// all that is known of has been taken. Throws StoppedWhileWaiting.
  std::function<void(std::size_t)> room = [](std::size_t) {};
};

/// A run is to stop, and waited for memory.
class StoppedWhileWaiting : public std::exception {
public:
  const char* what() const noexcept override { return "the run was stopped while it waited for memory"; }
};

using Status = results::RunStatus;

struct RunResult {
  Status status = Status::complete;
  std::string message; ///< why the run is not complete
  int steps = 0;
  int iterations = 0;
  int cuts = 0;
  bool kept = false;        ///< there is a checkpoint to go on from
  double setup_seconds = 0; ///< processor time
  double loop_seconds = 0;
  double elapsed_seconds = 0; ///< of this process on the run, by the clock
  std::vector<results::CheckResult> checks;
  step::EnergyRecord energy; ///< how well its ledger closes, and what it gained
  step::State end;           ///< the last accepted state

  bool checks_hold() const;
};

/// Where a run begins: at its beginning, or at the checkpoint in its folder if there is one; or at its
/// beginning unless its folder has it, complete and unchanged.
enum class Begin { anew, resumed, unless_done };

/// Runs one study into a folder of its own. `previous`: the end of the run it starts from, when it does.
/// Throws InputError, before the folder is made or touched, for a study that cannot be run, for an end that
/// does not fit it, and for a checkpoint it cannot go on from; StoppedWhileWaiting, when the watch does
/// before the first step. Several ranks call this alike: the first one writes the folder and asks whether to
/// stop, and it alone has results of checks; others read a folder that it goes on from, too. A run that came
/// to its end is not run again when it is resumed, nor `unless_done` when deck, mesh and the end it starts
/// from are those it had.
RunResult run_study(const study::Study& study, const std::filesystem::path& folder, const Watch& watch,
                    const step::State* previous = nullptr, Begin begin = Begin::anew,
                    const Workers& workers = {});
/// The same on a mesh that is already there. A run is resumed on an equal one.
RunResult run_study(const study::Study& study, mesh::Mesh mesh, const std::filesystem::path& folder,
                    const Watch& watch, const step::State* previous = nullptr, Begin begin = Begin::anew,
                    const Workers& workers = {});

} // namespace rubato::run
