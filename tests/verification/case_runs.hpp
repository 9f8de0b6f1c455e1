// SPDX-License-Identifier: LGPL-3.0-or-later
/// The decks of cases/: their runs, and what theory and pages want to know of them.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/run/run_study.hpp"

#include <map>
#include <string>
#include <vector>

namespace rubato::verification {

/// A run and what it wrote.
struct CaseRun {
  study::Study study;
  run::RunResult result;
  results::Table probes;
  results::Table energy;
  std::map<std::string, results::Table> resultants; ///< by zone

  /// The largest imbalance of the energy ledger, in parts of its largest term.
  double ledger() const { return result.energy.largest_balance / result.energy.largest; }
};

/// The runs of a deck, each made when it is first asked for, after the one it starts from.
class CaseRuns {
public:
  /// `deck`: its path in cases/. `changes` are laid over it as by `--set`.
  explicit CaseRuns(const std::string& deck, const std::vector<deck::Setting>& changes = {});

  std::vector<std::string> names() const;
  /// Throws std::out_of_range for a run that the deck doesn't have, std::runtime_error for one that doesn't
  /// come to its end.
  const CaseRun& operator[](const std::string& name);

private:
  deck::Deck deck_;
  std::map<std::string, CaseRun> done_;
};

/// A column, from top to bottom. Throws std::out_of_range when there is none of that name.
std::vector<double> column(const results::Table& table, const std::string& name);

} // namespace rubato::verification
