// SPDX-License-Identifier: LGPL-3.0-or-later
/// Meshes of one cell in its reference shape, and measures of cells, from the topology tables alone.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Geometry>

#include <numeric>

namespace rubato::test {

using Points = std::vector<Eigen::Vector3d>;

inline Points reference_corners(CellType type) {
  using V = Eigen::Vector3d;
  const auto& cell = cell::topology(type);
  switch (cell.dimension * 10 + cell.corner_count) {
  case 1:
    return {V(0, 0, 0)};
  case 12:
    return {V(-1, 0, 0), V(1, 0, 0)};
  case 23:
    return {V(0, 0, 0), V(1, 0, 0), V(0, 1, 0)};
  case 24:
    return {V(-1, -1, 0), V(1, -1, 0), V(1, 1, 0), V(-1, 1, 0)};
  case 34:
    return {V(0, 0, 0), V(1, 0, 0), V(0, 1, 0), V(0, 0, 1)};
  case 35:
    return {V(-1, -1, 0), V(1, -1, 0), V(1, 1, 0), V(-1, 1, 0), V(0, 0, 1)};
  case 36:
    return {V(0, 0, -1), V(1, 0, -1), V(0, 1, -1), V(0, 0, 1), V(1, 0, 1), V(0, 1, 1)};
  default:
    return {V(-1, -1, -1), V(1, -1, -1), V(1, 1, -1), V(-1, 1, -1),
            V(-1, -1, 1),  V(1, -1, 1),  V(1, 1, 1),  V(-1, 1, 1)};
  }
}

template <class Locals> Eigen::Vector3d mean_of(const Points& points, const Locals& locals, int count) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < count; ++i)
    sum += points[static_cast<std::size_t>(locals[static_cast<std::size_t>(i)])];
  return sum / count;
}

/// Where the nodes of a cell stand when its corners stand there: edge nodes in the middle of their corners,
/// face nodes of their face's, the rest in the middle of all.
inline Points filled(CellType type, const Points& corners) {
  const auto& cell = cell::topology(type);
  std::vector<int> all(static_cast<std::size_t>(cell.corner_count));
  std::iota(all.begin(), all.end(), 0);
  const auto middle = mean_of(corners, all, cell.corner_count);
  Points points = corners;
  points.resize(static_cast<std::size_t>(cell.node_count), middle);
  if (cell.order == 1 || cell.dimension == 0)
    return points;
  for (std::size_t edge = 0; edge < cell.edges.size(); ++edge)
    points[static_cast<std::size_t>(cell.corner_count) + edge] = mean_of(points, cell.edges[edge], 2);
  for (const auto& side : cell.sides)
    if (cell::topology(side.type).node_count == 9)
      points[side.nodes[8]] = mean_of(points, side.nodes, 4);
  return points;
}

inline mesh::Mesh one_cell(CellType type, int dimension) {
  mesh::Mesh mesh;
  mesh.dimension = dimension;
  mesh.points = filled(type, reference_corners(type));
  mesh::CellBlock block{type, std::vector<mesh::NodeIndex>(mesh.points.size()), {7}};
  std::iota(block.nodes.begin(), block.nodes.end(), 0);
  mesh.node_numbers.resize(mesh.points.size());
  std::iota(mesh.node_numbers.begin(), mesh.node_numbers.end(), 11);
  mesh.blocks = {block};
  mesh.node_groups = {{"corner", {0}}, {"no_node", {}}, {"nodes", block.nodes}};
  mesh.cell_groups = {{"cells", {0}}, {"no_cell", {}}};
  return mesh;
}

/// Volume of a solid by its faces, or area (in x, y) of a surface by its edges; negative when inside out.
inline double measure(CellType type, const Points& points) {
  const auto& cell = cell::topology(type);
  double sum = 0.0;
  for (const auto& side : cell.sides) {
    const auto corners = cell::topology(side.type).corner_count;
    const auto at = [&](int i) { return points[side.nodes[static_cast<std::size_t>(i % corners)]]; };
    if (cell.dimension == 2) {
      sum += 0.5 * (at(0).x() * at(1).y() - at(1).x() * at(0).y());
      continue;
    }
    const auto middle = mean_of(points, side.nodes, corners);
    for (int i = 0; i < corners; ++i)
      sum += middle.dot(at(i).cross(at(i + 1))) / 6.0;
  }
  return sum;
}

inline Points points_of(const mesh::Mesh& mesh, const mesh::CellBlock& block, mesh::CellIndex cell) {
  Points points;
  for (const auto node : block.cell(cell))
    points.push_back(mesh.points[static_cast<std::size_t>(node)]);
  return points;
}

} // namespace rubato::test
