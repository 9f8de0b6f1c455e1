// SPDX-License-Identifier: LGPL-3.0-or-later
#include "run_one.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rubato::app {
namespace {

int exit_code_of(const run::RunResult& result) {
  switch (result.status) {
  case run::Status::not_converged:
    return no_convergence;
  case run::Status::interrupted:
  case run::Status::running:
    return other_failure;
  case run::Status::complete:
    break;
  }
  return result.checks_hold() ? done : check_failed;
}

void print_summary(const study::Study& study, const run::RunResult& result,
                   const std::filesystem::path& folder) {
  fmt::print("{}: {} steps, {} iterations, {} cuts; set-up {:.3f} s, loop {:.3f} s; results in {}\n",
             study.name, result.steps, result.iterations, result.cuts, result.setup_seconds,
             result.loop_seconds, folder.string());
  if (!result.checks.empty())
    fmt::print("{}", results::to_text(result.checks));
}

/// Runs that others start from are not computed again for them alone.
run::Begin begin_of(const std::string& run, const RunSettings& settings) {
  const bool asked = settings.only.empty() || std::ranges::find(settings.only, run) != settings.only.end();
  return asked || settings.begin == run::Begin::resumed ? settings.begin : run::Begin::unless_done;
}

} // namespace

run::Watch watch_of(ProgressLine& line) {
  run::Watch watch;
  watch.progress = [&line](const run::Progress& progress) { line.update(progress); };
  watch.within = watch.progress;
  watch.say = [&line](const std::string& text) { line.say(text); };
  watch.warn = [&line](const std::string& text) { line.warn(text); };
  return watch;
}

RunEnd run_one(const study::Study& study, const RunSettings& settings, const run::Watch& watch,
               ProgressLine& line, const step::State* previous) {
  const auto folder = settings.output / study.name;
  auto result = run::run_study(study, folder, watch, previous, begin_of(study.name, settings),
                               {Threads(settings.threads), settings.ranks});
  line.close();
  if (!settings.quiet || !result.checks.empty())
    print_summary(study, result, folder);
  const bool complete = result.status == run::Status::complete;
  if (!complete)
    fmt::print(stderr, "error: {}: {}; the results up to there are in {}{}\n", study.name, result.message,
               folder.string(), result.kept ? ", --resume goes on from there" : "");
  return {settings.ranks.of_first(exit_code_of(result)), complete, result.kept, std::move(result.end)};
}

void print_not_run(const study::Study& study) {
  fmt::print(stderr, "error: {}: not run, because {} did not come to its end\n", study.name,
             study.time.start_run);
}

} // namespace rubato::app
