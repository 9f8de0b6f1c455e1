// SPDX-License-Identifier: LGPL-3.0-or-later
/// What each cell has by itself, by the words that results know it by (study::is_of_cells).
#pragma once

#include "rubato/domain/recovery.hpp"
#include "rubato/model/fwd.hpp"
#include "rubato/step/state.hpp"

#include <Eigen/Core>

#include <cstddef>

namespace rubato::results {

/// Von Mises', Tresca's, mean and principal stresses of stresses, 6 × n, each by itself: a column each.
/// Stresses themselves, when something else is asked for.
Eigen::MatrixXd of_stresses(study::ProbeField what, const Eigen::MatrixXd& stresses);

/// Rows are components as study::components_of has them. Cells are given by their places in the bulk; model
/// and state must outlive this. Temperatures only of models that have some.
class CellQuantities {
public:
  CellQuantities(const model::Model& model, const step::State& state);

  /// At the points of cell::stiffness_rule.
  Eigen::MatrixXd at_points(study::ProbeField what, std::size_t cell);
  /// At the nodes of the cell: extrapolated from the points; what is made of stresses, from such stresses.
  Eigen::MatrixXd at_nodes(study::ProbeField what, std::size_t cell);
  /// Mean of the points by volume.
  Eigen::VectorXd mean(study::ProbeField what, std::size_t cell);
  /// Of the undeformed points [volume].
  Eigen::VectorXd volumes(std::size_t cell) const;

private:
  CellType type_of(std::size_t cell) const;
  /// Of the nodes of a cell, a row.
  Eigen::MatrixXd temperatures_of(std::size_t cell) const;

  const model::Model& model_;
  domain::CellTensors tensors_;
  Eigen::VectorXd temperatures_; ///< one a node of DofMap::nodes; empty without temperatures
};

} // namespace rubato::results
