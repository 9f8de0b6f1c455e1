// SPDX-License-Identifier: LGPL-3.0-or-later
/// Probes, energies and resultants of contact over time, or over one another.
#pragma once

#include "rubato/plot/figure.hpp"
#include "rubato/plot/plotted_run.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::plot {

struct HistoryChoice {
  /// "tip.y", or "tip" with all its components; "energy.friction"; "ZONE.force.x". None: every probe.
  std::vector<std::string> quantities;
  std::string against; ///< one of them, the x axis; empty: the time
};

/// A panel for each kind of quantity. Over the time, references of the runs' checks are drawn as rings.
/// Throws InputError, with the nearest name, when a run has no such quantity, and when there is nothing to
/// draw.
Figure histories(std::span<const PlottedRun> runs, const HistoryChoice& choice);

/// The names of what a run has: columns of its tables.
std::vector<std::string> quantity_names(const PlottedRun& run);

} // namespace rubato::plot
