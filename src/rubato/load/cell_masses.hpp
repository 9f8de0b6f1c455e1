// SPDX-License-Identifier: LGPL-3.0-or-later
/// Consistent masses of cells, for body forces. Only this module includes this.
#pragma once

#include "rubato/domain/cell_matrices.hpp"
#include "rubato/load/nodal_forces.hpp"

#include <span>

namespace rubato::load {

/// Calls `take(nodes, mass)` with the nodes of each cell and its consistent mass matrix, a row a node.
template <class Take>
void for_each_cell_mass(const mesh::Mesh& mesh, const domain::Bulk& bulk, const Take& take) {
  Eigen::MatrixXd consistent;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const auto [block, index] = mesh.place_of(bulk.cells[i]);
    const auto nodes = block->cell(index);
    const auto size = static_cast<Eigen::Index>(nodes.size());
    consistent.resize(size, size);
    domain::cell_mass(bulk, i, block->type, domain::CellPoints(mesh, nodes), consistent);
    take(nodes, consistent);
  }
}

} // namespace rubato::load
