// SPDX-License-Identifier: LGPL-3.0-or-later
/// How many cells lie across a part, and how long it is: followed from cell to cell through opposite sides.
#pragma once

#include "rubato/domain/bulk.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::model {

/// Of one cell: the shortest row of cells through it, and the longest.
struct Layers {
  int count = 0;                                    ///< cells of the shortest row; 0: not known
  double thickness = 0;                             ///< its length [length]
  double length = 0;                                ///< of the longest row [length]
  Eigen::Vector3d across = Eigen::Vector3d::Zero(); ///< from side to side of the cell along the shortest row
};

/// One a cell of `bulk.cells`. Known of QUAD4 and HEXA8 whose rows end at the surface of a body or close in a
/// ring: where a row meets a cell of another shape nothing is said.
std::vector<Layers> layers_of(const mesh::Mesh& mesh, const domain::Bulk& bulk);

} // namespace rubato::model
