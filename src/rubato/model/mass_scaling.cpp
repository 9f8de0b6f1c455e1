// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/mass_scaling.hpp"

#include "rubato/domain/cell_rates.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rubato::model {
namespace {

/// The largest λ of a cell that allows the step [1/time²].
double allowed_rate(const study::TimeStepping& time) {
  const double part = time.step > 0 ? 1 : time.safety;
  return std::pow(2 * part / *time.mass_scaling, 2);
}

/// ≥ 1. The bound is cheap, so that only cells near the limit have their λ found.
double factor_of(const domain::CellVibration& cell, double allowed) {
  const bool has_mass = std::all_of(cell.mass.begin(), cell.mass.end(), [](double mass) { return mass > 0; });
  if (!has_mass || cell.bound() <= allowed)
    return 1;
  return std::max(1.0, cell.largest() / allowed);
}

} // namespace

MassScaling scaled_masses(const Model& model) {
  MassScaling scaling;
  scaling.added = Eigen::VectorXd::Zero(model.dofs.dof_count);
  const double allowed = allowed_rate(model.study.time);
  for (std::size_t i = 0; i < model.bulk.cells.size(); ++i) {
    const auto cell = domain::vibration_of(model.mesh, model.bulk, i);
    const double factor = factor_of(cell, allowed);
    scaling.factors.push_back(factor);
    const double mass = std::accumulate(cell.mass.begin(), cell.mass.end(), 0.0);
    scaling.mass += mass;
    if (!(factor > 1))
      continue;
    ++scaling.cells;
    scaling.largest_factor = std::max(scaling.largest_factor, factor);
    scaling.added_mass += (factor - 1) * mass;
    const auto nodes = model.mesh.nodes_of(model.bulk.cells[i]);
    for (std::size_t n = 0; n < nodes.size(); ++n)
      for (int a = 0; a < model.dofs.components; ++a)
        scaling.added[model.dofs.dof(nodes[n], a)] += (factor - 1) * cell.mass[static_cast<Eigen::Index>(n)];
  }
  return scaling;
}

std::string described(const MassScaling& scaling, const study::TimeStepping& time) {
  if (scaling.cells == 0)
    return fmt::format("mass_scaling adds no mass: every cell allows steps of {:g}", *time.mass_scaling);
  return fmt::format(
      "mass_scaling adds {:.4g} of mass, {:.3g} % of that of all cells, for steps of {:g}: {} of "
      "{} cells have more than their density, at most {:.4g} times it",
      scaling.added_mass, 100 * scaling.added_mass / scaling.mass, *time.mass_scaling, scaling.cells,
      scaling.factors.size(), scaling.largest_factor);
}

} // namespace rubato::model
