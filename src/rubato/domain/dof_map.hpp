// SPDX-License-Identifier: LGPL-3.0-or-later
/// The numbers of the displacement unknowns.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rubato::domain {

/// A node's components stand together: dof = first_dof[node] + component.
struct DofMap {
  int components = 0;                  ///< a node, 2 or 3
  std::vector<std::int32_t> first_dof; ///< one a mesh node; −1 when the node carries no bulk cell
  std::int32_t dof_count = 0;
  std::vector<mesh::NodeIndex> nodes; ///< the numbered nodes, ascending: first_dof[nodes[i]] = i · components

  bool has(mesh::NodeIndex node) const { return first_dof[static_cast<std::size_t>(node)] >= 0; }
  std::int32_t dof(mesh::NodeIndex node, int component) const {
    return first_dof[static_cast<std::size_t>(node)] + component;
  }
};

/// Numbers the nodes of `cells` in the order of the mesh.
DofMap number_dofs(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells, int components);

} // namespace rubato::domain
