// SPDX-License-Identifier: LGPL-3.0-or-later
/// SDNL140 with finer meshes and short steps, until its answer stands still.
#pragma once

#include "rubato/cell/topology.hpp"

#include <array>
#include <string>

namespace rubato::verification {

struct RefinedBeams {
  std::string modeling = "f"; ///< of cases/sdnl140: "f" is plane, "c" solid
  CellType cells = CellType::quad4;
  int fineness = 1;     ///< 20 × 2 cells a beam, times this along every edge
  bool matching = true; ///< else the lower beam has 17 cells where the upper one has 20
  std::string integration = "mortar";
};

/// Of the loaded end, along y.
struct Deflections {
  std::array<double, 3> y{}; ///< at 1, 6 and 12 ms [m]
  int steps = 0;
  int cuts = 0;
  int iterations = 0;
  double seconds = 0;
};

/// Independent explicit computations refined until converged (docs/verification/convergence.md) [m].
inline constexpr std::array converged_deflections{-0.0180, -0.1855, -0.0079};

/// From a true start by HHT with α = −0.05 and steps of 2e-5 s. Throws std::runtime_error where the run does
/// not come to its end.
Deflections deflect(const RefinedBeams& beams);

} // namespace rubato::verification
