// SPDX-License-Identifier: LGPL-3.0-or-later
/// Every run of the decks cases/sdnl140/a…f.yaml, whatever runs they have, and what others got for them.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/run/run_study.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rubato::verification {

struct ModelingRun {
  char letter = 'a';
  std::string name;    ///< "evol1"
  std::string failure; ///< why it could not even start
  run::RunResult result;
  results::Table probes; ///< t, tip.x, tip.y[, tip.z]

  bool started() const { return failure.empty(); }
  /// tip.y at t; nothing when the run did not get there.
  std::optional<double> deflection(double t) const;
};

/// Runs everything of one deck into FOLDER/<letter>/<run>; on the mesh of the public test base when that is
/// there (B then only as far as Code_Aster's histories go), on the deck's own otherwise.
std::vector<ModelingRun> run_modeling(char letter, const std::filesystem::path& folder);

/// One run of cases/sdnl140/<letter>.yaml without its checks, on the original mesh when that is there.
study::Study study_of(char letter, const std::string& run, const std::vector<deck::Setting>& changes = {});

/// Whether the original mesh is there.
bool has_original_mesh(char letter);

/// Modeling F on cells four times as fine, quadratic, with a twentieth of the step, hardly damped by the
/// scheme and with a true start: what all modelings are approximations of (2D and 3D are one problem, as ν =
/// 0). Into FOLDER/converged.
ModelingRun run_converged(const std::filesystem::path& folder);

/// Values of DY at the tip that were printed with the case; nothing where none was.
std::optional<double> published(char letter, const std::string& run, double t);

/// The last instant up to which a history has whole steps only: beyond it a cut has changed what follows.
double last_whole_step(const results::Table& history, double step);

} // namespace rubato::verification
