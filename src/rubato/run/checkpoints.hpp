// SPDX-License-Identifier: LGPL-3.0-or-later
/// When a run keeps checkpoints, and which ones it may go on from.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/results/checkpoint.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/run/run_study.hpp"
#include "rubato/study/study.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace rubato::run {

/// A run and where it is kept.
struct RunContext {
  std::filesystem::path folder;
  std::uint32_t mesh = 0;                    ///< fingerprint
  std::uint32_t start = 0;                   ///< fingerprint of the other run's end it starts from, or 0
  std::optional<results::Checkpoint> from;   ///< where it goes on, when it is resumed
  std::optional<results::FolderClaim> claim; ///< of the folder, by the first rank
};

/// The checkpoint in the run's folder; nothing when there is none. Throws InputError, with the reason, when
/// it is not one this run can go on from.
std::optional<results::Checkpoint> find_checkpoint(const study::Study& study, const RunContext& course);

/// The run as it was left in its folder, when it came to the end that the study wants.
std::optional<RunResult> finished_run(const study::Study& study, const RunContext& course);

/// The same of a run that the study would make again with every result: `course.from` is its checkpoint then,
/// else nothing, as when the folder holds no run, another one, or one that was not finished.
std::optional<RunResult> unchanged_run(const study::Study& study, RunContext& course);

/// Writes the checkpoints of a run.
class CheckpointWriter {
public:
  /// Everything must outlive this.
  CheckpointWriter(const study::Study& study, const RunContext& course, const Watch& watch);

  /// Whether the step that led to t in `step`, the run's `count`-th, is one to keep: no step is made shorter
  /// for a checkpoint, so that results don't depend on it.
  bool is_due(int count, double t, double step) const;
  bool keeps_end() const { return settings_.last; }
  /// Whether the state before a step that could not be made is one to keep. Explicit motion has grown beyond
  /// bounds long before that shows: nothing good comes of going on from there.
  bool keeps_failure() const { return settings_.last && !is_explicit_; }

  /// Writes a checkpoint, completed with what tells runs apart. When that fails whoever watches is warned,
  /// and the run goes on: the former one is still there. Tells whether there is one to go on from.
  bool keep(const std::function<results::Checkpoint()>& make) const;

private:
  const study::CheckpointOutput& settings_;
  const RunContext& course_;
  const Watch& watch_;
  std::string study_; ///< its echo
  bool is_explicit_;
};

} // namespace rubato::run
