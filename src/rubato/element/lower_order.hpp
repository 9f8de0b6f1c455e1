// SPDX-License-Identifier: LGPL-3.0-or-later
/// The points of Formulation::lower_order.
#pragma once

#include "rubato/cell/quadrature.hpp"
#include "rubato/cell/topology.hpp"

#include <span>

namespace rubato::element {

/// QUAD8 and HEXA20.
bool has_lower_order_rule(CellType type);

/// Gauss points, two in each direction: x changes fastest. Throws std::invalid_argument for other cells.
std::span<const cell::QuadraturePoint> lower_order_rule(CellType type);

} // namespace rubato::element
