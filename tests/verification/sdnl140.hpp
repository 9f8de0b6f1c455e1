// SPDX-License-Identifier: LGPL-3.0-or-later
/// SDNL140, two clamped beams that rub, as decks: every modeling on the mesh of the public test base or on
/// the project's own, and its histories held against Code_Aster's.
#pragma once

#include "rubato/deck/read.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/run/run_study.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rubato::verification {

/// Where the mesh comes from: a .med file of the test base, or the deck's own generator.
enum class MeshFrom { file, generator };

/// `letter` a…f. The deck is evol1's; `changes` are laid over it as by `--set`. Throws InputError for a
/// modeling that cannot be generated (a, b).
study::Study sdnl140(char letter, MeshFrom from, const std::vector<deck::Setting>& changes = {});

/// The folder of the real meshes and histories.
std::filesystem::path sdnl140_folder();

/// Removes contact: the upper beam carries the load alone.
std::vector<deck::Setting> without_contact();

struct Finished {
  run::RunResult result;
  results::Table probes; ///< t, tip.x, tip.y[, tip.z]
};
/// Runs a study in a folder that is gone afterwards.
Finished finish(const study::Study& study);

/// One history held against another.
struct Deviation {
  double largest = 0; ///< max |computed − reference| [length]
  double at = 0;      ///< the instant where that is
  double peak = 0;    ///< max |reference|
  double value = 0;   ///< computed at the last instant compared
  int instants = 0;   ///< compared
  int missing = 0;    ///< instants of the reference (within the window) that the run did not reach
  double relative() const { return largest / peak; }
};

/// Deflection of the tip against column dy of a history of Code_Aster, at the instants of the history up to
/// `until`.
Deviation deviation(const results::Table& probes, const results::Table& reference, double until = 1e300);

/// Largest difference of two runs of one study, over the largest value of the second at any instant: of the
/// probes at every instant and of all displacements at the end. Not a number where their instants differ.
double largest_difference(const Finished& one, const Finished& other);

/// code_aster/<name>.csv; nothing when it is not there.
std::optional<results::Table> history(const std::string& name);

} // namespace rubato::verification
