// SPDX-License-Identifier: LGPL-3.0-or-later
#include "verification/case_runs.hpp"

#include "support/scratch_folder.hpp"
#include <algorithm>
#include <stdexcept>

namespace rubato::verification {

CaseRuns::CaseRuns(const std::string& deck, const std::vector<deck::Setting>& changes)
    : deck_(deck::read_deck(RUBATO_SOURCE_DIR "/cases/" + deck, changes)) {}

std::vector<std::string> CaseRuns::names() const {
  std::vector<std::string> names;
  for (const auto& study : deck_.runs)
    names.push_back(study.name);
  return names;
}

const CaseRun& CaseRuns::operator[](const std::string& name) {
  if (const auto known = done_.find(name); known != done_.end())
    return known->second;
  const auto study = std::ranges::find(deck_.runs, name, &study::Study::name);
  if (study == deck_.runs.end())
    throw std::out_of_range("no run " + name);
  const auto& from = study->time.start_run;
  const auto* previous = from.empty() ? nullptr : &(*this)[from].result.end;
  const test::ScratchFolder scratch;
  const auto folder = scratch / name;
  CaseRun run{*study, run::run_study(*study, folder, {}, previous), {}, {}, {}};
  if (run.result.status != run::Status::complete)
    throw std::runtime_error(name + ": " + run.result.message);
  run.energy = results::read_csv(folder / "energy.csv");
  if (!study->probes.empty())
    run.probes = results::read_csv(folder / "probes.csv");
  for (const auto& zone : study->contact)
    run.resultants[zone.name] = results::read_csv(folder / ("resultants_" + zone.name + ".csv"));
  return done_[name] = std::move(run);
}

std::vector<double> column(const results::Table& table, const std::string& name) {
  const int index = table.column(name);
  if (index < 0)
    throw std::out_of_range("no column " + name);
  std::vector<double> values;
  for (const auto& row : table.rows)
    values.push_back(row[static_cast<std::size_t>(index)]);
  return values;
}

} // namespace rubato::verification
