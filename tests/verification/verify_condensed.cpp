// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fmt/format.h>

#include "verification/modelings.hpp"
#include "verification/verify.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace rubato::verification {
namespace {

/// Steps as they are when one in three is cut, in halves and quarters.
constexpr auto cut_instants =
    "[0.001, 0.0015, 0.002, 0.003, 0.004, 0.00425, 0.0045, 0.00475, 0.005, 0.006, 0.007, "
    "0.0075, 0.008, 0.009, 0.01, 0.01025, 0.0105, 0.01075, 0.011, 0.012]";

struct Row {
  std::string name;
  char letter;
  std::string run;
  std::vector<deck::Setting> changes;
};

std::vector<Row> chosen_rows() {
  std::vector<Row> all;
  for (const char letter : {'a', 'c', 'd', 'e', 'f'}) {
    for (const char* run : {"evol1", "evol2", "evol3", "evol4"})
      all.push_back({fmt::format("{} {}", static_cast<char>(std::toupper(letter)), run), letter, run, {}});
    all.push_back({fmt::format("{} evol1, cut", static_cast<char>(std::toupper(letter))),
                   letter,
                   "evol1",
                   {{"time.step", "~"}, {"time.end", "~"}, {"time.instants", cut_instants}}});
  }
  return all;
}

Finished solved(const Row& row, const char* solver) {
  auto changes = row.changes;
  changes.insert(changes.end(), {{"solver", solver}, {"newton.residual", "1e-12"}, {"fields", "~"}});
  auto study = study_of(row.letter, row.run, changes);
  for (auto& zone : study.contact)
    if (zone.geometry.by == study::Iteration::fixed_point)
      zone.geometry = {.by = study::Iteration::fixed_point, .tolerance = 1e-10, .max_loops = 50};
  return finish(study);
}

std::string per_step(const run::RunResult& result) {
  return fmt::format("{:.1f}", static_cast<double>(result.iterations) / static_cast<double>(result.steps));
}

} // namespace

void write_condensed(const std::filesystem::path& folder) {
  Page page(folder / "condensed.md", "The condensed solver against the whole system");
  page.paragraph(
      "Runs of SDNL140 by `solver: condensed` and by `solver: full`, on the meshes of the public test "
      "base where they are there, to a residual of 1e-12, loops of the geometry to 1e-10. Difference: the "
      "largest of the tip at any "
      "instant and of all displacements at the end, over the largest displacement. `cut`: twenty steps of "
      "1, 1/2 and 1/4 ms, as a run has them that cuts one in three. Seconds of the loop alone.");
  page.table({"run", "steps", "difference", "iterations a step, condensed", "whole", "seconds, condensed",
              "whole", "run"});
  for (const auto& row : chosen_rows()) {
    const auto condensed = solved(row, "condensed");
    const auto whole = solved(row, "full");
    const bool complete = condensed.result.status == run::Status::complete;
    page.row({row.name, std::to_string(condensed.result.steps),
              fmt::format("{:.1e}", largest_difference(condensed, whole)), per_step(condensed.result),
              per_step(whole.result), fmt::format("{:.3f}", condensed.result.loop_seconds),
              fmt::format("{:.2f}", whole.result.loop_seconds),
              outcome_of(complete ? whole.result : condensed.result)});
  }
}

} // namespace rubato::verification
