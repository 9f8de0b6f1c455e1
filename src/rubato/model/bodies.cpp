// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/model/bodies.hpp"

#include <numeric>

namespace rubato::model {
namespace {

using mesh::NodeIndex;

/// Sets of nodes, each with one of them that stands for it.
class Sets {
public:
  explicit Sets(NodeIndex nodes) : parent_(static_cast<std::size_t>(nodes)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }

  std::size_t root(NodeIndex node) {
    auto at = static_cast<std::size_t>(node);
    while (static_cast<std::size_t>(parent_[at]) != at) {
      parent_[at] = parent_[static_cast<std::size_t>(parent_[at])];
      at = static_cast<std::size_t>(parent_[at]);
    }
    return at;
  }

  void join(NodeIndex one, NodeIndex other) { parent_[root(one)] = static_cast<NodeIndex>(root(other)); }

private:
  std::vector<NodeIndex> parent_;
};

} // namespace

Bodies::Bodies(const mesh::Mesh& mesh, const domain::Bulk& bulk)
    : of_node_(static_cast<std::size_t>(mesh.node_count()), -1) {
  Sets sets(mesh.node_count());
  for (const auto cell : bulk.cells)
    for (const auto node : mesh.nodes_of(cell))
      sets.join(node, mesh.nodes_of(cell).front());
  std::vector<int> of_root(of_node_.size(), -1);
  for (const auto cell : bulk.cells)
    for (const auto node : mesh.nodes_of(cell)) {
      auto& number = of_root[sets.root(node)];
      if (number < 0) {
        number = count();
        first_node_.push_back(node);
      }
      of_node_[static_cast<std::size_t>(node)] = number;
    }
}

} // namespace rubato::model
