// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a cell reports of a point.
#pragma once

#include "rubato/material/point_response.hpp"

#include <Eigen/Core>

namespace rubato::element {

/// The values of a point that fields and the balance of energy read.
struct PointRecord {
  double volume = 0;        ///< weight of the point, measure included
  double stored = 0;        ///< by undeformed volume
  material::Strain6 strain; ///< what the law saw, without the free one
  material::Strain6 free;   ///< CellInput::free_strain there
  material::Stress6 stress; ///< conjugate to it
  material::Stress6 cauchy; ///< true stress P Fᵀ/J of what the law saw; plane stress: by undeformed
                            ///< thickness
  Eigen::Matrix3d gradient; ///< ∂u/∂X with the strain of the cell's own modes; zz is 0 in the plane
  Eigen::Matrix3d piola;    ///< P_c: Σ volume · P_c : d(gradient) is f·du, less what hourglasses take

  bool operator==(const PointRecord&) const = default;
};

} // namespace rubato::element
