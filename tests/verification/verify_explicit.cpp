// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/history.hpp"

#include <fmt/format.h>

#include "support/scratch_folder.hpp"
#include "verification/verify.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace rubato::verification {
namespace {

using Changes = std::vector<deck::Setting>;

struct ExplicitRun {
  run::RunResult result;
  results::Table probes;
  double impact = 0; ///< largest |impact| over the largest energy
};

double largest_impact(const results::Table& energy) {
  const auto impact = static_cast<std::size_t>(energy.column("impact"));
  double largest = 0;
  for (const auto& row : energy.rows)
    largest = std::max(largest, std::abs(row[impact]));
  return largest;
}

ExplicitRun run_explicit(const study::Study& study) {
  const test::ScratchFolder folder;
  ExplicitRun run;
  run.result = run::run_study(study, folder / study.name, {});
  run.probes = results::read_csv(folder / study.name / "probes.csv");
  run.impact =
      largest_impact(results::read_csv(folder / study.name / "energy.csv")) / run.result.energy.largest;
  return run;
}

std::vector<study::Study> deck_of(const std::string& name, const Changes& changes = {}) {
  return deck::read_deck(std::string(RUBATO_SOURCE_DIR "/cases/sdnl140/") + name, changes).runs;
}

double deflection(const results::Table& probes, double t) {
  return results::value_at(probes, probes.column("tip.y"), t).value_or(std::nan(""));
}

void write_reference(Page& page) {
  page.paragraph(
      "## Against the converged answer\n\ncases/sdnl140/reference.yaml: modeling F by "
      "`central_difference` and penalty. Independent programs, refined until converged, have "
      "−0.0180, −0.1855 and −0.0079 m. k_n: the contact stiffness, by itself or given; impact: the "
      "largest energy that contact gave or took unduly, balance: what the ledger leaves unexplained, both "
      "over "
      "the largest energy.");
  page.table({"cells", "k_n (Pa/m)", "DY(1 ms) (m)", "DY(6 ms) (m)", "DY(12 ms) (m)", "impact", "balance",
              "steps", "seconds", "run"});
  for (const auto& [k, changes] :
       {std::pair{"automatic", Changes{}},
        {"1.6e12", Changes{{"contact.interface.coefficients", "{normal: 1.6e12}"}}},
        {"1.6e14", Changes{{"contact.interface.coefficients", "{normal: 1.6e14}"}}}})
    for (const auto& study : deck_of("reference.yaml", changes)) {
      const auto run = run_explicit(study);
      page.row({study.name, k, fmt::format("{:.5f}", deflection(run.probes, 0.001)),
                fmt::format("{:.5f}", deflection(run.probes, 0.006)),
                fmt::format("{:.5f}", deflection(run.probes, 0.012)), fmt::format("{:.1e}", run.impact),
                fmt::format("{:.1e}", run.result.energy.largest_balance / run.result.energy.largest),
                std::to_string(run.result.steps), seconds_of(run.result), outcome_of(run.result)});
    }
}

void write_comparison(Page& page) {
  page.paragraph(
      "## Against implicit steps\n\ncases/sdnl140/explicit.yaml: both on QUAD4 cells four times as "
      "fine, to 30 ms; implicit: HHT with α = −0.05, steps of 1e-5 s, exact contact and friction.");
  const auto studies = deck_of("explicit.yaml", {{"runs.implicit.checks", "~"}});
  const auto by_explicit = finish(studies.front());
  const auto by_implicit = finish(studies.back());
  double largest = 0;
  double peak = 0;
  page.table({"t (ms)", "explicit (m)", "implicit (m)", "difference (m)"});
  for (const auto& row : by_explicit.probes.rows) {
    const double t = row.front();
    const double a = deflection(by_explicit.probes, t);
    const double b = deflection(by_implicit.probes, t);
    largest = std::max(largest, std::abs(a - b));
    peak = std::max(peak, std::abs(a));
    if (std::abs(std::remainder(t, 0.003)) < 1e-9)
      page.row({fmt::format("{:.0f}", t * 1e3), fmt::format("{:.5f}", a), fmt::format("{:.5f}", b),
                fmt::format("{:.1e}", b - a)});
  }
  page.paragraph(fmt::format("Largest difference at any of {} instants: {:.2e} m, {:.2f} % of the largest "
                             "deflection. Implicit: {} steps, {} cuts, {} iterations, {} s ({}).",
                             by_explicit.probes.rows.size(), largest, 100 * largest / peak,
                             by_implicit.result.steps, by_implicit.result.cuts, by_implicit.result.iterations,
                             seconds_of(by_implicit.result), outcome_of(by_implicit.result)));
}

} // namespace

void write_explicit(const std::filesystem::path& folder) {
  Page page(folder / "explicit.md", "SDNL140 by explicit steps");
  write_reference(page);
  write_comparison(page);
}

} // namespace rubato::verification
