// SPDX-License-Identifier: LGPL-3.0-or-later
/// What contact does along a zone: the columns of contact_ZONE.csv over the arc length, or along an axis.
#pragma once

#include "rubato/plot/figure.hpp"
#include "rubato/plot/plotted_run.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::plot {

struct LineChoice {
  std::string what;       ///< "ZONE", its pressure, or "ZONE.gap", "ZONE.traction.x"
  std::vector<double> at; ///< instants; none: the last one
  std::string
      along; ///< "s", "x", "y" or "z"; empty: s in the plane, else the axis on which the zone is longest
};

/// A curve for each run and instant; in space dots, as points do not follow one another. Throws InputError,
/// with the nearest name or instant, when a run does not have what is chosen.
Figure contact_lines(std::span<const PlottedRun> runs, const LineChoice& choice);

} // namespace rubato::plot
