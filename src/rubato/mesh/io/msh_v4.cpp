// SPDX-License-Identifier: LGPL-3.0-or-later
// Gmsh reference manual, "MSH file format", version 4.1.
#include "rubato/mesh/io/msh_content.hpp"

#include <array>

namespace rubato::mesh::msh {
namespace {

const std::vector<Tag>& physicals_of(const Physicals& physicals, Entity entity) {
  static const std::vector<Tag> none;
  const auto found = physicals.find(entity);
  return found == physicals.end() ? none : found->second;
}

std::vector<Tag> read_tags(Input& input, std::string_view what) {
  const auto count = input.count(input.size("a number of tags"), {.integers = 1}, "tags");
  std::vector<Tag> tags(count);
  for (auto& tag : tags)
    tag = input.integer(what);
  return tags;
}

/// What a partitioned piece says more: the piece it is a part of, and its partitions.
void skip_parent(Input& input) {
  input.integer("the dimension of a parent");
  input.integer("the tag of a parent");
  read_tags(input, "a partition");
}

/// Tag, place or box, physical groups, and the tags of the boundary.
void read_entity(Input& input, int dimension, bool partitioned, Physicals& physicals) {
  const Entity entity{dimension, input.integer("the tag of a piece of the geometry")};
  if (partitioned)
    skip_parent(input);
  const int coordinates = dimension == 0 ? 3 : 6;
  for (int i = 0; i < coordinates; ++i)
    input.real("a coordinate of a box");
  auto groups = read_tags(input, "the tag of a physical group");
  for (auto& group : groups)
    group = group < 0 ? -group : group; // the sign only turns the cells round
  if (dimension > 0)
    read_tags(input, "the tag of a boundary");
  physicals[entity] = std::move(groups);
}

struct Block {
  Entity entity;
  std::int64_t kind = 0; ///< of nodes: whether they have parameters; of cells: their type
  std::size_t count = 0;
};

Block read_block(Input& input, Input::Least each, std::string_view what) {
  Block block;
  block.entity.dimension = static_cast<int>(input.integer("the dimension of a piece of the geometry"));
  block.entity.tag = input.integer("the tag of a piece of the geometry");
  block.kind = input.integer("the kind of a block");
  block.count = input.count(input.size("the number in a block"), each, what);
  if (block.entity.dimension < 0 || block.entity.dimension > 3)
    input.refuse_here("a piece of the geometry has another dimension than 0 to 3");
  return block;
}

struct BlockedHead {
  std::size_t blocks = 0;
  std::size_t items = 0;
};

BlockedHead read_head(Input& input, Input::Least each, std::string_view what) {
  BlockedHead head;
  head.blocks = input.count(input.size("a number of blocks"), {.integers = 3, .sizes = 1}, "blocks");
  head.items = input.count(input.size("the number of all"), each, what);
  input.size("the smallest tag");
  input.size("the largest tag");
  return head;
}

void check_sum(const Input& input, std::size_t sum, std::size_t announced, std::string_view what) {
  if (sum != announced)
    input.refuse_here("its blocks have " + std::to_string(sum) + " " + std::string(what) + ", it announces " +
                      std::to_string(announced));
}

void read_node_block(Input& input, const Physicals& physicals, Content& content) {
  const auto block = read_block(input, {.sizes = 1, .reals = 3}, "nodes");
  const auto first = content.node_tags.size();
  for (std::size_t i = 0; i < block.count; ++i)
    content.node_tags.push_back(input.size("the tag of a node"));
  const int parameters = block.kind != 0 ? block.entity.dimension : 0;
  for (std::size_t i = 0; i < block.count; ++i) {
    auto& point = content.points.emplace_back();
    for (auto& coordinate : point)
      coordinate = input.real("a coordinate");
    for (int axis = 0; axis < parameters; ++axis)
      input.real("a parameter of a node");
  }
  if (block.entity.dimension == 0)
    for (const auto group : physicals_of(physicals, block.entity))
      content.points_in_group[{0, group}].insert(
          content.points_in_group[{0, group}].end(),
          content.node_tags.begin() + static_cast<std::ptrdiff_t>(first), content.node_tags.end());
}

std::size_t read_cell_block(Input& input, const Physicals& physicals, Content& content) {
  const auto block = read_block(input, {.sizes = 2}, "cells");
  const auto& type = known_type(input, block.kind);
  Cells points;
  auto& cells = type.ours == CellType::point1 ? points : content.cells[type.ours];
  const auto first = cells.tags.size();
  for (std::size_t i = 0; i < block.count; ++i) {
    cells.tags.push_back(input.size("the tag of a cell"));
    read_cell_nodes(input, type, &Input::size, cells.nodes);
  }
  for (const auto group : physicals_of(physicals, block.entity)) {
    if (type.ours == CellType::point1) {
      auto& nodes = content.points_in_group[{0, group}];
      nodes.insert(nodes.end(), points.nodes.begin(), points.nodes.end());
      continue;
    }
    auto& members = content.in_group[{block.entity.dimension, group}];
    for (auto cell = first; cell < cells.tags.size(); ++cell)
      members.push_back({type.ours, static_cast<CellIndex>(cell)});
  }
  return block.count;
}

} // namespace

void read_entities_4(Input& input, bool partitioned, Physicals& physicals) {
  if (partitioned) {
    input.size("the number of partitions");
    const auto ghosts = input.count(input.size("a number of ghosts"), {.integers = 2}, "ghosts");
    for (std::size_t i = 0; i < 2 * ghosts; ++i)
      input.integer("a ghost");
  }
  std::array<std::size_t, 4> counts{};
  for (auto& count : counts)
    count = input.count(input.size("a number of pieces of the geometry"),
                        {.integers = 1, .sizes = 1, .reals = 3}, "pieces of the geometry");
  for (int dimension = 0; dimension < 4; ++dimension)
    for (std::size_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i)
      read_entity(input, dimension, partitioned, physicals);
}

void read_nodes_4(Input& input, const Physicals& physicals, Content& content) {
  const auto head = read_head(input, {.sizes = 1, .reals = 3}, "nodes");
  content.node_tags.reserve(head.items);
  content.points.reserve(head.items);
  for (std::size_t block = 0; block < head.blocks; ++block)
    read_node_block(input, physicals, content);
  check_sum(input, content.node_tags.size(), head.items, "nodes");
}

void read_cells_4(Input& input, const Physicals& physicals, Content& content) {
  const auto head = read_head(input, {.sizes = 2}, "cells");
  std::size_t read = 0;
  for (std::size_t block = 0; block < head.blocks; ++block)
    read += read_cell_block(input, physicals, content);
  check_sum(input, read, head.items, "cells");
}

} // namespace rubato::mesh::msh
