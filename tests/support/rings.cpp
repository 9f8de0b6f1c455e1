// SPDX-License-Identifier: LGPL-3.0-or-later
#include "support/rings.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace rubato::test {

Eigen::Vector3d circle(double angle, double radius) {
  return {radius * std::cos(angle), -radius * std::sin(angle), 0};
}

mesh::Mesh closed_rings(mesh::Mesh mesh, const RingShape& shape) {
  constexpr double whole_turn = 2 * std::numbers::pi;
  constexpr double turned = 0.03; // the pin's facets, against those of the ring
  const auto flat = mesh.points;
  const auto first_of = [&](mesh::NodeIndex node) {
    const auto& place = flat[static_cast<std::size_t>(node)];
    for (std::size_t i = 0; place.x() > whole_turn - 1e-9 && i < flat.size(); ++i)
      if (flat[i].x() < 1e-9 && std::abs(flat[i].y() - place.y()) < 1e-9)
        return static_cast<mesh::NodeIndex>(i);
    return node;
  };
  for (auto& block : mesh.blocks)
    for (auto& node : block.nodes)
      node = first_of(node);
  for (auto& point : mesh.points)
    point = point.y() < 1 ? circle(point.x() + turned, point.y()) : shape(point.x(), point.y());
  return mesh;
}

} // namespace rubato::test
