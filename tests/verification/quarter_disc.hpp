// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace rubato::verification {

/// Quadrangles of the quarter x, y ≥ 0 of a disc about the origin.
struct QuarterDisc {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<mesh::NodeIndex, 4>> cells;
};

/// Three blocks of n × n cells, one in the middle, two between it and the circle: 2n cells along the quarter.
QuarterDisc quarter_disc(double radius, int n);

} // namespace rubato::verification
