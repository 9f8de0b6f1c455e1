// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where a point of a reference cell lies in space: places the nodes that conversion and refinement add.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::mesh {

/// Σ N_i(ξ) x_i over the nodes of a cell; `points` are those of the mesh. Throws
/// std::invalid_argument for cells without shape functions (point1, PENTA18).
Eigen::Vector3d position(CellType type, std::span<const NodeIndex> nodes,
                         const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& xi);

} // namespace rubato::mesh
