// SPDX-License-Identifier: LGPL-3.0-or-later
/// Points and weights on the reference cells of topology.hpp; the weights add up to the cell's
/// reference measure.
#pragma once

#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::cell {

struct QuadraturePoint {
  Eigen::Vector3d xi; ///< reference coordinates; those past the cell's dimension are 0
  double weight;
};

/// A rule exact for every polynomial of total degree ≤ `degree` (for SEG, QUAD, HEXA and along a prism's
/// axis: of that degree in each variable). Throws std::invalid_argument for cells without mechanics and for
/// degree < 0.
std::vector<QuadraturePoint> rule_of_degree(CellType type, int degree);

/// `n` Gauss points a direction: SEG n, QUAD n×n, HEXA n×n×n; TRIA by n = 1: 1 point (degree 1), 2: 3 (degree
/// 2), 3: 6 (degree 4), 4: 12 (degree 6), more: n×n points of a collapsed square (degree 2n−2); PENTA from n
/// = 2: those of TRIA by n − 1 on n levels. Throws std::invalid_argument for other cells and for n < 1.
std::vector<QuadraturePoint> gauss_rule(CellType type, int n);

/// The rule of the stiffness matrix: full integration, exact on affine cells. SEG n = order + 1.
std::span<const QuadraturePoint> stiffness_rule(CellType type);

/// The rule of mass matrices and body forces: exact on affine cells.
std::span<const QuadraturePoint> mass_rule(CellType type);

} // namespace rubato::cell
