// SPDX-License-Identifier: LGPL-3.0-or-later
/// The deformed bodies with a field in colours.
#pragma once

#include "rubato/plot/plotted_run.hpp"
#include "rubato/plot/svg.hpp"
#include "rubato/plot/ticks.hpp"

#include <array>
#include <optional>
#include <string>

namespace rubato::plot {

struct DeformedChoice {
  std::string field = "displacement"; ///< "von_mises", "stress.xx", "displacement": its length
  std::optional<double> at = {};      ///< none: the last stored instant
  double scale = 1;                   ///< of the displacements
  std::array<double, 2> view{
      -60, 30}; ///< in space, from where: degrees about z from x, degrees above the xy plane
  std::optional<Range> range = {}; ///< of the colours; none: from the least to the largest value
};

/// Draws it `width` pixels wide; the height follows the bodies unless it is given. Throws InputError when the
/// run has no such field at that instant, and when the size has no room.
std::string deformed_svg(const PlottedRun& run, const DeformedChoice& choice, int width,
                         std::optional<int> height);

} // namespace rubato::plot
