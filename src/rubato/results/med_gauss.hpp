// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: the Gauss points of a cell type as MED files describe them.
#pragma once

#include "rubato/core/cell_type.hpp"

#include <string>
#include <vector>

namespace rubato::results {

/// Points of cell::stiffness_rule on the reference cell that MED's readers know (MEDCoupling's GaussInfo
/// recognises cells by the coordinates of their nodes). Coordinates are point by point.
struct MedGauss {
  std::string name;
  int dimension = 0;
  std::vector<double> nodes; ///< of the reference cell, in MED's order
  std::vector<double> points;
  std::vector<double> weights; ///< they add up to the measure of the reference cell
};

MedGauss med_gauss(CellType type);

} // namespace rubato::results
