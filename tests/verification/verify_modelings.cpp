// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fmt/format.h>

#include "verification/modelings.hpp"
#include "verification/verify.hpp"
#include <algorithm>
#include <cctype>
#include <cmath>

namespace rubato::verification {
namespace {

constexpr double step = 1e-3;
constexpr double millisecond = 1e-3;
constexpr double difference_instant = 0.001;
const std::string none = "–";

std::string shown(const std::optional<double>& value) {
  return value ? fmt::format("{:.10f}", *value) : none;
}

std::optional<double> minus(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(*a - *b) : std::nullopt;
}

std::string name_of(char letter) {
  return std::string(1, static_cast<char>(std::toupper(letter)));
}

/// tip.y in Code_Aster's history of a run.
std::optional<double> reference_at(char letter, const std::string& run, double t) {
  const auto table = history(fmt::format("{}_{}", letter, run));
  if (!table)
    return std::nullopt;
  const auto column = static_cast<std::size_t>(table->column("dy"));
  for (const auto& row : table->rows)
    if (std::abs(row.front() - t) < step * 1e-6)
      return row[column];
  return std::nullopt;
}

/// One quantity as the document, Code_Aster and this program have it.
struct Value {
  std::string document = none;
  std::optional<double> published;
  std::optional<double> reference;
  std::optional<double> computed;

  /// From the history, which has more digits, else from what was printed.
  std::string deviation() const {
    const auto difference = minus(computed, reference ? reference : published);
    return difference ? fmt::format("{:.1e}", std::abs(*difference)) : none;
  }
};

void write_value(Page& page, char letter, const std::string& run, const std::string& quantity,
                 const Value& value) {
  page.row({name_of(letter), run, quantity, value.document, shown(value.published), shown(value.reference),
            shown(value.computed), value.deviation()});
}

std::string document_at(double t) {
  if (t == 0.006)
    return "−0.15 ± 10 %";
  return t == 0.012 ? "−0.009 (order of magnitude)" : none;
}

void write_first_run(Page& page, const ModelingRun& run) {
  for (const double t : {0.001, 0.006, 0.012})
    write_value(page, run.letter, run.name, fmt::format("DY({:g} ms)", t / millisecond),
                {document_at(t), published(run.letter, run.name, t), reference_at(run.letter, run.name, t),
                 run.deflection(t)});
}

/// The document holds the difference fields from the first run against 0.
void write_later_run(Page& page, const ModelingRun& first, const ModelingRun& run) {
  const double t = difference_instant;
  const auto value_of = [&](const ModelingRun& r) {
    return Value{none, published(r.letter, r.name, t), reference_at(r.letter, r.name, t), r.deflection(t)};
  };
  const auto own = value_of(run);
  const auto of_first = value_of(first);
  write_value(page, run.letter, run.name, "DY(1 ms)", own);
  write_value(page, run.letter, fmt::format("{} − {}", first.name, run.name), "DY(1 ms)",
              {"0 ± 0.1", minus(of_first.published, own.published), minus(of_first.reference, own.reference),
               minus(of_first.computed, own.computed)});
}

void write_values(Page& page, const std::vector<std::vector<ModelingRun>>& modelings) {
  page.paragraph(
      "## Values\n\nDY of the loaded end [m]: what the document asks for, what Code_Aster had in 2015 and "
      "has in its version 15.1.21, what comes out here, and the deviation from the latter (from 2015's "
      "where there is no other).");
  page.table({"modeling", "run", "quantity", "document", "Code_Aster 2015", "Code_Aster 15.1.21", "rubato",
              "deviation (m)"});
  for (const auto& runs : modelings)
    for (const auto& run : runs)
      if (&run == &runs.front())
        write_first_run(page, run);
      else
        write_later_run(page, runs.front(), run);
}

int iterations_of(const results::Table& reference) {
  const auto column = static_cast<std::size_t>(reference.column("newton_iters"));
  double sum = 0;
  for (const auto& row : reference.rows)
    sum += row[column];
  return static_cast<int>(sum);
}

std::vector<std::string> history_row(const ModelingRun& run) {
  std::vector<std::string> row{name_of(run.letter), run.name};
  if (!run.started()) {
    row.insert(row.end(), {none, none, none, none, none, none, none, run.failure});
    return row;
  }
  const auto reference = history(fmt::format("{}_{}", run.letter, run.name));
  if (reference && has_original_mesh(run.letter)) {
    const double until =
        std::min(last_whole_step(*reference, step), last_whole_step(run.probes, step)) * (1 + 1e-9);
    const auto found = deviation(run.probes, *reference, until);
    row.insert(row.end(),
               {fmt::format("{:.3g}", until / millisecond), fmt::format("{:.1e}", found.relative()),
                fmt::format("{:.3g}", found.at / millisecond)});
  } else {
    row.insert(row.end(), {none, none, none});
  }
  row.insert(row.end(), {std::to_string(run.result.iterations),
                         reference ? std::to_string(iterations_of(*reference)) : none,
                         std::to_string(run.result.cuts), seconds_of(run.result), outcome_of(run.result)});
  return row;
}

void write_runs(Page& page, const std::vector<std::vector<ModelingRun>>& modelings) {
  page.paragraph("## Runs\n\nThe largest deviation of DY from Code_Aster 15.1.21 over the largest |DY|, up "
                 "to the last instant "
                 "before either of the two cut a step (what follows a cut is integrated with other steps), "
                 "and the instant "
                 "of it. Code_Aster counts the iterations of its last loop only where there are loops (evol2 "
                 "to evol4); its "
                 "history may be longer or shorter than what is compared. B's runs on the original mesh "
                 "go only as far as they can be compared.");
  page.table({"modeling", "run", "to (ms)", "deviation / peak", "at (ms)", "iterations", "Code_Aster's",
              "cuts", "seconds", "run"});
  for (const auto& runs : modelings)
    for (const auto& run : runs)
      page.row(history_row(run));
}

void write_figures(Page& page, const std::string& letters) {
  page.paragraph(
      "## Histories\n\nEvery run, the converged one (modeling F on QUAD9 four times as fine, step 0.05 ms, "
      "α = −0.05, a true start), the document's points, and how far the runs are from the first.");
  for (const char letter : letters)
    page.paragraph(fmt::format("![DY of the loaded end in the runs of modeling {0}](sdnl140_{1}.svg)",
                               name_of(letter), letter));
}

} // namespace

void write_modelings(Page& page, const std::string& letters) {
  const std::filesystem::path folder = RUBATO_RUNS_DIR "/sdnl140";
  std::vector<std::vector<ModelingRun>> modelings;
  for (const char letter : letters)
    modelings.push_back(run_modeling(letter, folder));
  write_values(page, modelings);
  write_runs(page, modelings);
  write_figures(page, letters);
  const auto converged = run_converged(folder);
  page.paragraph(fmt::format("Converged: {}, {}, {} m at 1, 6, 12 ms; {} s ({}).",
                             shown(converged.deflection(0.001)), shown(converged.deflection(0.006)),
                             shown(converged.deflection(0.012)), seconds_of(converged.result),
                             converged.started() ? outcome_of(converged.result) : converged.failure));
}

} // namespace rubato::verification
