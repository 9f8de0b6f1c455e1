// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/history.hpp"

#include <fmt/format.h>

#include "verification/verify.hpp"
#include <cctype>

namespace rubato::verification {
namespace {

struct Row {
  std::string history;
  std::vector<deck::Setting> changes;
  double until = 1e300;
};

std::vector<deck::Setting> without_contact_and(std::vector<deck::Setting> changes) {
  changes.push_back({"contact", "~"});
  return changes;
}

const std::vector<deck::Setting> newmark{{"time.scheme", "newmark"}, {"time.alpha", "~"}};
const std::vector<deck::Setting> frictionless{{"contact.interface.friction", "0"}};

std::vector<Row> rows() {
  auto frictionless_newmark = newmark;
  frictionless_newmark.insert(frictionless_newmark.end(), frictionless.begin(), frictionless.end());
  return {{"a_nocontact", without_contact()},
          {"b_nocontact", without_contact()},
          {"c_nocontact", without_contact()},
          {"d_nocontact", without_contact()},
          {"f_nocontact", without_contact()},
          {"f_nocontact_newmark", without_contact_and(newmark)},
          {"f_nocontact_modified", without_contact_and({{"time.scheme", "modified_average_acceleration"}})},
          {"f_frictionless", frictionless},
          {"f_frictionless_newmark", frictionless_newmark},
          {"a_evol1", {}},
          {"c_evol1", {}},
          {"d_evol1", {}, 0.0115},
          {"d_evol1", {}},
          {"e_evol1", {}},
          {"f_evol1", {}},
          {"f_evol1_150ms", {{"time.end", "0.15"}}}};
}

int iterations_of(const results::Table& reference) {
  const auto column = static_cast<std::size_t>(reference.column("newton_iters"));
  double sum = 0;
  for (const auto& row : reference.rows)
    sum += row[column];
  return static_cast<int>(sum);
}

void write_row(Page& page, const Row& row, MeshFrom from, const results::Table& reference) {
  const auto run = finish(sdnl140(row.history.front(), from, row.changes));
  const auto found = deviation(run.probes, reference, row.until);
  page.row({row.until < 1 ? fmt::format("{} to {:g} ms", row.history, row.until * 1e3) : row.history,
            from == MeshFrom::file ? "test base" : "own", std::to_string(found.instants),
            fmt::format("{:.1e}", found.relative()), fmt::format("{:g}", found.at * 1e3),
            std::to_string(run.result.iterations), std::to_string(iterations_of(reference)),
            std::to_string(run.result.cuts), seconds_of(run.result), outcome_of(run.result)});
}

void write_histories(Page& page) {
  page.paragraph("## Further histories\n\nDeflection of the loaded end at every instant of Code_Aster "
                 "15.1.21's history: the largest "
                 "deviation over the largest deflection, the instant of that deviation, Newton iterations of "
                 "all steps (a history's own count is of the whole history), steps that were cut. "
                 "`start: at_rest_unloaded`; D with `clamped_normal: code_aster`; no coefficient is given.");
  page.table({"history", "mesh", "instants", "deviation / peak", "at (ms)", "iterations", "Code_Aster's",
              "cuts", "seconds", "run"});
  for (const auto& row : rows()) {
    const auto reference = history(row.history);
    if (!reference) {
      page.row({row.history, "", "", "the reference is not there", "", "", "", "", "", ""});
      continue;
    }
    write_row(page, row, MeshFrom::file, *reference);
    if (row.history.front() >= 'c')
      write_row(page, row, MeshFrom::generator, *reference);
  }
}

} // namespace

void write_sdnl140(const std::filesystem::path& folder) {
  Page page(folder / "sdnl140.md", "SDNL140 against Code_Aster");
  write_modelings(page, "abcdef");
  write_histories(page);
}

void write_sdnl140_of(const std::filesystem::path& folder, const std::string& letters) {
  Page page(folder / fmt::format("sdnl140_{}.md", letters), "SDNL140 against Code_Aster");
  write_modelings(page, letters);
}

void write_convergence(const std::filesystem::path& folder) {
  Page page(folder / "convergence.md", "SDNL140 refined until its answer stands still");
  page.paragraph(
      "cases/sdnl140/convergence.yaml: modeling F on QUAD9 cells, 20 × 2 a beam times the refinement "
      "of the mesh, HHT with α = −0.05, a true start. An independent explicit computation, refined "
      "until converged, has −0.0180, −0.1855 and −0.0079 m.");
  page.table({"run", "DY(1 ms) (m)", "DY(6 ms) (m)", "DY(12 ms) (m)", "steps", "cuts", "iterations",
              "seconds", "run ended"});
  for (const auto& study : deck::read_deck(RUBATO_SOURCE_DIR "/cases/sdnl140/convergence.yaml").runs) {
    const auto run = finish(study);
    std::vector<std::string> row{study.name};
    for (const double t : {0.001, 0.006, 0.012}) {
      const auto value = results::value_at(run.probes, run.probes.column("tip.y"), t);
      row.push_back(value ? fmt::format("{:.5f}", *value) : "");
    }
    row.insert(row.end(),
               {std::to_string(run.result.steps), std::to_string(run.result.cuts),
                std::to_string(run.result.iterations), seconds_of(run.result), outcome_of(run.result)});
    page.row(row);
  }
}

void write_defaults(const std::filesystem::path& folder) {
  Page page(folder / "defaults.md", "Modeling C with nothing chosen");
  page.paragraph("`start: consistent`, no contact coefficient given, to 12 ms, on the project's own mesh.");
  page.table({"step (s)", "cells per edge of the reference mesh", "DY(6 ms) (m)", "DY(12 ms) (m)", "steps",
              "cuts", "iterations", "seconds", "run"});
  const auto write = [&](const std::string& step, const std::string& refine) {
    const auto run =
        finish(sdnl140('c', MeshFrom::generator,
                       {{"time.start", "consistent"}, {"time.step", step}, {"mesh.refine", refine}}));
    const auto column = static_cast<std::size_t>(run.probes.column("tip.y"));
    const auto middle = results::value_at(run.probes, run.probes.column("tip.y"), 0.006);
    page.row({step, refine, middle ? fmt::format("{:.5f}", *middle) : "",
              fmt::format("{:.5f}", run.probes.rows.back()[column]), std::to_string(run.result.steps),
              std::to_string(run.result.cuts), std::to_string(run.result.iterations), seconds_of(run.result),
              outcome_of(run.result)});
  };
  for (const auto* step : {"1e-3", "1e-4", "1e-5"})
    write(step, "1");
  for (const auto* refine : {"2", "4", "8"})
    write("1e-3", refine);
}

} // namespace rubato::verification
