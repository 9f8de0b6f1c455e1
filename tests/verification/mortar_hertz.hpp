// SPDX-License-Identifier: LGPL-3.0-or-later
/// A round body on a block of the same material, both fine where they touch, on meshes that do not match: a
/// cylinder (plane strain, half of it) or a paraboloid (a quarter of it).
#pragma once

#include "rubato/cell/topology.hpp"

#include <string>

namespace rubato::verification {

struct RoundOnBlock {
  CellType cells = CellType::quad4; ///< of either body; their dimension decides
  int faces = 10;                   ///< of the round body across the contact's half-width a
  bool round_is_slave = true;
  std::string integration = "mortar";
};

/// Beside Hertz, in parts of his numbers.
struct HertzErrors {
  std::string failure; ///< why there is no end; empty when there is one
  double centre = 0;   ///< |p/p₀ − 1| of the node in the middle
  double inside = 0;   ///< largest |p − p_Hertz|/p₀ of nodes within 0.85 a
  double anywhere = 0; ///< the same of all nodes
  double rms = 0;      ///< over the nodes that touch
  double peak = 0;     ///< of the ellipse p² = A + B r² nearest to the pressures, less 1
  double radius = 0;   ///< a of that ellipse, less 1
  double largest = 0;  ///< largest pressure at a node, less 1
  int iterations = 0;
  int nodes = 0;      ///< of the mesh
  double seconds = 0; ///< processor time
};

HertzErrors press_round(const RoundOnBlock& bodies);

} // namespace rubato::verification
