// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where a point of a reference cell lies in space: places the nodes that conversion and refinement add.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace rubato::mesh {

/// Reference coordinates of a local node of any type; unused coordinates are 0. Pyramids: base [−1,1]² at
/// ζ=0, apex (0,0,1).
const Eigen::Vector3d& reference_node(CellType type, int node);

/// Values of the node_count(type) Lagrange or serendipity functions at the reference coordinates `xi`.
/// Throws std::invalid_argument for pyramids and PENTA18, which have none here.
std::array<double, 27> shape_values(CellType type, const Eigen::Vector3d& xi);

/// Σ N_i(ξ) x_i over the nodes of a cell; `points` are those of the mesh.
Eigen::Vector3d position(CellType type, std::span<const NodeIndex> nodes,
                         const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& xi);

} // namespace rubato::mesh
