// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_nodes.hpp"
#include "rubato/mesh/interpolation.hpp"
#include "rubato/mesh/quality.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;

/// An edge seen from one of its ends.
struct Spoke {
  std::uint8_t far_corner;
  std::uint8_t edge;
};

/// A corner with the edges that leave it, in the order in which they make a right-handed frame.
struct Frame {
  std::uint8_t corner;
  std::array<Spoke, 3> spokes;
};

std::vector<Spoke> spokes_at(const cell::CellTopology& shape, std::uint8_t corner) {
  std::vector<Spoke> spokes;
  for (std::size_t e = 0; e < shape.edges.size(); ++e)
    for (const int end : {0, 1})
      if (shape.edges[e][static_cast<std::size_t>(end)] == corner)
        spokes.push_back({shape.edges[e][static_cast<std::size_t>(1 - end)], static_cast<std::uint8_t>(e)});
  return spokes;
}

double determinant(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  return a.cross(b).dot(c);
}

/// The apex of a pyramid, where four edges meet, has no frame.
std::vector<Frame> frames_of(const cell::CellTopology& shape) {
  std::vector<Frame> frames;
  for (std::uint8_t corner = 0; corner < shape.corner_count; ++corner) {
    auto spokes = spokes_at(shape, corner);
    if (spokes.size() != static_cast<std::size_t>(shape.dimension) || shape.dimension < 2)
      continue;
    const auto tangent = [&](std::size_t i) -> Vector3d {
      return cell::reference_node(shape.type, spokes[i].far_corner) -
             cell::reference_node(shape.type, corner);
    };
    const Vector3d third = shape.dimension == 3 ? tangent(2) : Vector3d::UnitZ();
    if (determinant(tangent(0), tangent(1), third) < 0)
      std::swap(spokes[0], spokes[1]);
    Frame frame{corner, {}};
    std::ranges::copy(spokes, frame.spokes.begin());
    frames.push_back(frame);
  }
  return frames;
}

const std::vector<Frame>& frames(CellType type) {
  static const auto tables = [] {
    std::vector<std::vector<Frame>> all;
    for (const auto& shape : cell::all_topologies())
      all.push_back(frames_of(shape));
    return all;
  }();
  return tables[static_cast<std::size_t>(type)];
}

/// The determinant of unit tangents at a corner of the ideal cell, inverted.
double ideal_factor(CellType type) {
  switch (cell::linear_type(type)) {
  case CellType::tria3:
  case CellType::penta6:
    return 2 / std::numbers::sqrt3;
  case CellType::tetra4:
  case CellType::pyra5:
    return std::numbers::sqrt2;
  default:
    return 1;
  }
}

} // namespace

std::optional<double> scaled_jacobian(CellType type, std::span<const NodeIndex> nodes,
                                      const std::vector<Vector3d>& points, int space_dimension) {
  const auto& shape = cell::topology(type);
  const auto& corners = frames(type);
  if (corners.empty())
    return std::nullopt;
  const auto at = [&](std::size_t local) -> const Vector3d& {
    return points[static_cast<std::size_t>(nodes[local])];
  };
  const auto tangent = [&](const Frame& frame, std::size_t i) -> Vector3d {
    const auto& spoke = frame.spokes[i];
    if (shape.order == 1)
      return at(spoke.far_corner) - at(frame.corner);
    // The derivative of the quadratic edge at its end, equal to the chord when the middle node is in the
    // middle.
    const auto middle = static_cast<std::size_t>(cell::mid_node(shape, spoke.edge));
    return 4 * at(middle) - 3 * at(frame.corner) - at(spoke.far_corner);
  };

  Vector3d normal = Vector3d::UnitZ();
  if (shape.dimension == 2 && space_dimension == 3) {
    normal.setZero();
    for (const auto& frame : corners)
      normal += tangent(frame, 0).cross(tangent(frame, 1));
    normal.normalize();
  }

  double smallest = std::numeric_limits<double>::infinity();
  for (const auto& frame : corners) {
    const Vector3d a = tangent(frame, 0);
    const Vector3d b = tangent(frame, 1);
    const Vector3d c = shape.dimension == 3 ? tangent(frame, 2) : normal;
    const double scale = a.norm() * b.norm() * c.norm();
    smallest = std::min(smallest, scale > 0 ? determinant(a, b, c) / scale : 0.);
  }
  // A right angle of a mirrored triangle is worse than the ideal's 60°: −1 is where the scale ends.
  return std::max(-1., smallest * ideal_factor(type));
}

} // namespace rubato::mesh
