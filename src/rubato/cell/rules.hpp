// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: points and weights on the reference cells of topology.hpp, by shape.
#pragma once

#include "rubato/cell/quadrature.hpp"

#include <vector>

namespace rubato::cell {

using Rule = std::vector<QuadraturePoint>;

/// n Gauss points a direction.
Rule line_rule(int n);
Rule square_rule(int n);
Rule cube_rule(int n);
/// n×n points, exact to degree 2n−2: one degree is spent on the Jacobian of the collapsed square.
Rule collapsed_triangle_rule(int n);
/// The points of gauss_rule in a triangle.
Rule triangle_rule(int n);
/// The points of a triangle on n levels along the axis.
Rule prism_rule(const Rule& triangle, int n);

/// Rules as of rule_of_degree: what the row of a cell (reference_cell.hpp) names.
Rule segment_of_degree(int degree);
Rule triangle_of_degree(int degree);
Rule quadrangle_of_degree(int degree);
Rule tetrahedron_of_degree(int degree);
Rule pyramid_of_degree(int degree);
Rule prism_of_degree(int degree);
Rule hexahedron_of_degree(int degree);

} // namespace rubato::cell
