// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/height.hpp"

#include "rubato/cell/topology.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace rubato::cell {
namespace {

using Eigen::Vector3d;
using Points = std::span<const Vector3d>;

const Vector3d& corner(const CellSide& side, Points points, std::size_t i) {
  return points[side.nodes[i]];
}

/// Of a triangle or of a quadrangle, which may be warped: its area times its mean normal.
Vector3d area_vector(const CellSide& face, Points points) {
  const Vector3d across = corner(face, points, 2) - corner(face, points, 0);
  if (topology(face.type).corner_count == 3)
    return 0.5 * (corner(face, points, 1) - corner(face, points, 0)).cross(across);
  return 0.5 * across.cross(corner(face, points, 3) - corner(face, points, 1));
}

Vector3d middle(const CellSide& side, Points points) {
  const auto corners = static_cast<std::size_t>(topology(side.type).corner_count);
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < corners; ++i)
    sum += corner(side, points, i);
  return sum / static_cast<double>(corners);
}

double height_of_solid(const CellTopology& shape, Points points) {
  double volume = 0, largest = 0;
  for (const auto& face : shape.sides) {
    const Vector3d area = area_vector(face, points);
    volume += area.dot(middle(face, points) - points.front()) / 3;
    largest = std::max(largest, area.squaredNorm());
  }
  return volume / std::sqrt(largest);
}

double height_of_surface(const CellTopology& shape, Points points) {
  double area = 0, longest = 0;
  for (const auto& side : shape.sides) {
    const Vector3d from = corner(side, points, 0) - points.front();
    const Vector3d to = corner(side, points, 1) - points.front();
    area += 0.5 * (from[0] * to[1] - from[1] * to[0]);
    longest = std::max(longest, (to - from).squaredNorm());
  }
  return area / std::sqrt(longest);
}

} // namespace

double least_height(CellType type, Points points) {
  const auto& shape = topology(type);
  if (shape.dimension == 3)
    return height_of_solid(shape, points);
  return shape.dimension == 2 ? height_of_surface(shape, points) : 0;
}

} // namespace rubato::cell
