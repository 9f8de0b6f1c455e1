// SPDX-License-Identifier: LGPL-3.0-or-later
// Shape functions after Zienkiewicz & Taylor, The Finite Element Method, vol. 1, ch. "Standard" and
// "serendipity" elements, each family written once for all its nodes. With ξ_i the reference coordinates of
// node i and s = ξ_a ξ_ia:
//   linear box       Π (1 + s_a) / 2
//   serendipity box  corner Π (1 + s_a) (Σ s_a − (d − 1)) / 2^d;  middle Π_(ξ_ia = 0) (1 − ξ_a²) Π_(else) (1
//   + s_a) / 2^(d−1) full box         Π of the three quadratic Lagrange polynomials of −1, 0, 1 simplex L_i;
//   L_i (2 L_i − 1), 4 L_a L_b;  with b = L_0 L_1 L_2: + 3 b, − 12 b, 27 b (TRIA7) prism            L_i (1 +
//   s) / 2;  L_i (1 + s)(2 L_i − 2 + s) / 2, 2 L_a L_b (1 + s), L_i (1 − ζ²)
#include "rubato/mesh/interpolation.hpp"

#include "rubato/mesh/cell_parts.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;
using Values = std::array<double, 27>;

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

double corner_count_factor(int dimension) {
  return 1. / (1 << dimension);
}

double linear_box(const Vector3d& node, const Vector3d& xi, int dimension) {
  double value = corner_count_factor(dimension);
  for (int a = 0; a < dimension; ++a)
    value *= 1 + xi[a] * node[a];
  return value;
}

double serendipity_box(const Vector3d& node, const Vector3d& xi, int dimension) {
  double value = corner_count_factor(dimension);
  double sum = 1. - dimension;
  bool is_corner = true;
  for (int a = 0; a < dimension; ++a) {
    const bool middle = node[a] == 0;
    value *= middle ? 2 * (1 - xi[a] * xi[a]) : 1 + xi[a] * node[a];
    sum += xi[a] * node[a];
    is_corner = is_corner && !middle;
  }
  return is_corner ? value * sum : value;
}

double full_box(const Vector3d& node, const Vector3d& xi, int dimension) {
  double value = 1;
  for (int a = 0; a < dimension; ++a)
    value *= node[a] == 0 ? 1 - xi[a] * xi[a] : xi[a] * (xi[a] + node[a]) / 2;
  return value;
}

Values box(const CellTopology& shape, const Vector3d& xi,
           double (*of_node)(const Vector3d&, const Vector3d&, int)) {
  Values values{};
  for (int i = 0; i < shape.node_count; ++i)
    values[static_cast<std::size_t>(i)] = of_node(reference_node(shape.type, i), xi, shape.dimension);
  return values;
}

Values simplex(const CellTopology& shape, const Vector3d& xi) {
  const std::array<double, 4> l{1 - xi.sum(), xi[0], xi[1], xi[2]};
  const auto corners = static_cast<std::size_t>(shape.corner_count);
  const double bubble = shape.type == CellType::tria7 ? l[0] * l[1] * l[2] : 0;
  Values values{};
  for (std::size_t i = 0; i < corners; ++i)
    values[i] = shape.order == 1 ? l[i] : l[i] * (2 * l[i] - 1) + 3 * bubble;
  if (shape.order == 2)
    for (std::size_t e = 0; e < shape.edges.size(); ++e)
      values[corners + e] = 4 * l[shape.edges[e][0]] * l[shape.edges[e][1]] - 12 * bubble;
  if (const auto inner = inner_node(shape))
    values[static_cast<std::size_t>(*inner)] = 27 * bubble;
  return values;
}

Values prism(const CellTopology& shape, const Vector3d& xi) {
  const std::array<double, 3> l{1 - xi[0] - xi[1], xi[0], xi[1]};
  const auto level = [&](std::size_t corner) { return xi[2] * (corner < 3 ? -1 : 1); };
  Values values{};
  for (std::size_t i = 0; i < 6; ++i) {
    const double s = level(i);
    values[i] = l[i % 3] * (1 + s) / 2 * (shape.order == 1 ? 1 : 2 * l[i % 3] - 2 + s);
  }
  if (shape.order == 2)
    for (std::size_t e = 0; e < shape.edges.size(); ++e) {
      const auto [a, b] = shape.edges[e];
      const bool upright = a % 3 == b % 3;
      values[6 + e] = upright ? l[a % 3] * (1 - xi[2] * xi[2]) : 2 * l[a % 3] * l[b % 3] * (1 + level(a));
    }
  return values;
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

Values shape_values(CellType type, const Vector3d& xi) {
  const auto& shape = topology(type);
  switch (type) {
  case CellType::point1:
    return {1};
  case CellType::seg2:
  case CellType::quad4:
  case CellType::hexa8:
    return box(shape, xi, linear_box);
  case CellType::quad8:
  case CellType::hexa20:
    return box(shape, xi, serendipity_box);
  case CellType::seg3:
  case CellType::quad9:
  case CellType::hexa27:
    return box(shape, xi, full_box);
  case CellType::tria3:
  case CellType::tria6:
  case CellType::tria7:
  case CellType::tetra4:
  case CellType::tetra10:
    return simplex(shape, xi);
  case CellType::penta6:
  case CellType::penta15:
    return prism(shape, xi);
  default:
    throw std::invalid_argument(std::string(shape.name) + " has no shape functions");
  }
}

Vector3d position(CellType type, std::span<const NodeIndex> nodes, const std::vector<Vector3d>& points,
                  const Vector3d& xi) {
  const auto values = shape_values(type, xi);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum += values[i] * points[static_cast<std::size_t>(nodes[i])];
  return sum;
}

} // namespace rubato::mesh
