// SPDX-License-Identifier: LGPL-3.0-or-later
/// Cells in which nodes or places are embedded.
#pragma once

#include "rubato/mesh/place_finder.hpp"
#include "rubato/model/build.hpp"

#include <optional>
#include <string>
#include <vector>

namespace rubato::model {

/// " of group 'host'", nothing where the name is empty.
std::string of_group(const std::string& name);

/// Deforming cells of a group, or all of them when its name is empty; empty and a fault when there are none.
std::vector<mesh::CellIndex> host_cells(const mesh::Mesh& mesh, int dimension, const Mention& group,
                                        std::vector<Fault>& faults);

/// The first cell that has the place and not the node `except`; nothing where there is none.
std::optional<mesh::CellShare> cell_at(const mesh::PlaceFinder& finder, const Eigen::Vector3d& place,
                                       mesh::NodeIndex except = -1);

} // namespace rubato::model
