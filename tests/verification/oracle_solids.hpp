// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies that yield, turn and stretch, against histories by Code_Aster: SDNL140's beams with other materials
/// and strains, blocks of rubber, and pressures on a beam that bends by as much as it is long.
#pragma once

#include <string>
#include <vector>

namespace rubato::verification {

struct OracleSolid {
  std::string file; ///< of the shared folder "oracle": "c_isot_line"
  std::string what; ///< for readers
  std::string deck;
  bool is_reaction = false; ///< the file's first column after t is the reaction of `top` along z
  /// Whether Code_Aster's own formulation is another one: then no agreement is asked for.
  bool stands_beside = false;
};

/// Those whose files are there.
std::vector<OracleSolid> oracle_solids();

struct SolidDeviation {
  int rows = 0;       ///< of the file after its first
  double largest = 0; ///< deviation of a component at `tip`, or of the reaction, in parts of the peak
  double balance = 0; ///< of the energy ledger, in parts of its largest term
  int iterations = 0; ///< of rubato: linear solves
  int bulk = 0;       ///< motions of the bodies that they were made from
  int factorisations = 0;
  int others = 0; ///< iterations of Code_Aster
};

/// Runs the deck over the instants of the file. Throws std::runtime_error when a step does not come to an
/// end.
SolidDeviation compare(const OracleSolid& study);

} // namespace rubato::verification
