// SPDX-License-Identifier: LGPL-3.0-or-later
#include "dry_run.hpp"

#include "rubato/linalg/memory.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/run/plan.hpp"
#include "rubato/study/schemes.hpp"

#include <fmt/format.h>

#include "commands.hpp"
#include <string>

namespace rubato::app {
namespace {

std::string steps_text(const study::TimeStepping& time, const run::Plan& plan) {
  const auto scheme = study::entry_of(time.scheme).name;
  const auto course = fmt::format("from {:g} to {:g}", time.begin, time.end);
  if (!study::is_explicit(time.scheme))
    return fmt::format("scheme {}, {} step{} {}", scheme, plan.steps, plan.steps == 1 ? "" : "s", course);
  return fmt::format("scheme {} {}, results every {:g}{}{}", scheme, course, time.record,
                     plan.method.empty() ? "" : "; ", plan.method);
}

std::string memory_text(const study::Study& study, const run::Plan& plan) {
  const auto free = linalg::memory_text(linalg::available_memory());
  if (plan.factor_bytes)
    return fmt::format("{} takes {} of memory ({} are free)",
                       study.solver == study::Solver::iterative ? "iterating with the matrix"
                                                                : "factoring the matrix",
                       linalg::memory_text(*plan.factor_bytes), free);
  if (study::is_explicit(study.time.scheme))
    return fmt::format("no matrix is factored ({} of memory are free)", free);
  return fmt::format("the memory is known when the run starts ({} are free)", free);
}

/// Nothing where the folder is new.
std::string folder_text(const std::filesystem::path& folder, bool resume) {
  if (!results::holds_run(folder))
    return {};
  if (!resume)
    return fmt::format("the former results move into {}", (folder / results::former_folder).string());
  return std::filesystem::exists(folder / results::checkpoint_file) ? "goes on from the checkpoint there"
                                                                    : "has no checkpoint to go on from";
}

void show(const study::Study& study, const run::Plan& plan, const std::filesystem::path& folder,
          bool resume) {
  fmt::print("{}: results in {}\n", study.name, folder.string());
  if (const auto text = folder_text(folder, resume); !text.empty())
    fmt::print("  {}\n", text);
  if (!study.time.start_run.empty())
    fmt::print("  starts from the end of {}\n", study.time.start_run);
  fmt::print("  {} nodes, {} cells, {} unknowns, {} contact points\n", plan.nodes, plan.cells, plan.unknowns,
             plan.contact_points);
  fmt::print("  {}\n  {}\n", steps_text(study.time, plan), memory_text(study, plan));
  for (const auto& note : plan.notes)
    fmt::print("  {}\n", note);
}

} // namespace

int show_plans(const deck::Deck& deck, const std::filesystem::path& output, bool resume) {
  for (std::size_t i = 0; i < deck.runs.size(); ++i) {
    const auto& study = deck.runs[i];
    try {
      show(study, run::plan_of(study), output / study.name, resume);
    } catch (const InputError& error) {
      throw deck.places[i].located(error);
    }
  }
  fmt::print("dry run: nothing was computed or written\n");
  return done;
}

} // namespace rubato::app
