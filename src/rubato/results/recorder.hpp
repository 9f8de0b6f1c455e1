// SPDX-License-Identifier: LGPL-3.0-or-later
/// Writes a run's folder as the run goes: probes, contact resultants, steps, fields. Nobody below reads it.
///
///   probes.csv             t, then <probe>.x, <probe>.y[, <probe>.z] of every probe
///   resultants_<zone>.csv  t; points in contact, sticking; force of the master on the slave x, y[, z];
///                          normal part (Σ|N|); friction part (|∫ tangential traction|); largest pressure;
///                          smallest gap
///   contact_<zone>.csv     at the chosen instants, one line a contact point (contact_table.hpp)
///   energy.csv             t and the parts of the energy ledger
///   steps.jsonl            one JSON object a step tried, accepted or not
///   tables.dat             tables in the layout of CalculiX's .dat file (tables.hpp)
///   fields/*.vtu, *.pvd    and fields.med, fields.vtkhdf, fields.frd, at the chosen instants
///   run.json               status, the study, versions, timings, iterations, checks of the deck and of the
///                          run itself; there from the start, with status "running"
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/results/checks.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/results/failure.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/results/run_status.hpp"
#include "rubato/simulation/attempt.hpp"
#include "rubato/step/energy_ledger.hpp"
#include "rubato/step/report.hpp"
#include "rubato/step/state.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rubato::results {

/// How a run ended.
struct Ending {
  RunStatus status = RunStatus::running;
  std::string reason = {}; ///< why it is not complete, in a sentence
  double setup_seconds = 0;
  double loop_seconds = 0;
  double elapsed_seconds = 0; ///< of the process that ended it, by the clock
  int steps = 0;
  int iterations = 0;
  int cuts = 0;
  std::optional<Failure> failure = {};
  std::vector<Plausibility> plausibility = {};
  double sent_bytes = 0; ///< by ranks to one another in the loop of steps, but for what solvers send
};

/// How far the files of a run have come.
struct RecorderPosition {
  int steps = 0;
  int vtkhdf_instants = 0; ///< of fields.vtkhdf; what that has beyond is gone then
  // Bytes:
  std::uintmax_t probes = 0;
  std::uintmax_t attempts = 0;
  std::uintmax_t energy = 0;
  std::vector<std::uintmax_t> resultants; ///< one a zone
  std::vector<std::uintmax_t> contact;    ///< one a zone
  std::string ccx; ///< bytes of tables.dat; bytes, instants and blocks of fields.frd; empty: no such files
  std::vector<double> field_times; ///< of the .vtu files
  std::vector<std::string> field_files;
  std::string med_copy;    ///< of fields.med, made when that grows again; empty: no such file
  std::string vtkhdf_copy; ///< likewise of fields.vtkhdf
  bool unwritten = false;  ///< whether the last step has no fields that it may still get
};

/// What cannot be written is told by WriteError, by each member function.
class Recorder {
public:
  /// Creates the folder and its files; those of a run that was there before are gone then. Throws InputError
  /// when that cannot be done.
  Recorder(const model::Model& model, std::filesystem::path folder);
  /// Goes on where a run stood; what its files hold beyond is gone then. Throws InputError when a file is
  /// shorter than it was.
  Recorder(const model::Model& model, std::filesystem::path folder, const RecorderPosition& position);
  ~Recorder();
  Recorder(Recorder&&) noexcept;
  Recorder& operator=(Recorder&&) noexcept;

  /// Of the factor of the effective matrix [bytes]; in run.json from now on. 0: there is none.
  void needs_memory(std::size_t bytes);
  /// How steps are made; in run.json from now on.
  void takes_steps_by(const std::string& method);
  /// Keeps a warning in run.json, each sentence once, also those of a run before it was resumed. A disk that
  /// is full at this moment is no failure: the end of the run writes it.
  void warn(const std::string& text);
  void start(const step::State& state);
  /// `last` tells whether this is the run's last instant.
  void step(const step::State& before, const step::State& now, const simulation::Attempt& attempt,
            const step::StepReport& report, bool last);
  void energy(double t, const step::EnergyLedger& ledger);
  /// Takes back what was written of the last attempt, whole or not: by step() and energy(), or by failed().
  void take_back();
  void failed(const simulation::Attempt& attempt, const step::StepReport& report);
  /// For a checkpoint. fields.med is copied for it before it grows again.
  RecorderPosition position();
  /// Evaluates the checks and writes run.json. Of a run that stopped early the last instant reached, whose
  /// state is `last`, gets its fields when the last one is wanted.
  std::vector<CheckResult> finish(const Ending& ending, const step::State& last);

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace rubato::results
