// SPDX-License-Identifier: LGPL-3.0-or-later
/// Shape functions on the reference cells of topology.hpp.
#pragma once

#include "rubato/cell/quadrature.hpp"
#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

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
  /// The rule of quadrature.hpp on this shape.
  std::vector<QuadraturePoint> (*rule_of_degree)(int degree);
  /// Degrees at which integrals of products of gradients, and of functions, are exact on affine cells. QUAD4
  /// and HEXA8 keep the customary 2 points a direction, the quadratic ones 3.
  int stiffness_degree;
  int mass_degree;
};

/// Throws std::invalid_argument for a type that has no mechanics here (point1, penta18).
const ReferenceCell& reference_cell(CellType type);

bool has_reference_cell(CellType type);

} // namespace rubato::cell
