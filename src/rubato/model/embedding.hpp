// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which cell a place lies in, and where in it.
#pragma once

#include "rubato/contact/point_tree.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/build.hpp"

#include <Eigen/Core>

#include <optional>
#include <span>
#include <vector>

namespace rubato::model {

/// A place in a cell: the values of the shape functions there, one a node of the cell.
struct Embedding {
  mesh::CellIndex cell = -1;
  std::vector<double> shape;
};

/// " of group 'host'", nothing where the name is empty.
std::string of_group(const std::string& name);

/// Deforming cells of a group, or all of them when its name is empty; empty and a fault when there are none.
std::vector<mesh::CellIndex> host_cells(const mesh::Mesh& mesh, int dimension, const Mention& group,
                                        std::vector<Fault>& faults);

class CellFinder {
public:
  /// Of those cells, at least one; the mesh must outlive this.
  CellFinder(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells);

  /// The cell that a place lies in, to 1e-6 of the cell's size; where it lies on several the first of them.
  /// Cells with the node `except` are left out. Nothing where it lies in none.
  std::optional<Embedding> find(const Eigen::Vector3d& place, mesh::NodeIndex except = -1) const;

private:
  std::optional<Embedding> place_in(mesh::CellIndex cell, const Eigen::Vector3d& place) const;

  const mesh::Mesh& mesh_;
  std::vector<mesh::CellIndex> cells_;
  std::vector<Eigen::Vector3d> centres_;
  double reach_ = 0; ///< farthest node from the centre of its cell [length]
  std::optional<contact::PointTree> tree_;
};

} // namespace rubato::model
