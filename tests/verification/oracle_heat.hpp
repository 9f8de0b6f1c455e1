// SPDX-License-Identifier: LGPL-3.0-or-later
/// Two beams on one another of which the upper one is heated, against histories by Code_Aster.
#pragma once

#include <string>
#include <vector>

namespace rubato::verification {

struct OracleHeat {
  std::string file; ///< of the shared folder "oracle": "thermal_c_uni"
  std::string what; ///< for readers
  std::string deck;
};

/// Those whose files are there.
std::vector<OracleHeat> oracle_heat();

struct HeatDeviation {
  int rows = 0; ///< of the file after its first
  double displacement =
      0;               ///< largest deviation of a component of the tip, in parts of the largest displacement
  double reaction = 0; ///< the same of the reaction of the lower beam, in parts of the largest component
  int iterations = 0;  ///< of rubato
  int others = 0;      ///< of Code_Aster
};

/// Runs the deck over the instants of the file.
HeatDeviation compare(const OracleHeat& study);

} // namespace rubato::verification
