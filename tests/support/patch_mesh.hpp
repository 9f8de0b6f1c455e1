// SPDX-License-Identifier: LGPL-3.0-or-later
/// Small meshes of the unit square or cube, of any bulk cell, bent by any map: straight-sided cells with
/// corners where the map puts them.
#pragma once

#include "rubato/core/cell_type.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace rubato::cell {
struct CellTopology;
struct ReferenceCell;
} // namespace rubato::cell

namespace rubato::test {

using Map = std::function<Eigen::Vector3d(const Eigen::Vector3d&)>;
using Corners = std::vector<mesh::NodeIndex>;

/// The cell of first order and the same shape.
CellType corner_type(const cell::CellTopology& cell);

/// Builds cells of one type from corner lists; a node between corners is shared by all cells that have those
/// corners.
class PatchBuilder {
public:
  explicit PatchBuilder(CellType type);

  mesh::NodeIndex add_node(const Eigen::Vector3d& point);
  void add_cell(const Corners& corners);
  mesh::Mesh mesh() && { return std::move(mesh_); }

private:
  mesh::NodeIndex node_between(const Corners& corners, const std::vector<double>& share);

  const cell::ReferenceCell& cell_;
  mesh::Mesh mesh_;
  std::map<Corners, mesh::NodeIndex> between_;
};

/// n boxes a direction, each cut into cells of the type, corners at map(grid point).
mesh::Mesh patch_mesh(CellType type, int n, const Map& map);

/// Keeps the outer points on their planes and throws the inner ones about, by up to `amount` of a box of side
/// 1/n.
Map shaken(int dimension, int n, double amount);

Map moved_by(const Map& map, const Eigen::Vector3d& shift);

struct BoundarySide {
  CellType type;
  std::vector<mesh::NodeIndex> nodes;
};

/// The sides that only one cell has, oriented outward.
std::vector<BoundarySide> boundary_sides(const mesh::Mesh& mesh);

/// true for every node on a side that only one cell has.
std::vector<bool> boundary_nodes(const mesh::Mesh& mesh);

/// Every cell of the mesh, of one law.
domain::Bulk whole_bulk(const mesh::Mesh& mesh, const element::Section& section, const material::Law& law);

} // namespace rubato::test
