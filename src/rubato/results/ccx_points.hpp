// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: integration points of cells in CalculiX's number and order.
#pragma once

#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

namespace rubato::results {

struct CcxPoints {
  int layers = 1;              ///< equal ones of plane cells, which CalculiX expands to solids
  Eigen::MatrixXd from_points; ///< values at the points of cell::stiffness_rule to those of a layer
  Eigen::MatrixXd to_points;   ///< the way back, of cells with points of lower order; else empty
  Eigen::MatrixXd from_nodes;  ///< values of nodes to those of a layer
};

/// `reduced`: whether the element has reduced integration. Where CalculiX's points are not points of
/// cell::stiffness_rule, values are interpolated by the linear functions of the corners that fit them best.
/// Cell types that CalculiX does not have keep their own points.
const CcxPoints& ccx_points(CellType type, bool reduced);

} // namespace rubato::results
