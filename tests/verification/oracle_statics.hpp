// SPDX-License-Identifier: LGPL-3.0-or-later
/// Static studies without contact against displacements by Code_Aster: relations, supports along faces'
/// normals and along directions, orthotropic materials.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rubato::verification {

struct OracleStatic {
  std::string file; ///< of the shared folder "oracle": "static_incl2d_ddl"
  std::string what; ///< for readers
  std::string deck;
};

/// Those whose files, and meshes where the deck does not generate its own, are there.
std::vector<OracleStatic> oracle_statics();

struct OracleDeviation {
  int nodes = 0;      ///< that the file has
  double peak = 0;    ///< largest displacement component of the file [length]
  double largest = 0; ///< deviation of a component, in parts of the peak
};

/// Runs the deck and compares every node of the file, found by its place.
OracleDeviation compare(const OracleStatic& study);

} // namespace rubato::verification
