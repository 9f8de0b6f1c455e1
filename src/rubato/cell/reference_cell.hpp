// SPDX-License-Identifier: LGPL-3.0-or-later
/// Shape functions on the reference cells of topology.hpp.
#pragma once

#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

#include <span>

namespace rubato::cell {

/// A Lagrange or serendipity element on its reference cell. `xi` holds the first `dimension` reference
/// coordinates.
struct ReferenceCell {
  CellType type;
  int dimension;
  int node_count;
  /// N_i(ξ) into n[i].
  void (*values)(const Eigen::Vector3d& xi, std::span<double> n);
  /// ∂N_i/∂ξ_a into dn[i·dimension + a].
  void (*gradients)(const Eigen::Vector3d& xi, std::span<double> dn);
  /// ∂²N_i/∂ξ_a∂ξ_b into ddn[(i·dimension + a)·dimension + b]; for segments, triangles and quadrangles
  /// (contact faces need it), nullptr for solids.
  void (*hessians)(const Eigen::Vector3d& xi, std::span<double> ddn);
  /// Reference coordinates of the nodes.
  std::span<const Eigen::Vector3d> nodes;
};

/// Throws std::invalid_argument for a type that has no mechanics here (point1, pyramids, penta18).
const ReferenceCell& reference_cell(CellType type);

bool has_reference_cell(CellType type);

} // namespace rubato::cell
