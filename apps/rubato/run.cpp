// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/threads.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/run/time_loop.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include "dry_run.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "read_deck.hpp"
#include <algorithm>
#include <map>
#include <span>
#include <stop_token>

namespace rubato::app {
namespace {

/// The folder that has one for each run.
std::filesystem::path output_of(const RunArguments& arguments) {
  if (!arguments.output.empty())
    return arguments.output;
  return is_standard_input(arguments.deck) ? "stdin" : arguments.deck.stem();
}

/// What a check subtracts must come from this command, or lie in the folder of results from a former one.
void require_compared_runs(const deck::Deck& deck, const std::filesystem::path& output) {
  const auto& runs = deck.runs;
  std::vector<std::vector<Fault>> faults(runs.size());
  for (std::size_t run = 0; run < runs.size(); ++run)
    for (std::size_t i = 0; i < runs[run].checks.size(); ++i) {
      const auto& other = runs[run].checks[i].run;
      const bool is_run = std::ranges::find(runs, other, &study::Study::name) != runs.end();
      if (other.empty() || is_run || std::filesystem::exists(output / other / results::summary_file))
        continue;
      faults[run].push_back(fault_at(
          fmt::format("checks.{}.run", i),
          fmt::format("run {} is checked against run {}, which is not run now and is not in {}; expected "
                      "'--only {},{}'",
                      runs[run].name, other, output.string(), other, runs[run].name)));
    }
  deck::throw_if_any(faults, deck.places);
}

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

/// The runs of a deck one after another, each in its own folder.
class Series {
public:
  Series(const RunArguments& arguments, std::filesystem::path output, std::stop_token stop)
      : output_(std::move(output)), begin_(arguments.resume ? run::Begin::resumed : run::Begin::anew),
        only_(arguments.only), quiet_(arguments.quiet),
        threads_(arguments.threads > 0 ? arguments.threads : physical_cores()), stop_(std::move(stop)),
        line_(arguments.quiet) {
    watch_.progress = [this](const run::Progress& progress) { line_.update(progress); };
    watch_.within = watch_.progress;
    watch_.say = [this](const std::string& text) { line_.say(text); };
    watch_.warn = [this](const std::string& text) { line_.warn(text); };
    watch_.stop = [this] { return stop_.stop_requested(); };
  }

  int run(const deck::Deck& deck) {
    int worst = done;
    for (std::size_t i = 0; i < deck.runs.size(); ++i) {
      const auto& study = deck.runs[i];
      const auto& source = study.time.start_run;
      if (!source.empty() && !ends_.contains(source)) {
        fmt::print(stderr, "error: {}: not run, because {} did not come to its end\n", study.name, source);
        continue;
      }
      try {
        worst = std::max(worst, run(study, source.empty() ? nullptr : &ends_.at(source)));
      } catch (const InputError& error) {
        throw deck.places[i].located(error);
      }
      if (stop_.stop_requested())
        break;
    }
    return worst;
  }

private:
  /// Runs that others start from are not computed again for them alone.
  run::Begin begin_of(const std::string& run) const {
    const bool asked = only_.empty() || std::ranges::find(only_, run) != only_.end();
    return asked || begin_ == run::Begin::resumed ? begin_ : run::Begin::unless_done;
  }

  int run(const study::Study& study, const step::State* previous) {
    const auto folder = output_ / study.name;
    auto result = run::run_study(study, folder, watch_, previous, begin_of(study.name), threads_);
    line_.close();
    if (!quiet_ || !result.checks.empty())
      print_summary(study, result, folder);
    if (result.status == run::Status::complete)
      ends_.emplace(study.name, std::move(result.end));
    else
      fmt::print(stderr, "error: {}: {}; the results up to there are in {}{}\n", study.name, result.message,
                 folder.string(), result.kept ? ", --resume goes on from there" : "");
    return exit_code_of(result);
  }

  std::filesystem::path output_;
  run::Begin begin_;
  std::vector<std::string> only_;
  bool quiet_;
  Threads threads_;
  std::stop_token stop_;
  ProgressLine line_;
  run::Watch watch_;
  std::map<std::string, step::State> ends_;
};

} // namespace

int run(const RunArguments& arguments) {
  const auto deck = read_deck(arguments.deck, arguments.settings, arguments.only);
  if (deck.runs.size() > 1)
    deck::throw_if_any(model::faults_of(deck.runs), deck.places);
  const auto output = output_of(arguments);
  require_compared_runs(deck, output);
  if (!arguments.quiet)
    for (const auto& note : deck.notes)
      fmt::print(stderr, "{}\n", note);
  if (arguments.dry)
    return show_plans(deck, output, arguments.resume);
  return run_interruptibly(
      [&](const std::stop_token& stop) { return Series(arguments, output, stop).run(deck); });
}

} // namespace rubato::app
