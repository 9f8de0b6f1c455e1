// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/read.hpp"
#include "rubato/run/time_loop.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "progress.hpp"
#include <algorithm>
#include <csignal>
#include <map>

namespace rubato::app {
namespace {

// A signal handler can reach nothing else.
volatile std::sig_atomic_t interrupted = 0;

extern "C" void on_interrupt(int /*signal*/) {
  interrupted = 1;
}

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
      throw InputError(fmt::format("--only: found '{}', expected one of {}", name, fmt::join(names, ", ")));
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

bool is_start_of_another(const deck::Deck& deck, const std::string& name) {
  return std::ranges::any_of(deck.runs, [&](const auto& study) { return study.time.start_run.text == name; });
}

int exit_code_of(const run::RunResult& result) {
  switch (result.status) {
  case run::Status::not_converged:
    return no_convergence;
  case run::Status::interrupted:
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

} // namespace

int run(const RunArguments& arguments) {
  const auto deck = read(arguments);
  const auto runs = chosen_runs(deck, arguments.only);
  const auto output = arguments.output.empty() ? arguments.deck.stem() : arguments.output;
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  ProgressLine line(arguments.quiet);
  run::Watch watch{[&](const run::Progress& progress) { line.update(progress); },
                   [&](const std::string& text) { line.say(text); }, [] { return interrupted != 0; }};
  std::map<std::string, step::State> ends;
  int worst = done;
  for (const auto* study : runs) {
    const auto folder = output / study->name;
    const auto* previous =
        study->time.start == deck::StartKind::from_run ? &ends.at(study->time.start_run.text) : nullptr;
    auto result = run::run_study(*study, folder, watch, previous);
    line.close();
    if (!arguments.quiet || !result.checks.empty())
      print_summary(*study, result, folder);
    if (result.status != run::Status::complete)
      fmt::print(stderr, "error: {}: {}\n", study->name, result.message);
    worst = std::max(worst, exit_code_of(result));
    if (result.status == run::Status::interrupted)
      break;
    if (is_start_of_another(deck, study->name)) {
      if (result.status != run::Status::complete)
        break;
      ends.emplace(study->name, std::move(result.end));
    }
  }
  return worst;
}

} // namespace rubato::app
