// SPDX-License-Identifier: LGPL-3.0-or-later
/// The shortest waves that a mesh of equal cells bears.
#pragma once

#include "rubato/core/cell_type.hpp"

#include <Eigen/Core>

namespace rubato::cell {

/// Amplitudes at the nodes of a cell, a column a wave, whose displacement turns from node to node: of QUAD4
/// and HEXA8 from plane to plane of nodes along one or more of the cell's axes, of PENTA6 along its height
/// and in its triangles, of TRIA3 and TETRA4 that of each node alone. A wave whose displacement has one
/// direction everywhere is the fastest one in a mesh of equal cells; the fastest vibration of a single cell,
/// which breathes along all axes at once, has no place there. No columns for cells with more nodes.
Eigen::MatrixXd shortest_waves(CellType type);

} // namespace rubato::cell
