// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact patch test by mortar on blocks that lie on one another in every way
/// (patch/contact_blocks.hpp).
#pragma once

#include "rubato/cell/topology.hpp"

#include <array>
#include <string>
#include <string_view>

namespace rubato::verification {

/// How the upper block, whose lower face is the slave, lies on the lower one.
enum class Layout {
  three_on_four, ///< faces a side, undistorted
  five_on_four,
  distorted,   ///< three on four, corners inside the surfaces thrown about, straight edges
  master_over, ///< a slave of 0.6 inside the master, in space turned by 20° about the push
  slave_over,  ///< a master of 0.6 inside the slave, turned likewise
  both_over,   ///< equal sides, each beyond the other: turned by 20°, in the plane moved by 0.28
  curved       ///< as `distorted`, and middles of edges inside the surfaces off the chord by 0.05 of it
};

inline constexpr std::array layouts{Layout::three_on_four, Layout::five_on_four, Layout::distorted,
                                    Layout::master_over,   Layout::slave_over,   Layout::both_over,
                                    Layout::curved};

std::string_view name_of(Layout layout);

struct PatchDeviation {
  std::string failure;     ///< why the step has no end; empty when it has
  double pressure = 0;     ///< largest |λ/p − 1| of the nodes that have a multiplier
  double displacement = 0; ///< largest |u − u_exact| of the interface's nodes over the push
  int iterations = 0;
};

/// Presses them. What of either surface the other does not cover is loaded by the same pressure, p(∫N − ∫N
/// over what is covered), so that the exact solution is the uniform strain.
PatchDeviation press_by_mortar(CellType slave, CellType master, Layout layout);

} // namespace rubato::verification
