// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/builder.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/mesh/index_lists.hpp"
#include "rubato/mesh/names.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace rubato::mesh {
namespace {

std::vector<std::int32_t>& items_named(std::vector<Group>& groups, const std::string& name) {
  const auto found = std::ranges::find(groups, name, &Group::name);
  if (found != groups.end())
    return found->items;
  return groups.emplace_back(Group{name, {}}).items;
}

void append_to(std::vector<std::int32_t>& items, std::span<const std::int32_t> more) {
  items.insert(items.end(), more.begin(), more.end());
}

std::vector<std::int32_t> shifted(std::vector<std::int32_t> items, std::int32_t offset) {
  for (auto& item : items)
    item += offset;
  return items;
}

std::int64_t largest(std::span<const std::int64_t> numbers) {
  return std::accumulate(numbers.begin(), numbers.end(), std::int64_t{0},
                         [](std::int64_t a, std::int64_t b) { return std::max(a, b); });
}

void number_the_rest(std::span<std::int64_t> numbers, std::int64_t& last) {
  for (auto& number : numbers)
    if (number == 0)
      number = ++last;
}

/// Most meshes have no names: the list grows with the first one.
void set_last(std::vector<std::string>& names, std::size_t size, std::string name) {
  if (name.empty())
    return;
  names.resize(size);
  names.back() = std::move(name);
}

} // namespace

MeshBuilder::MeshBuilder(int dimension) {
  mesh_.dimension = dimension;
  for (const auto& shape : cell::all_topologies())
    blocks_[static_cast<std::size_t>(shape.type)].type = shape.type;
}

MeshBuilder MeshBuilder::on_nodes_of(const Mesh& mesh) {
  MeshBuilder builder(mesh.dimension);
  builder.mesh_.points = mesh.points;
  builder.mesh_.node_numbers = mesh.node_numbers;
  builder.mesh_.node_names = mesh.node_names;
  builder.mesh_.node_groups = mesh.node_groups;
  return builder;
}

NodeIndex MeshBuilder::add_node(const Eigen::Vector3d& point, std::int64_t number, std::string name) {
  mesh_.points.push_back(point);
  mesh_.node_numbers.push_back(number);
  set_last(mesh_.node_names, mesh_.points.size(), std::move(name));
  return mesh_.node_count() - 1;
}

MeshBuilder::CellHandle MeshBuilder::add_cell(CellType type, std::span<const NodeIndex> nodes,
                                              std::int64_t number, std::string name) {
  auto& block = blocks_[static_cast<std::size_t>(type)];
  cells_.push_back({type, static_cast<CellIndex>(block.numbers.size())});
  block.nodes.insert(block.nodes.end(), nodes.begin(), nodes.end());
  block.numbers.push_back(number);
  set_last(block.names, block.numbers.size(), std::move(name));
  return cell_count() - 1;
}

void MeshBuilder::add_to_node_group(const std::string& name, std::span<const NodeIndex> nodes) {
  append_to(items_named(mesh_.node_groups, name), nodes);
}

void MeshBuilder::add_to_cell_group(const std::string& name, std::span<const CellHandle> cells) {
  append_to(items_named(mesh_.cell_groups, name), cells);
}

void MeshBuilder::append(const Mesh& mesh) {
  const auto first_node = mesh_.node_count();
  const auto first_cell = cell_count();
  for (const auto& point : mesh.points)
    add_node(point);
  std::vector<NodeIndex> own;
  for_each_cell(mesh, [&](CellIndex, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    own.assign(nodes.begin(), nodes.end());
    for (auto& node : own)
      node += first_node;
    add_cell(shape.type, own);
  });
  for (const auto& group : mesh.node_groups)
    add_to_node_group(group.name, shifted(group.items, first_node));
  for (const auto& group : mesh.cell_groups)
    add_to_cell_group(group.name, shifted(group.items, first_cell));
}

std::array<CellIndex, MeshBuilder::type_count> MeshBuilder::first_cells() const {
  std::array<CellIndex, type_count> first{};
  for (std::size_t type = 1; type < type_count; ++type)
    first[type] = first[type - 1] + blocks_[type - 1].cell_count();
  return first;
}

Mesh MeshBuilder::build() && {
  const auto first = first_cells();
  for (auto& group : mesh_.cell_groups) {
    for (auto& item : group.items) {
      const auto& cell = cells_[static_cast<std::size_t>(item)];
      item = first[static_cast<std::size_t>(cell.type)] + cell.index_in_block;
    }
    sort_without_repeats(group.items);
  }
  for (auto& group : mesh_.node_groups)
    sort_without_repeats(group.items);

  auto last_node = largest(mesh_.node_numbers);
  number_the_rest(mesh_.node_numbers, last_node);
  std::int64_t last_cell = 0;
  for (const auto& block : blocks_)
    last_cell = std::max(last_cell, largest(block.numbers));
  for (auto& block : blocks_) {
    number_the_rest(block.numbers, last_cell);
    if (!block.nodes.empty())
      mesh_.blocks.push_back(std::move(block));
  }
  name_the_rest(mesh_);
  return std::move(mesh_);
}

} // namespace rubato::mesh
