// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/mesh.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace rubato::mesh {
namespace {

const Group* find_group(const std::vector<Group>& groups, std::string_view name) {
  const auto found = std::ranges::find(groups, name, &Group::name);
  return found == groups.end() ? nullptr : &*found;
}

void sort_without_repeats(std::vector<NodeIndex>& nodes) {
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

std::vector<NodeIndex> node_numbered(const Mesh& mesh, std::string_view text) {
  if (!text.empty() && (text.front() == 'N' || text.front() == 'n'))
    text.remove_prefix(1);
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    return {};
  const auto found = std::ranges::find(mesh.node_numbers, number);
  if (found == mesh.node_numbers.end())
    return {};
  return {static_cast<NodeIndex>(found - mesh.node_numbers.begin())};
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
    if (cell < block.cell_count())
      return {&block, cell};
    cell -= block.cell_count();
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
  if (const auto* group = mesh.node_group(name))
    return group->items;
  if (const auto* group = mesh.cell_group(name)) {
    std::vector<NodeIndex> nodes;
    for (const auto cell : group->items) {
      const auto of_cell = mesh.nodes_of(cell);
      nodes.insert(nodes.end(), of_cell.begin(), of_cell.end());
    }
    sort_without_repeats(nodes);
    return nodes;
  }
  return node_numbered(mesh, name);
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
