// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/modes/modal_study.hpp"
#include "rubato/results/checks.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/stored_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "read_deck.hpp"
#include <algorithm>
#include <string>
#include <vector>

namespace rubato::app {

namespace {

int exit_code_of(const results::StoredRun& run, bool checks_hold) {
  switch (run.status) {
  case results::RunStatus::complete:
    return checks_hold ? done : check_failed;
  case results::RunStatus::not_converged:
    return no_convergence;
  default:
    return other_failure;
  }
}

std::string text_of(const results::StoredRun& run, const std::vector<results::CheckResult>& checks,
                    bool markdown) {
  const auto state = run.status == results::RunStatus::complete ? "complete" : run.reason;
  if (markdown)
    return fmt::format("### {}\n\n{}\n\n{}\n", run.name, state,
                       checks.empty() ? "no checks in the deck\n" : results::to_markdown(checks));
  return fmt::format("{}: {}\n{}", run.name, state,
                     checks.empty() ? "no checks in the deck\n" : results::to_text(checks));
}

int check_run(const std::filesystem::path& folder, bool markdown) {
  const auto run = results::read_stored_run(folder);
  const auto study = deck::parse_echo(run.study, (folder / results::summary_file).string());
  const auto checks = results::evaluate_checks(study.checks, run.probes, folder);
  fmt::print("{}", text_of(run, checks, markdown));
  return exit_code_of(run, std::ranges::all_of(checks, &results::CheckResult::holds));
}

/// Throws InputError with the faults that a run of an .inp file has when its models are built.
void check_models(const StepsDeck& steps) {
  auto studies = steps.deck.runs;
  for (auto& study : studies)
    if (steps.modes.contains(study.name))
      study = rubato::modes::modal_study(study);
  deck::throw_if_any(model::faults_of(studies), steps.deck.places);
}

/// The deck alone, without its mesh; an .inp file with it.
int check_deck(const std::filesystem::path& file) {
  const auto steps = read_steps_deck(file);
  const auto& deck = steps.deck;
  if (is_inp(file))
    check_models(steps);
  for (const auto& note : deck.notes)
    fmt::print(stderr, "{}\n", note);
  std::vector<std::string> names;
  for (const auto& run : deck.runs)
    names.push_back(run.name);
  fmt::print("{}: no fault in the deck; {} run{}: {}\n", is_standard_input(file) ? "<stdin>" : file.string(),
             names.size(), names.size() == 1 ? "" : "s", fmt::join(names, ", "));
  return done;
}

} // namespace

int check(const CheckArguments& arguments) {
  const auto& what = arguments.what;
  if (is_standard_input(what) || (std::filesystem::exists(what) && !std::filesystem::is_directory(what)))
    return check_deck(what);
  int code = done;
  for (const auto& folder : results::run_folders(what))
    code = std::max(code, check_run(folder, arguments.markdown));
  return code;
}

} // namespace rubato::app
