// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/load/face_integrals.hpp"

#include <Eigen/Geometry>

#include <stdexcept>
#include <string>

namespace rubato::load {

Eigen::Vector3d area_vector(CellType type, const FacePoint& point) {
  if (cell::topology(type).dimension == 1)
    return {point.tangent[1], -point.tangent[0], 0.};
  return point.tangent.cross(point.second_tangent);
}

void check_sides(const element::Section& section, std::span<const Face> faces) {
  for (const auto& face : faces)
    if (cell::topology(face.type).dimension != element::component_count(section.physics) - 1)
      throw std::invalid_argument(std::string(cell::topology(face.type).name) +
                                  " is no side of a body of this physics");
}

void check_edges(std::span<const Face> edges) {
  for (const auto& edge : edges)
    if (cell::topology(edge.type).dimension != 1)
      throw std::invalid_argument("a line force needs segments, not " +
                                  std::string(cell::topology(edge.type).name));
}

} // namespace rubato::load
