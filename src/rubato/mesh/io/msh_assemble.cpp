// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/io/msh_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string_view>

namespace rubato::mesh::msh {
namespace {

/// Where the node of a tag stands in the file's list. Tags may have gaps, and any order.
class PlaceOfNode {
public:
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

  PlaceOfNode(const Input& input, const Content& content) : tags_(content.node_tags), order_(tags_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    if (!std::ranges::is_sorted(tags_))
      std::ranges::sort(order_, [&](std::size_t a, std::size_t b) { return tags_[a] < tags_[b]; });
    for (std::size_t i = 1; i < order_.size(); ++i)
      if (tags_[order_[i]] == tags_[order_[i - 1]] &&
          content.points[order_[i]] != content.points[order_[i - 1]])
        input.refuse(fmt::format("is damaged: it gives node {} two places", tags_[order_[i]]));
    make_table();
  }

  /// Places in the file's list by ascending tag.
  const std::vector<std::size_t>& order() const { return order_; }

  std::size_t of(Tag tag) const {
    if (!table_.empty()) {
      const auto offset = static_cast<std::uint64_t>(tag) - static_cast<std::uint64_t>(first_);
      return offset < table_.size() ? table_[offset] : none;
    }
    const auto found = std::ranges::lower_bound(order_, tag, {}, [&](std::size_t i) { return tags_[i]; });
    return found != order_.end() && tags_[*found] == tag ? *found : none;
  }

private:
  /// A table over all tags where they are dense enough.
  void make_table() {
    if (order_.empty())
      return;
    constexpr std::uint64_t entries_a_node = 4;
    first_ = tags_[order_.front()];
    const auto last = static_cast<std::uint64_t>(tags_[order_.back()]) - static_cast<std::uint64_t>(first_);
    if (last / entries_a_node >= order_.size())
      return;
    table_.assign(last + 1, none);
    for (const auto place : order_)
      table_[static_cast<std::size_t>(tags_[place] - first_)] = place;
  }

