// SPDX-License-Identifier: LGPL-3.0-or-later
/// Coordinates, blocks of cells of one type, and named groups; made once, then only read.
#pragma once

#include "rubato/cell/topology.hpp"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::mesh {

using NodeIndex = std::int32_t; ///< local, from 0
using CellIndex = std::int32_t; ///< local, from 0, running through the blocks in their order

/// Cells of one type.
struct CellBlock {
  CellType type = CellType::point1;
  std::vector<NodeIndex> nodes;        ///< cell by cell, node_count(type) each
  std::vector<std::int64_t> numbers;   ///< the file's own cell numbers, one a cell
  std::vector<std::string> names = {}; ///< those the file gives its cells, one a cell; empty: it gives none

  CellIndex cell_count() const {
    return static_cast<CellIndex>(nodes.size()) / cell::topology(type).node_count;
  }
  std::span<const NodeIndex> cell(CellIndex index_in_block) const {
    const auto n = static_cast<std::size_t>(cell::topology(type).node_count);
    return std::span(nodes).subspan(static_cast<std::size_t>(index_in_block) * n, n);
  }
};

/// A named set of node or cell indices.
struct Group {
  std::string name;
  std::vector<std::int32_t> items; ///< ascending and without repeats
  /// The items in an order of their own; empty when they have none. Files do not keep it but for .mail.
  std::vector<std::int32_t> ordered = {};

  /// In that order, else ascending.
  std::span<const std::int32_t> in_order() const { return ordered.empty() ? items : ordered; }
};

struct Mesh {
  int dimension = 3;                      ///< of space: 2 (z = 0 everywhere) or 3
  std::vector<Eigen::Vector3d> points;    ///< node coordinates [length]
  std::vector<std::int64_t> node_numbers; ///< the file's own, one a node ("N90" means what the file means)
  std::vector<std::string> node_names; ///< those the file gives its nodes, one a node; empty: it gives none
  std::vector<CellBlock> blocks;       ///< at most one a cell type, in the order of CellType
  std::vector<Group> node_groups;
  std::vector<Group> cell_groups; ///< a group of nodes and one of cells may share a name

  NodeIndex node_count() const { return static_cast<NodeIndex>(points.size()); }
  CellIndex cell_count() const;
  /// The block a cell stands in, and its index there.
  struct Place {
    const CellBlock* block;
    CellIndex index;
  };
  Place place_of(CellIndex cell) const;
  CellType type_of(CellIndex cell) const { return place_of(cell).block->type; }
  std::span<const NodeIndex> nodes_of(CellIndex cell) const;
  /// nullptr when there is no such group.
  const Group* node_group(std::string_view name) const;
  const Group* cell_group(std::string_view name) const;
};

/// The nodes a name stands for, ascending; empty when it stands for none, or for two different things
/// (names.hpp: the rules, and the reason).
std::vector<NodeIndex> nodes_named(const Mesh& mesh, std::string_view name);

/// Every group name, nodes' and cells', sorted and without repeats; for suggestions and listings.
std::vector<std::string> group_names(const Mesh& mesh);

/// Calls visit(cell index, topology, nodes) for every cell of the mesh in the order of the cell indices.
template <typename Visit> void for_each_cell(const Mesh& mesh, Visit visit) {
  CellIndex cell = 0;
  for (const auto& block : mesh.blocks) {
    const auto& shape = cell::topology(block.type);
    for (CellIndex i = 0; i < block.cell_count(); ++i)
      visit(cell++, shape, block.cell(i));
  }
}

} // namespace rubato::mesh
