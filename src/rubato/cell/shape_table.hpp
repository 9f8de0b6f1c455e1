// SPDX-License-Identifier: LGPL-3.0-or-later
/// Shape functions and their gradients tabulated once at the points of a quadrature rule.
#pragma once

#include "rubato/cell/quadrature.hpp"

#include <Eigen/Core>

namespace rubato::cell {

struct ShapeTable {
  Eigen::VectorXd weights;   ///< one a point
  Eigen::MatrixXd values;    ///< N_i: nodes × points
  Eigen::MatrixXd gradients; ///< ∂N_i/∂ξ_a in row i·dimension + a: nodes·dimension × points
};

ShapeTable tabulate(CellType type, std::span<const QuadraturePoint> rule);

/// The tables of stiffness_rule and mass_rule; throw std::invalid_argument for cells without mechanics.
const ShapeTable& stiffness_table(CellType type);
const ShapeTable& mass_table(CellType type);

} // namespace rubato::cell
