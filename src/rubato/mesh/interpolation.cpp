// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/interpolation.hpp"

#include "rubato/cell/reference_cell.hpp"

#include <array>

namespace rubato::mesh {

using Eigen::Vector3d;

Vector3d position(CellType type, std::span<const NodeIndex> nodes, const std::vector<Vector3d>& points,
                  const Vector3d& xi) {
  std::array<double, 27> values{};
  cell::reference_cell(type).values(xi, std::span(values).first(nodes.size()));
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < nodes.size(); ++i)
    sum += values[i] * points[static_cast<std::size_t>(nodes[i])];
  return sum;
}

} // namespace rubato::mesh
