// SPDX-License-Identifier: LGPL-3.0-or-later
/// Studies that measure mortar contact against closed solutions, each beside `integration: nodes` where that
/// is asked for.
#pragma once

#include "rubato/cell/topology.hpp"

#include "support/walk.hpp"
#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::verification {

/// "quad4": a cell type as decks name it.
std::string word_of(CellType cells);

/// A ring of radii 19.95 and 40 shrunk on a shaft of radius 20, both 20 long, E = 210e3, ν = 0.3: 13k on 10k
/// cells along the axis. The ring is the slave.
struct ShrinkFit {
  CellType cells = CellType::quad4;
  int fineness = 1; ///< k
  bool ends_held = true;
  std::string integration = "mortar";
};

/// Errors of nodal pressures, relative to the pressure on the ring's undeformed area by Lamé's equations.
struct PressureErrors {
  bool converged = false;
  double largest = 0;
  double rms = 0;
  double interior = 0; ///< largest over the middle 80 % of the length
  int iterations = 0;
  std::size_t nodes = 0; ///< of the mesh
};

/// A quarter of the same ring on a shaft with a bore of radius 5, in space, both ends held along the axis;
/// cells along r, θ and z of each. The ring is the slave.
struct SolidRing {
  CellType cells = CellType::hexa20;
  std::array<int, 3> shaft{6, 14, 6};
  std::array<int, 3> ring{6, 16, 7};
  std::string integration = "mortar";
};

/// `interior`: over the middle 80 % of the length and of the quarter.
PressureErrors shrink_in_space(const SolidRing& fit);

/// Pressure of two tubes of one material with this bore on the undeformed area of the outer one.
double lame_pressure(bool ends_held, double bore = 0);
PressureErrors shrink(const ShrinkFit& fit);

/// Two discs on the axis of revolution, 4 on 3 cells of `cells` on `below`: largest |λ/p − 1|, negative where
/// the step has no end.
double press_discs(CellType cells, CellType below);

/// A block of 4 cells a side stands on one of 3 and is loaded on half of its roof; friction 0.3.
struct HalfLoaded {
  std::string failure; ///< why the step has no end; empty when it has
  double reaction = 0; ///< |contact force/load − 1|
  int open = 0;        ///< slave nodes that lift off
  int iterations = 0;
};
HalfLoaded load_half_block(CellType cells);

} // namespace rubato::verification
