// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which nodes, and which cells of bodies, are at a place of the undeformed mesh.
#pragma once

#include "rubato/mesh/box_tree.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <span>
#include <string>
#include <vector>

namespace rubato::mesh {

/// A cell that has a place: its nodes, and the values of their shape functions there.
struct CellShare {
  std::vector<NodeIndex> nodes;
  std::vector<double> weights; ///< one a node, adding up to 1
};

/// Keeps what it needs of the mesh.
class PlaceFinder {
public:
  explicit PlaceFinder(const Mesh& mesh);
  /// Of those cells only, which are of the mesh's dimension.
  PlaceFinder(const Mesh& mesh, std::span<const CellIndex> cells);

  /// The nodes within `tolerance` of the place, ascending: several where bodies touch.
  std::vector<NodeIndex> nodes_at(const Eigen::Vector3d& place) const;
  /// The cells of the mesh's dimension that have the place inside or on their boundary.
  std::vector<CellShare> cells_at(const Eigen::Vector3d& place) const;

  /// Two places within it are one: a part of the size of the mesh [length].
  double tolerance() const { return tolerance_; }
  const std::vector<Eigen::Vector3d>& points() const { return nodes_.points; }
  /// What messages call the node: its name and its place.
  std::string label_of(NodeIndex node) const;

private:
  void take_nodes(const Mesh& mesh);
  void take_cells(const Mesh& mesh, std::span<const CellIndex> cells);

  struct Cell {
    CellType type;
    std::vector<NodeIndex> nodes;
  };

  Mesh nodes_; ///< without cells and groups
  std::vector<Cell> cells_;
  double tolerance_ = 0;
  BoxTree nodes_tree_;
  BoxTree cells_tree_;
};

/// A box around each point that reaches `by` beyond it.
std::vector<Box> boxes_around(const std::vector<Eigen::Vector3d>& points, double by);

} // namespace rubato::mesh
