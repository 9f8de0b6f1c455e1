// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/modelings.hpp"

#include "rubato/results/history.hpp"

#include <fmt/format.h>

#include "verification/sdnl140.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace rubato::verification {
namespace {

struct Published {
  char letter;
  std::string_view run;
  double t;
  double value;
};

/// Code_Aster's, 2015.
constexpr std::array<Published, 12> published_values{{{'a', "evol1", 0.001, -0.0107993961632},
                                                      {'a', "evol1", 0.006, -0.136584741129},
                                                      {'a', "evol1", 0.012, -0.0166247384404},
                                                      {'a', "evol2", 0.001, -0.0107988486535},
                                                      {'a', "evol3", 0.001, -0.0181102921763},
                                                      {'a', "evol4", 0.001, -0.0181102915373},
                                                      {'a', "evol5", 0.001, -0.0110127697},
                                                      {'b', "evol1", 0.001, -0.0117338528073},
                                                      {'c', "evol1", 0.001, -0.0112465263392},
                                                      {'d', "evol1", 0.001, -0.0117212903502},
                                                      {'e', "evol1", 0.001, -0.0156717854405},
                                                      {'f', "evol1", 0.012, -0.0132050023806}}};

std::filesystem::path original_mesh(char letter) {
  // E is C with another scheme.
  return sdnl140_folder() / fmt::format("sdnl140{}.med", letter == 'e' ? 'c' : letter);
}

deck::Deck deck_of(char letter, const std::vector<deck::Setting>& settings) {
  return deck::read_deck(fmt::format("{}/cases/sdnl140/{}.yaml", RUBATO_SOURCE_DIR, letter), settings);
}

std::vector<deck::Setting> on_original_mesh(char letter) {
  if (!has_original_mesh(letter))
    return {};
  return {{"mesh.file", fmt::format("'{}'", original_mesh(letter).string())}};
}

/// Runs a study; what stops it before its first step is told, not thrown.
ModelingRun run_one(char letter, const study::Study& study, const std::filesystem::path& folder,
                    const step::State* previous) {
  ModelingRun run;
  run.letter = letter;
  run.name = study.name;
  try {
    run.result = run::run_study(study, folder, {}, previous);
    run.probes = results::read_csv(folder / "probes.csv");
  } catch (const InputError& error) {
    run.failure = error.what();
  }
  return run;
}

/// B's original mesh takes minutes a step where its contact is hard to settle, and Code_Aster's histories end
/// or are cut early there: its runs go as far as they can be compared.
void shorten(study::Study& study) {
  if (const auto reference = history("b_" + study.name))
    study.time.end = std::max(study.time.step, last_whole_step(*reference, study.time.step));
  std::erase_if(study.fields.at, [&](double t) { return t > study.time.end; });
}

} // namespace

std::optional<double> ModelingRun::deflection(double t) const {
  return results::value_at(probes, probes.column("tip.y"), t);
}

study::Study study_of(char letter, const std::string& run, const std::vector<deck::Setting>& changes) {
  auto settings = on_original_mesh(letter);
  settings.insert(settings.end(), changes.begin(), changes.end());
  auto deck = deck_of(letter, settings);
  const auto study = std::ranges::find(deck.runs, run, &study::Study::name);
  if (study == deck.runs.end())
    throw InputError(fmt::format("modeling {} has no run {}", letter, run));
  study->checks.clear();
  study->fields = {};
  return *study;
}

bool has_original_mesh(char letter) {
  return std::filesystem::exists(original_mesh(letter));
}

std::vector<ModelingRun> run_modeling(char letter, const std::filesystem::path& folder) {
  std::vector<ModelingRun> runs;
  auto deck = deck_of(letter, on_original_mesh(letter));
  for (auto& study : deck.runs) {
    if (letter == 'b' && has_original_mesh(letter))
      shorten(study);
    const auto from = std::ranges::find(runs, study.time.start_run, &ModelingRun::name);
    const auto* previous = from == runs.end() ? nullptr : &from->result.end;
    runs.push_back(run_one(letter, study, folder / std::string(1, letter) / study.name, previous));
  }
  return runs;
}

ModelingRun run_converged(const std::filesystem::path& folder) {
  const auto deck = deck_of('f', {{"mesh.refine", "4"},
                                  {"mesh.convert", "full_quadratic"},
                                  {"runs.evol1.time.step", "5e-5"},
                                  {"runs.evol1.time.alpha", "-0.05"},
                                  {"runs.evol1.time.start", "consistent"}});
  auto study = deck.runs.front();
  study.name = "converged";
  study.checks.clear();
  return run_one('f', study, folder / study.name, nullptr);
}

std::optional<double> published(char letter, const std::string& run, double t) {
  const auto* const found = std::ranges::find_if(published_values, [&](const Published& value) {
    return value.letter == letter && value.run == run && value.t == t;
  });
  return found == published_values.end() ? std::nullopt : std::optional(found->value);
}

double last_whole_step(const results::Table& history, double step) {
  constexpr double rounding = 1e-6;
  double last = 0;
  for (const auto& row : history.rows) {
    const double steps = row.front() / step;
    if (std::abs(steps - std::round(steps)) > rounding)
      break;
    last = row.front();
  }
  return last;
}

} // namespace rubato::verification