  const std::vector<Tag>& tags_;
  std::vector<std::size_t> order_;
  Tag first_ = 0;
  std::vector<std::size_t> table_;
};

void check_size(const Input& input, std::size_t count, std::string_view what) {
  if (count > static_cast<std::size_t>(std::numeric_limits<NodeIndex>::max()))
    input.refuse(fmt::format("holds {} {}, at most {} can be read", count, what,
                             std::numeric_limits<NodeIndex>::max()));
}

/// Replaces tags by places in the file's list, and marks these as used.
void find_places(const Input& input, const PlaceOfNode& place, std::vector<Tag>& nodes,
                 std::string_view owner, std::vector<bool>& used) {
  for (auto& node : nodes) {
    const auto found = place.of(node);
    if (found == PlaceOfNode::none)
      input.refuse(fmt::format("is damaged: a {} has node {}, which it does not give", owner, node));
    used[found] = true;
    node = static_cast<Tag>(found);
  }
}

constexpr NodeIndex unused = -1;

/// Adds the nodes in use by ascending tag; returns the index of each place in the file's list.
std::vector<NodeIndex> add_nodes(const Content& content, const PlaceOfNode& place,
                                 const std::vector<bool>& used, Mesh& mesh) {
  std::vector<NodeIndex> index(used.size(), unused);
  for (const auto i : place.order()) {
    if (!used[i])
      continue;
    index[i] = mesh.node_count();
    mesh.points.push_back(content.points[i]);
    mesh.node_numbers.push_back(content.node_tags[i]);
  }
  return index;
}

std::map<CellType, CellIndex> add_blocks(Content& content, const std::vector<NodeIndex>& index, Mesh& mesh) {
  std::map<CellType, CellIndex> first;
  CellIndex count = 0;
  for (auto& [type, cells] : content.cells) {
    if (cells.tags.empty())
      continue;
    first[type] = count;
    CellBlock block;
    block.type = type;
    block.numbers = std::move(cells.tags);
    block.nodes.resize(cells.nodes.size());
    std::ranges::transform(cells.nodes, block.nodes.begin(),
                           [&](Tag place) { return index[static_cast<std::size_t>(place)]; });
    cells.nodes = {};
    count += block.cell_count();
    mesh.blocks.push_back(std::move(block));
  }
  return first;
}

std::string name_of(const Content& content, Entity group) {
  constexpr std::array<std::string_view, 4> kinds{"point", "line", "surface", "volume"};
  const auto found = content.names.find(group);
  if (found != content.names.end() && !found->second.empty())
    return found->second;
  return fmt::format("{}_{}", kinds.at(static_cast<std::size_t>(group.dimension)), group.tag);
}

std::vector<Group> as_groups(std::map<std::string, std::vector<std::int32_t>>&& members) {
  std::vector<Group> groups;
  groups.reserve(members.size());
  for (auto& [name, items] : members) {
    std::ranges::sort(items);
    items.erase(std::unique(items.begin(), items.end()), items.end());
    groups.push_back({name, std::move(items)});
  }
  return groups;
}

void add_groups(const Content& content, const std::map<CellType, CellIndex>& first_cell,
                const std::vector<NodeIndex>& index, Mesh& mesh) {
  std::map<std::string, std::vector<std::int32_t>> cells;
  for (const auto& [group, places] : content.in_group) {
    auto& items = cells[name_of(content, group)];
    for (const auto& place : places)
      items.push_back(first_cell.at(place.type) + place.index);
  }
  std::map<std::string, std::vector<std::int32_t>> nodes;
  for (const auto& [group, places] : content.points_in_group) {
    auto& items = nodes[name_of(content, group)];
    for (const auto place : places)
      items.push_back(index[static_cast<std::size_t>(place)]);
  }
  // A name without cells is kept: who uses it is told that it is empty, not that there is no such group.
  for (const auto& [group, name] : content.names)
    if (!name.empty() && !cells.contains(name) && !nodes.contains(name))
      (group.dimension > 0 ? cells : nodes)[name];
  mesh.cell_groups = as_groups(std::move(cells));
  mesh.node_groups = as_groups(std::move(nodes));
}

} // namespace

const KnownType& known_type(const Input& input, Tag gmsh) {
  const auto* const type = find_type(gmsh);
  if (type == nullptr)
    input.refuse_here(
        fmt::format("it holds cells of type {}, which this program does not know", unknown_type(gmsh)));
  return *type;
}

void read_cell_nodes(Input& input, const KnownType& type, Tag (Input::*next)(std::string_view),
                     std::vector<Tag>& nodes) {
  constexpr std::size_t most = 27;
  std::array<Tag, most> own{};
  const auto width = static_cast<std::size_t>(cell::topology(type.ours).node_count);
  for (std::size_t i = 0; i < width; ++i)
    own[i] = (input.*next)("a node of a cell");
  for (std::size_t i = 0; i < width; ++i)
    nodes.push_back(own[type.order.empty() ? i : type.order[i]]);
}

Mesh assembled(const Input& input, Content content) {
  std::size_t cell_count = 0;
  for (const auto& [type, cells] : content.cells)
    cell_count += cells.tags.size();
  if (cell_count == 0)
    input.refuse("holds no cells");
  check_size(input, content.points.size(), "nodes");
  check_size(input, cell_count, "cells");

  const PlaceOfNode place(input, content);
  std::vector<bool> used(content.points.size(), false);
  for (auto& [type, cells] : content.cells)
    find_places(input, place, cells.nodes, "cell", used);
  for (auto& [group, nodes] : content.points_in_group)
    find_places(input, place, nodes, "physical group", used);

  Mesh mesh;
  const auto index = add_nodes(content, place, used, mesh);
  const auto first_cell = add_blocks(content, index, mesh);
  add_groups(content, first_cell, index, mesh);
  return mesh;
}

} // namespace rubato::mesh::msh
