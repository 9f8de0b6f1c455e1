// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/mesh.hpp"

#include "rubato/mesh/names.hpp"

#include <algorithm>
#include <stdexcept>

namespace rubato::mesh {
namespace {

const Group* find_group(const std::vector<Group>& groups, std::string_view name) {
  const auto found = std::ranges::find(groups, name, &Group::name);
  return found == groups.end() ? nullptr : &*found;
}

} // namespace

CellIndex Mesh::cell_count() const {
  CellIndex count = 0;
  for (const auto& block : blocks)
    count += block.cell_count();
  return count;
}

Mesh::Place Mesh::place_of(CellIndex cell) const {
  for (const auto& block : blocks) {
    const auto count = block.cell_count();
    if (cell < count)
      return {&block, cell};
    cell -= count;
  }
  throw std::out_of_range("cell index past the end of the mesh");
}

std::span<const NodeIndex> Mesh::nodes_of(CellIndex cell) const {
  const auto place = place_of(cell);
  return place.block->cell(place.index);
}

const Group* Mesh::node_group(std::string_view name) const {
  return find_group(node_groups, name);
}

const Group* Mesh::cell_group(std::string_view name) const {
  return find_group(cell_groups, name);
}

std::vector<NodeIndex> nodes_named(const Mesh& mesh, std::string_view name) {
  return find_nodes(mesh, name).nodes;
}

std::vector<std::string> group_names(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const auto* groups : {&mesh.node_groups, &mesh.cell_groups})
    for (const auto& group : *groups)
      names.push_back(group.name);
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

} // namespace rubato::mesh
