// SPDX-License-Identifier: LGPL-3.0-or-later
/// Natural frequencies of the upper beam of SDNL140, as Code_Aster has them in ../shared/oracle.
#pragma once

#include "rubato/modes/modes.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace rubato::verification {

struct BeamModes {
  std::string name;  ///< of the file modes_<name>.csv
  std::string cells; ///< "HEXA8"
  std::string deck_cells;
  std::string convert;
  double poisson = 0;
};

/// The beam clamped at one end, its cells and Poisson's ratio.
std::vector<BeamModes> beams_with_modes();
/// The ten lowest.
modes::Modes computed_modes(const BeamModes& beam);
/// [Hz]; nothing when the file is not there.
std::optional<std::vector<double>> reference_frequencies(const BeamModes& beam);
/// |computed − reference|/reference, the largest.
double largest_deviation(const modes::Modes& modes, const std::vector<double>& reference);

} // namespace rubato::verification
