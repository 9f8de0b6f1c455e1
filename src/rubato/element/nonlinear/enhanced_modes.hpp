// SPDX-License-Identifier: LGPL-3.0-or-later
/// Gradients of a cell's own displacement modes, M_m = 1 − ξ_m²:
///
///   ∂M_m/∂X = ∂M_m/∂ξ J₀⁻¹ j₀/j,   j = det ∂X/∂ξ, ₀ at the centre
///
/// times R₀/R in axisymmetric cells, which get no hoop strain by them.
#pragma once

#include "rubato/element/nonlinear/cell_gradients.hpp"

#include <array>
#include <cstddef>

namespace rubato::element {

/// j₀/j (R₀/R) at the points.
using ModeRatios = std::array<double, 8>;

/// Puts the modes behind the nodes of QUAD4 or HEXA8.
ModeRatios put_modes(const ReferenceGradients& reference, std::span<const Eigen::Vector3d> points,
                     CellGradients& gradients);

} // namespace rubato::element
