// SPDX-License-Identifier: LGPL-3.0-or-later
// Gmsh reference manual, "MSH file format version 2 (Legacy)".
#include "rubato/mesh/io/msh_content.hpp"

#include <algorithm>
#include <functional>
#include <unordered_map>
#include <unordered_set>

namespace rubato::mesh::msh {
namespace {

/// Cells of one type with the first two of their tags: physical group and piece of the geometry, 0 when
/// absent.
struct TaggedCells {
  Cells cells;
  std::vector<Tag> physical;
  std::vector<Tag> elementary;
};
using CellsByType = std::map<CellType, TaggedCells>;

/// One cell: number, tags, nodes. The other tags are about partitions.
void read_cell(Input& input, const KnownType& type, Tag number, Tag tag_count, TaggedCells& into) {
  Tag physical = 0;
  Tag elementary = 0;
  for (Tag i = 0; i < tag_count; ++i) {
    const auto tag = input.integer("a tag of a cell");
    if (i == 0)
      physical = tag < 0 ? -tag : tag; // the sign only turns the cell round
    else if (i == 1)
      elementary = tag;
  }
  read_cell_nodes(input, type, &Input::integer, into.cells.nodes);
  into.cells.tags.push_back(number);
  into.physical.push_back(physical);
  into.elementary.push_back(elementary);
}

void read_cells_as_text(Input& input, std::size_t count, CellsByType& cells) {
  for (std::size_t i = 0; i < count; ++i) {
    const auto number = input.integer("the number of a cell");
    const auto& type = known_type(input, input.integer("the type of a cell"));
    const auto tags = input.integer("the number of tags of a cell");
    read_cell(input, type, number, tags, cells[type.ours]);
  }
}

void read_cells_as_bytes(Input& input, std::size_t count, CellsByType& cells) {
  std::size_t read = 0;
  while (read < count) {
    const auto& type = known_type(input, input.integer("the type of a cell"));
    const auto follow = input.integer("the number of cells that follow");
    const auto tags = input.integer("the number of tags of a cell");
    if (follow < 1 || static_cast<std::size_t>(follow) > count - read)
      input.refuse_here("the numbers of its cells contradict each other");
    for (Tag i = 0; i < follow; ++i)
      read_cell(input, type, input.integer("the number of a cell"), tags, cells[type.ours]);
    read += static_cast<std::size_t>(follow);
  }
}

/// Finds, among the cells of one type, those with the same nodes in any order and the same piece of the
/// geometry.
class SameCells {
public:
  SameCells(const TaggedCells& all, std::size_t width)
      : all_(all), width_(width), seen_(0, Hash{this}, Equal{this}) {}

  /// The first of the cells like this one that was asked for: itself when there was none.
  std::size_t first_like(std::size_t cell) { return *seen_.insert(cell).first; }

private:
  std::span<const Tag> nodes(std::size_t cell) const {
    return std::span(all_.cells.nodes).subspan(cell * width_, width_);
  }
  struct Hash {
    const SameCells* of;
    std::size_t operator()(std::size_t cell) const {
      constexpr std::uint64_t spread = 0x9E3779B97F4A7C15U; // 2^64 over the golden ratio
      std::uint64_t sum = 0;                                // whatever the order
      for (const auto node : of->nodes(cell))
        sum +=
            (static_cast<std::uint64_t>(node) * spread) ^ (static_cast<std::uint64_t>(node) * spread >> 29U);
      return std::hash<std::uint64_t>{}(sum);
    }
  };
  struct Equal {
    const SameCells* of;
    bool operator()(std::size_t a, std::size_t b) const {
      return of->all_.elementary[a] == of->all_.elementary[b] &&
             std::ranges::is_permutation(of->nodes(a), of->nodes(b));
    }
  };

  const TaggedCells& all_;
  std::size_t width_;
  std::unordered_set<std::size_t, Hash, Equal> seen_;
};

/// The pieces of the geometry that are in several physical groups.
std::unordered_set<Tag> pieces_in_several_groups(const TaggedCells& cells) {
  std::unordered_map<Tag, Tag> group_of;
  std::unordered_set<Tag> several;
  for (std::size_t i = 0; i < cells.physical.size(); ++i)
    if (const auto [known, added] = group_of.try_emplace(cells.elementary[i], cells.physical[i]);
        !added && known->second != cells.physical[i])
      several.insert(cells.elementary[i]);
  return several;
}

/// Takes the cells of one type into the content, one for all the lines that say the same cell of several
/// groups.
void take_cells(CellType type, const TaggedCells& all, Content& content) {
  const auto& shape = cell::topology(type);
  const auto width = static_cast<std::size_t>(shape.node_count);
  const auto several = pieces_in_several_groups(all);
  SameCells same(all, width);
  std::unordered_map<std::size_t, CellIndex> place_of;         // of cells of several groups
  std::unordered_map<std::size_t, std::vector<Tag>> groups_of; // that they are known to be in
  auto& cells = content.cells[type];

  const auto take = [&](std::size_t cell) {
    cells.tags.push_back(all.cells.tags[cell]);
    const auto nodes = std::span(all.cells.nodes).subspan(cell * width, width);
    cells.nodes.insert(cells.nodes.end(), nodes.begin(), nodes.end());
    return static_cast<CellIndex>(cells.tags.size() - 1);
  };
  const auto place = [&](std::size_t cell) {
    if (!several.contains(all.elementary[cell]))
      return take(cell);
    const auto first = same.first_like(cell);
    auto& groups = groups_of[first];
    const bool again = std::ranges::find(groups, all.physical[cell]) != groups.end();
    groups.push_back(all.physical[cell]);
    if (first == cell || again) // a cell that is twice in one group is two cells
      return place_of[cell] = take(cell);
    return place_of.at(first);
  };
  for (std::size_t cell = 0; cell < all.physical.size(); ++cell) {
    const auto index = place(cell);
    if (all.physical[cell] != 0)
      content.in_group[{shape.dimension, all.physical[cell]}].push_back({type, index});
  }
}

} // namespace

void read_nodes_2(Input& input, bool parametric, Content& content) {
  const auto count = input.count(input.text_integer("the number of nodes"), {1, 0, 3}, "nodes");
  input.rest_of_line();
  content.node_tags.reserve(count);
  content.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    content.node_tags.push_back(input.integer("the number of a node"));
    auto& point = content.points.emplace_back();
    for (auto& coordinate : point)
      coordinate = input.real("a coordinate");
    if (!parametric)
      continue;
    const auto dimension = input.integer("the dimension of a node's place");
    input.integer("the tag of a node's place");
    for (Tag axis = 0; axis < dimension && dimension < 3; ++axis)
      input.real("a parameter of a node");
  }
}

void read_cells_2(Input& input, Content& content) {
  const auto count = input.count(input.text_integer("the number of cells"), {3, 0, 0}, "cells");
  input.rest_of_line();
  CellsByType cells;
  if (input.is_binary())
    read_cells_as_bytes(input, count, cells);
  else
    read_cells_as_text(input, count, cells);
  for (const auto& [type, all] : cells) {
    if (type != CellType::point1) {
      take_cells(type, all, content);
      continue;
    }
    for (std::size_t i = 0; i < all.physical.size(); ++i)
      if (all.physical[i] != 0)
        content.points_in_group[{0, all.physical[i]}].push_back(all.cells.nodes[i]);
  }
}

} // namespace rubato::mesh::msh
