// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/run/checkpoints.hpp"

#include "rubato/results/run_folder.hpp"
#include "rubato/results/stored_run.hpp"
#include "rubato/results/study_difference.hpp"
#include "rubato/study/echo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

namespace rubato::run {
namespace {

/// Ends that differ by less than this part of the run are the same.
constexpr double same_end = 1e-9;
/// An instant as far beyond the end of a step is its end.
constexpr double part_of_step = 1e-6;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw InputError(fmt::format(
      "{}: the checkpoint is of another run: {}; without --resume the run starts over", file.string(), why));
}

bool reaches_end(const study::TimeStepping& time, double t) {
  return t >= time.end - same_end * (time.end - time.begin);
}

} // namespace

std::optional<results::Checkpoint> find_checkpoint(const study::Study& study, const RunContext& course) {
  const auto file = course.folder / results::checkpoint_file;
  if (!std::filesystem::exists(file))
    return std::nullopt;
  auto checkpoint = results::read_checkpoint(file);
  if (const auto difference = results::study_difference(checkpoint.study, study::to_json(study)))
    refuse(file, *difference);
  if (checkpoint.mesh != course.mesh)
    refuse(file, "its mesh had other nodes, cells or groups");
  if (checkpoint.start != course.start)
    refuse(file, fmt::format("it began with another end of run '{}'", study.time.start_run));
  if (checkpoint.memento.state.t > study.time.end + same_end * (study.time.end - study.time.begin))
    throw InputError({fault_at(
        "time.end", fmt::format("time.end: found {:g}, but the checkpoint stands at t = {:g} already",
                                study.time.end, checkpoint.memento.state.t))});
  return checkpoint;
}

std::optional<RunResult> finished_run(const study::Study& study, const RunContext& course) {
  if (!course.from || !reaches_end(study.time, course.from->memento.state.t) ||
      !std::filesystem::exists(course.folder / results::summary_file))
    return std::nullopt;
  const auto stored = results::read_stored_run(course.folder);
  if (stored.status != Status::complete)
    return std::nullopt;
  const auto& spent = course.from->memento.counters;
  RunResult result;
  result.steps = spent.steps;
  result.iterations = spent.iterations;
  result.cuts = spent.cuts;
  result.kept = true;
  result.setup_seconds = course.from->setup_seconds;
  result.loop_seconds = course.from->loop_seconds;
  result.checks = results::evaluate_checks(study.checks, stored.probes, course.folder);
  result.energy = course.from->record;
  result.end = course.from->memento.state;
  return result;
}

std::optional<RunResult> unchanged_run(const study::Study& study, RunContext& course) {
  try {
    course.from = find_checkpoint(study, course);
    if (course.from && results::same_results_expected(course.from->study, study::to_json(study)))
      if (auto finished = finished_run(study, course))
        return finished;
  } catch (const InputError&) { // of another run, or damaged: what it says is of no use here
  }
  course.from.reset();
  return std::nullopt;
}

CheckpointWriter::CheckpointWriter(const study::Study& study, const RunContext& course, const Watch& watch)
    : settings_(study.checkpoint), course_(course), watch_(watch), study_(study::to_json(study)),
      is_explicit_(study::is_explicit(study.time.scheme)) {}

bool CheckpointWriter::is_due(int count, double t, double step) const {
  const double near = part_of_step * step;
  const auto just_passed = [&](double at) { return at > t - step + near && at <= t + near; };
  return (settings_.every > 0 && count % settings_.every == 0) ||
         std::ranges::any_of(settings_.at, just_passed);
}

bool CheckpointWriter::keep(const std::function<results::Checkpoint()>& make) const {
  try {
    auto checkpoint = make();
    checkpoint.study = study_;
    checkpoint.mesh = course_.mesh;
    checkpoint.start = course_.start;
    const std::array copies{checkpoint.recorder.med_copy, checkpoint.recorder.vtkhdf_copy};
    results::write_checkpoint(course_.folder / results::checkpoint_file, std::move(checkpoint));
    results::remove_copies_of_fields(course_.folder, copies);
    return true;
  } catch (const std::exception& error) {
    watch_.warn(fmt::format("no checkpoint was written: {}", error.what()));
    return std::filesystem::exists(course_.folder / results::checkpoint_file);
  }
}

} // namespace rubato::run
