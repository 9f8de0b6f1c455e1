// SPDX-License-Identifier: LGPL-3.0-or-later
/// The displacement mode of the cells of mean_dilatation that have one, a bubble, which vanishes on their
/// faces:
///
///   QUAD8   M = (1 − ξ²)(1 − η²)
///   HEXA20  M = (1 − ξ²)(1 − η²)(1 − ζ²)
///
/// With it a linear change of volume in the cell passes the inf-sup condition wherever a constant one does
/// (D. Boffi, F. Brezzi, M. Fortin, Mixed Finite Element Methods and Applications, 2013, section 8.6): QUAD8
/// with its bubble is QUAD9.
#pragma once

#include "rubato/element/nonlinear/cell_gradients.hpp"

namespace rubato::element {

bool has_bubble(CellType type);

/// Puts ∂M/∂X, and M/R of axisymmetric cells, behind the gradients of the nodes.
void put_bubble(CellType type, std::span<const Eigen::Vector3d> points, CellGradients& gradients);

} // namespace rubato::element
