// SPDX-License-Identifier: LGPL-3.0-or-later
/// Runs a study: builds the model, steps through time, records, checks.
#pragma once

#include "rubato/core/ranks.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/results/checks.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/results/run_status.hpp"
#include "rubato/run/watch.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/state.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rubato::study {
struct Study;
} // namespace rubato::study

namespace rubato::run {

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
  std::vector<results::Plausibility> plausibility; ///< of the run itself; results of the first rank
  step::EnergyRecord energy;                       ///< how well its ledger closes, and what it gained
  step::State end;                                 ///< the last accepted state

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
