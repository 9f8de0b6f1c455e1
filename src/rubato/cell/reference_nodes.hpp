// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the nodes of every cell type sit on its reference cell (topology.hpp).
#pragma once

#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

namespace rubato::cell {

/// Reference coordinates of a local node of any type; unused coordinates are 0. Pyramids: base [−1,1]² at
/// ζ=0, apex (0,0,1).
const Eigen::Vector3d& reference_node(CellType type, int node);

} // namespace rubato::cell
