// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"
#include "rubato/run/time_loop.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "interrupt.hpp"
#include "progress.hpp"
#include <algorithm>
#include <map>
#include <span>

namespace rubato::app {
namespace {

deck::Deck read(const RunArguments& arguments) {
  std::vector<deck::Setting> settings;
  for (const auto& text : arguments.settings)
    settings.push_back(deck::parse_setting(text));
  return deck::read_deck(arguments.deck, settings);
}

const deck::Study* find_run(const deck::Deck& deck, const std::string& name) {
  const auto found = std::ranges::find(deck.runs, name, &deck::Study::name);
  return found == deck.runs.end() ? nullptr : &*found;
}

/// The runs asked for and those they start from, in the deck's order.
std::vector<const deck::Study*> chosen_runs(const deck::Deck& deck, const std::vector<std::string>& only) {
  std::vector<std::string> wanted;
  for (const auto& name : only) {
    const auto* study = find_run(deck, name);
    if (study == nullptr) {
      std::vector<std::string> names;
      std::ranges::transform(deck.runs, std::back_inserter(names), &deck::Study::name);
      const auto nearest = nearest_word(name, names);
      throw InputError(fmt::format("--only: found '{}', expected one of {}{}", name, fmt::join(names, ", "),
                                   nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
    }
    for (; study != nullptr; study = find_run(deck, study->time.start_run.text))
      wanted.push_back(study->name);
  }
  std::vector<const deck::Study*> runs;
  for (const auto& study : deck.runs)
    if (only.empty() || std::ranges::find(wanted, study.name) != wanted.end())
      runs.push_back(&study);
  return runs;
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

void print_summary(const deck::Study& study, const run::RunResult& result,
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
  Series(const RunArguments& arguments, std::filesystem::path output)
      : output_(std::move(output)), quiet_(arguments.quiet),
        line_(arguments.quiet), watch_{[this](const run::Progress& progress) { line_.update(progress); },
                                       [this](const std::string& text) { line_.say(text); }, is_interrupted} {
  }

  int run(std::span<const deck::Study* const> studies) {
    int worst = done;
    for (const auto* study : studies) {
      const auto& source = study->time.start_run.text;
      if (!source.empty() && !ends_.contains(source)) {
        fmt::print(stderr, "error: {}: not run, because {} did not come to its end\n", study->name, source);
        continue;
      }
      worst = std::max(worst, run(*study, source.empty() ? nullptr : &ends_.at(source)));
      if (is_interrupted())
        break;
    }
    return worst;
  }

private:
  int run(const deck::Study& study, const step::State* previous) {
    const auto folder = output_ / study.name;
    auto result = run::run_study(study, folder, watch_, previous);
    line_.close();
    if (!quiet_ || !result.checks.empty())
      print_summary(study, result, folder);
    if (result.status == run::Status::complete)
      ends_.emplace(study.name, std::move(result.end));
    else
      fmt::print(stderr, "error: {}: {}; the results up to there are in {}\n", study.name, result.message,
                 folder.string());
    return exit_code_of(result);
  }

  std::filesystem::path output_;
  bool quiet_;
  ProgressLine line_;
  run::Watch watch_;
  std::map<std::string, step::State> ends_;
};

} // namespace

int run(const RunArguments& arguments) {
  const auto deck = read(arguments);
  const auto runs = chosen_runs(deck, arguments.only);
  if (runs.size() > 1)
    model::check_studies(runs);
  catch_interrupts();
  return Series(arguments, arguments.output.empty() ? arguments.deck.stem() : arguments.output).run(runs);
}

} // namespace rubato::app
