// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which cells each rank evaluates in explicit steps.
#pragma once

#include "rubato/domain/rank_parts.hpp"
#include "rubato/model/model.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <vector>

namespace rubato::model {

/// Null where this process is alone, and where something that acts between bodies or on all of them is not
/// dealt out: then a note of the model says that each rank does all the work.
std::shared_ptr<const domain::RankParts> explicit_parts(Model& model);

/// Nodes that all ranks know, since each of them computes contact: those of the surfaces, ascending.
std::vector<mesh::NodeIndex> contact_nodes(const Model& model);

/// Cells that this rank assembles and evaluates: all without Model::parts.
struct OwnCells {
  std::vector<mesh::CellIndex> all;
  std::vector<mesh::CellIndex> constant;
  std::vector<std::size_t> nonlinear; ///< places in the bulk
};
OwnCells own_cells(const Model& model);

/// What is summed over ranks, given on all of them: where another rank counts it, 0.
Eigen::VectorXd counted_once(const Model& model, Eigen::VectorXd values);

} // namespace rubato::model
