// SPDX-License-Identifier: LGPL-3.0-or-later
/// Collects nodes, cells and groups in any order and makes a Mesh of them.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rubato::mesh {

class MeshBuilder {
public:
  /// Cells are named by the order in which they were added, from 0.
  using CellHandle = std::int32_t;

  explicit MeshBuilder(int dimension);

  /// A builder that already has the nodes and the groups of nodes of `mesh`, with the same indices, numbers
  /// and names.
  static MeshBuilder on_nodes_of(const Mesh& mesh);

  /// Number 0 means not given: such nodes and cells are numbered after the largest given number, in the order
  /// of the mesh that is built. An empty name means not given: once one node (cell) has a name, those without
  /// are called by their number, "N90" (cells "M90"), and more underscores where that name is taken.
  NodeIndex add_node(const Eigen::Vector3d& point, std::int64_t number = 0, std::string name = {});
  CellHandle add_cell(CellType type, std::span<const NodeIndex> nodes, std::int64_t number = 0,
                      std::string name = {});

  /// Adding to a group that is there makes the union.
  void add_to_node_group(const std::string& name, std::span<const NodeIndex> nodes);
  void add_to_cell_group(const std::string& name, std::span<const CellHandle> cells);

  /// Everything of another mesh but its numbers and names, on nodes of its own.
  void append(const Mesh& mesh);

  const std::vector<Eigen::Vector3d>& points() const { return mesh_.points; }
  CellHandle cell_count() const { return static_cast<CellHandle>(cells_.size()); }

  Mesh build() &&;

private:
  struct Cell {
    CellType type;
    CellIndex index_in_block;
  };
  static constexpr std::size_t type_count = 19;

  std::array<CellIndex, type_count> first_cells() const;

  Mesh mesh_;
  std::array<CellBlock, type_count> blocks_;
  std::vector<Cell> cells_;
};

} // namespace rubato::mesh
