// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/dof_map.hpp"

namespace rubato::domain {

DofMap number_dofs(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells, int components) {
  constexpr std::int32_t used = 0;
  DofMap dofs{components, std::vector<std::int32_t>(mesh.points.size(), -1), 0, {}};
  for (const auto cell : cells)
    for (const auto node : mesh.nodes_of(cell))
      dofs.first_dof[static_cast<std::size_t>(node)] = used;
  for (mesh::NodeIndex node = 0; node < mesh.node_count(); ++node)
    if (dofs.has(node)) {
      dofs.first_dof[static_cast<std::size_t>(node)] = dofs.dof_count;
      dofs.dof_count += components;
      dofs.nodes.push_back(node);
    }
  return dofs;
}

} // namespace rubato::domain
