// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which cells each rank assembles and evaluates.
#pragma once

#include "rubato/domain/rank_parts.hpp"
#include "rubato/model/fwd.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <vector>

namespace rubato::load {
struct FollowerPressure;
} // namespace rubato::load

namespace rubato::model {

/// Of implicit runs; null where this process is alone. Vectors are whole on all ranks.
std::shared_ptr<const domain::RankParts> implicit_parts(const Model& model);

/// Of explicit runs, whose ranks know no more than the nodes of their cells and of contact surfaces. Null
/// where this process is alone, and where something that acts between bodies or on all of them is not dealt
/// out: then a note of the model says that each rank does all the work.
std::shared_ptr<const domain::RankParts> explicit_parts(Model& model);

/// Model::own_followers: each face stands with the first rank that has a cell at it. None without parts.
std::vector<load::FollowerPressure> own_followers(const Model& model);

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
