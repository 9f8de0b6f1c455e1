// SPDX-License-Identifier: LGPL-3.0-or-later
/// V9: the error of a block pressed on a rigid cylinder, in the energy norm.
#pragma once

#include "rubato/cell/topology.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::verification {

/// Against the block in `fine` × `fine` QUAD9: √((u − u_fine)·K (u − u_fine)) over that of u_fine, for cases/
/// v9_signorini with each number of divisions, which must divide `fine`. `integration`: of the coarse ones.
std::vector<double> signorini_errors(CellType cells, std::span<const int> divisions, int fine,
                                     const std::string& integration = "nodes");

/// Half-width of the contact in the fine block.
double signorini_half_width(int fine);

} // namespace rubato::verification
