// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/threads.hpp"
#include "rubato/linalg/petsc_module.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/results/ccx_files.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/run/run_study.hpp"

#include <fmt/format.h>

#include "child_process.hpp"
#include "commands.hpp"
#include "dry_run.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include "ranks.hpp"
#include "read_deck.hpp"
#include "run_one.hpp"
#include "show_modes.hpp"
#include "side_by_side.hpp"
#include <algorithm>
#include <map>
#include <stdexcept>
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

/// The runs of a deck one after another.
class Series {
public:
  Series(const StepsDeck& steps, const RunSettings& settings, const std::stop_token& stop)
      : deck_(steps.deck), modes_(steps.modes), settings_(settings), line_(settings.quiet),
        watch_(watch_of(line_)) {
    watch_.stop = [stop] { return stop.stop_requested(); };
  }

  int run() {
    int worst = done;
    for (std::size_t i = 0; i < deck_.runs.size(); ++i) {
      const auto& study = deck_.runs[i];
      const auto& source = study.time.start_run;
      if (!source.empty() && !ends_.contains(source)) {
        print_not_run(study);
        continue;
      }
      try {
        const auto modes = modes_.find(study.name);
        if (modes == modes_.end())
          worst = std::max(worst, run(study, source.empty() ? nullptr : &ends_.at(source)));
        else if (settings_.ranks.is_first())
          worst = std::max(worst, show_modes(study, modes->second, rubato::modes::Contact::open,
                                             settings_.output / study.name));
      } catch (const InputError& error) {
        throw deck_.places[i].located(error);
      }
      if (settings_.ranks.of_first(watch_.stop()))
        break;
    }
    return worst;
  }

private:
  int run(const study::Study& study, const step::State* previous) {
    auto end = run_one(study, settings_, watch_, line_, previous);
    if (end.complete)
      ends_.emplace(study.name, std::move(end.state));
    return end.code;
  }

  const deck::Deck& deck_;
  const std::map<std::string, inp::ModesAsked>& modes_;
  const RunSettings& settings_;
  ProgressLine line_;
  run::Watch watch_;
  std::map<std::string, step::State> ends_;
};

/// Whether runs are computed at once.
bool several_at_once(const deck::Deck& deck, const RunArguments& arguments) {
  return arguments.jobs > 1 && deck.runs.size() > 1 && !arguments.dry;
}

/// Without a wish the cores are shared out among the runs that are computed at once.
int threads_of_each(const RunArguments& arguments, int at_once) {
  return arguments.threads > 0 ? arguments.threads : std::max(1, physical_cores() / at_once);
}

void check_models(const deck::Deck& deck) {
  if (deck.runs.size() > 1)
    deck::throw_if_any(model::faults_of(deck.runs), deck.places);
}

/// Keeps this program without threads, and what models take out of it.
int check_models_apart(const deck::Deck& deck) {
  const auto end = in_a_process([&] {
    check_models(deck);
    return static_cast<int>(done);
  });
  if (end.signal != 0)
    throw std::runtime_error(
        fmt::format("the process that looked for faults in the models was ended by signal {}", end.signal));
  return end.code;
}

/// Several ranks work on one run at a time, and each reads the deck.
void require_what_ranks_can(const RunArguments& arguments) {
  const int ranks = linalg::started_ranks();
  if (ranks > 1 && arguments.jobs > 1)
    throw InputError(
        fmt::format("found --jobs {} with {} ranks, expected one of both: ranks work together on "
                    "one run at a time",
                    arguments.jobs, ranks));
  if (ranks > 1 && is_standard_input(arguments.deck))
    throw InputError(fmt::format("found a deck on standard input with {} ranks, expected the name of a file: "
                                 "each of them reads it",
                                 ranks));
}

StepsDeck steps_of(const RunArguments& arguments) {
  return read_steps_deck(arguments.deck, arguments.settings, arguments.only);
}

/// Refuses checks against runs that are not there, and tells what there is to note.
void prepare(const deck::Deck& deck, const RunArguments& arguments) {
  require_compared_runs(deck, output_of(arguments));
  if (!arguments.quiet)
    for (const auto& note : deck.notes)
      fmt::print(stderr, "{}\n", note);
}

RunSettings settings_of(const RunArguments& arguments, int at_once) {
  return {output_of(arguments),
          arguments.resume ? run::Begin::resumed : run::Begin::anew,
          arguments.only,
          arguments.quiet,
          threads_of_each(arguments, at_once),
          {}};
}

/// Joins what the steps of an .inp file have written to one .dat and one .frd file, called as it is.
void join_steps(const deck::Deck& deck, const RunArguments& arguments) {
  if (!is_inp(arguments.deck))
    return;
  std::vector<std::string> runs;
  for (const auto& study : deck.runs)
    runs.push_back(study.name);
  results::join_ccx_files(output_of(arguments), runs, arguments.deck.stem().string());
}

/// With the others that `mpiexec` started.
int run_as_rank(const RunArguments& arguments, const std::stop_token& stop) {
  const auto ranks = linalg::join_ranks();
  return together(ranks, [&] {
    const auto steps = steps_of(arguments);
    const auto& deck = steps.deck;
    check_models(deck);
    prepare(deck, arguments);
    if (arguments.dry)
      return ranks.is_first() ? show_plans(without_modes(steps), output_of(arguments), arguments.resume)
                              : done;
    auto settings = settings_of(arguments, ranks.count_here());
    settings.ranks = ranks;
    const int code = Series(steps, settings, stop).run();
    if (ranks.is_first())
      join_steps(steps.deck, arguments);
    return code;
  });
}

/// Natural modes come after the other runs.
int run_several_at_once(const StepsDeck& steps, const RunArguments& arguments) {
  const auto deck = without_modes(steps);
  if (const int code = check_models_apart(deck); code != done)
    return code;
  prepare(deck, arguments);
  const auto at_once = std::min(arguments.jobs, static_cast<int>(deck.runs.size()));
  int worst = run_side_by_side(deck, settings_of(arguments, at_once), arguments.jobs);
  for (const auto& study : steps.deck.runs)
    if (const auto modes = steps.modes.find(study.name); modes != steps.modes.end())
      worst = std::max(worst, show_modes(study, modes->second, rubato::modes::Contact::open,
                                         output_of(arguments) / study.name));
  join_steps(steps.deck, arguments);
  return worst;
}

} // namespace

int run(const RunArguments& arguments) {
  require_what_ranks_can(arguments);
  if (linalg::started_ranks() > 1)
    return run_interruptibly([&](const std::stop_token& stop) { return run_as_rank(arguments, stop); });
  const auto steps = steps_of(arguments);
  const auto& deck = steps.deck;
  if (several_at_once(deck, arguments))
    return run_several_at_once(steps, arguments);
  check_models(deck);
  prepare(deck, arguments);
  if (arguments.dry)
    return show_plans(without_modes(steps), output_of(arguments), arguments.resume);
  const auto settings = settings_of(arguments, 1);
  const int code =
      run_interruptibly([&](const std::stop_token& stop) { return Series(steps, settings, stop).run(); });
  join_steps(steps.deck, arguments);
  return code;
}

} // namespace rubato::app
