// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/bodies.hpp"

#include "rubato/core/disjoint_sets.hpp"
#include "rubato/domain/bulk.hpp"

namespace rubato::model {

Bodies::Bodies(const mesh::Mesh& mesh, const domain::Bulk& bulk) : Bodies(mesh, bulk.cells) {}

Bodies::Bodies(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells)
    : of_node_(static_cast<std::size_t>(mesh.node_count()), -1) {
  const auto at = [](mesh::NodeIndex node) { return static_cast<std::size_t>(node); };
  DisjointSets sets(of_node_.size());
  for (const auto cell : cells)
    for (const auto node : mesh.nodes_of(cell))
      sets.join(at(node), at(mesh.nodes_of(cell).front()));
  std::vector<int> of_root(of_node_.size(), -1);
  for (const auto cell : cells)
    for (const auto node : mesh.nodes_of(cell)) {
      auto& number = of_root[sets.root(at(node))];
      if (number < 0) {
        number = count();
        first_node_.push_back(node);
      }
      of_node_[at(node)] = number;
    }
}

} // namespace rubato::model
