// SPDX-License-Identifier: LGPL-3.0-or-later
/// More mass for cells that would make the steps of an explicit run short.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/study/study.hpp"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace rubato::model {

struct MassScaling {
  std::vector<double> factors; ///< what multiplies the mass of each cell of Bulk::cells, ≥ 1
  Eigen::VectorXd added;       ///< one a dof [mass]
  int cells = 0;               ///< that get more
  double largest_factor = 1;
  double added_mass = 0; ///< along each axis [mass]
  double mass = 0;       ///< of all cells without it, along each axis [mass]
};

/// What every cell needs to allow the step that the study asks for: its own largest λ becomes
/// (2 safety/step)², safety 1 where the study has a step. Then no λ of the whole is larger
/// (domain/cell_rates.hpp). Cells without mass stay so. The model has its bulk and dofs; the study must ask
/// for it.
MassScaling scaled_masses(const Model& model);

/// A sentence: what was added, its part of the mass, how many cells.
std::string described(const MassScaling& scaling, const study::TimeStepping& time);

} // namespace rubato::model
