// SPDX-License-Identifier: LGPL-3.0-or-later
/// The points of Formulation::lower_order.
#pragma once

#include "rubato/cell/quadrature.hpp"
#include "rubato/cell/shape_table.hpp"
#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

#include <span>

namespace rubato::element {

/// QUAD8, HEXA20, PENTA6 and PENTA15.
bool has_lower_order_rule(CellType type);

/// Gauss points: two in each direction, x changes fastest; of prisms 1 × 2 and 3 × 3, those of the triangle
/// change fastest. Throws std::invalid_argument for other cells.
std::span<const cell::QuadraturePoint> lower_order_rule(CellType type);

/// Values at these points, interpolated at other places: places × points. The functions are products of
/// powers of the reference coordinates, as many as points.
Eigen::MatrixXd from_lower_order_points(CellType type, std::span<const cell::QuadraturePoint> places);

/// Shape functions at these points.
const cell::ShapeTable& lower_order_table(CellType type);

} // namespace rubato::element
