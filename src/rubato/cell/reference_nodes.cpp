// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/reference_nodes.hpp"

#include "rubato/cell/parts.hpp"

#include <vector>

namespace rubato::cell {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> reference_corners(CellType linear) {
  switch (linear) {
  case CellType::seg2:
    return {{-1, 0, 0}, {1, 0, 0}};
  case CellType::tria3:
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  case CellType::quad4:
    return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  case CellType::tetra4:
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  case CellType::pyra5:
    return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
  case CellType::penta6:
    return {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  case CellType::hexa8:
    return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
            {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  default:
    return {{0, 0, 0}};
  }
}

template <typename Corners> Vector3d mean(const std::vector<Vector3d>& points, const Corners& corners) {
  Vector3d sum = Vector3d::Zero();
  for (const auto corner : corners)
    sum += points[corner];
  return sum / static_cast<double>(std::size(corners));
}

std::vector<Vector3d> reference_nodes(const CellTopology& shape) {
  auto nodes = reference_corners(linear_type(shape.type));
  if (shape.order == 2)
    for (const auto& edge : shape.edges)
      nodes.push_back(mean(nodes, edge));
  for (const auto& side : shape.sides)
    if (centre_node(side))
      nodes.push_back(mean(nodes, side.nodes.first(4)));
  if (shape.type == CellType::tria7)
    nodes.emplace_back(1. / 3, 1. / 3, 0);
  else if (inner_node(shape))
    nodes.emplace_back(Vector3d::Zero());
  return nodes;
}

} // namespace

const Vector3d& reference_node(CellType type, int node) {
  static const auto tables = [] {
    std::vector<std::vector<Vector3d>> all;
    for (const auto& shape : all_topologies())
      all.push_back(reference_nodes(shape));
    return all;
  }();
  return tables[static_cast<std::size_t>(type)][static_cast<std::size_t>(node)];
}

} // namespace rubato::cell
