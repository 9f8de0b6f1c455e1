// SPDX-License-Identifier: LGPL-3.0-or-later
/// A ring in the plane, pressed flat: a surface that touches itself.
#pragma once

#include "rubato/contact/surface.hpp"

#include <Eigen/Core>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace rubato::test {

/// A line of segments with its places.
struct Line {
  mesh::Mesh mesh;
  contact::Surface surface;
  std::vector<Eigen::Vector3d> x;
};

/// Adds segments from place to place, their normals to the right of the way; closed: the last leads to the
/// first.
inline void add_way(const std::vector<Eigen::Vector3d>& places, bool closed,
                    std::vector<contact::Face>& faces, mesh::Mesh& mesh) {
  const auto first = mesh.node_count();
  mesh.points.insert(mesh.points.end(), places.begin(), places.end());
  const auto count = static_cast<mesh::NodeIndex>(places.size());
  for (mesh::NodeIndex i = 0; i + (closed ? 0 : 1) < count; ++i) {
    contact::Face face;
    face.node_count = 2;
    face.nodes = {first + i, first + (i + 1) % count};
    faces.push_back(face);
  }
}

inline Line line_of(mesh::Mesh mesh, std::vector<contact::Face> faces) {
  Line line;
  line.mesh = std::move(mesh);
  line.surface = contact::make_surface(line.mesh, std::move(faces));
  line.x = line.mesh.points;
  return line;
}

/// A circle of that radius; the inside of a ring goes round clockwise.
inline std::vector<Eigen::Vector3d> circle(double radius, int count, bool inside) {
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count * (inside ? -1 : 1);
    places.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
  }
  return places;
}

inline Line ring(int count = 24) {
  Line line;
  std::vector<contact::Face> faces;
  add_way(circle(0.95, count, true), true, faces, line.mesh);
  add_way(circle(1, count, false), true, faces, line.mesh);
  return line_of(std::move(line.mesh), std::move(faces));
}

inline Eigen::Vector3d centre(const Line& line, int face) {
  const auto& nodes = line.surface.faces[static_cast<std::size_t>(face)].nodes;
  return (line.mesh.points[static_cast<std::size_t>(nodes[0])] +
          line.mesh.points[static_cast<std::size_t>(nodes[1])]) /
         2;
}

inline bool is_inside(const Line& line, int face) {
  return centre(line, face).norm() < 0.96;
}

/// The ring's inside flattened along the direction of that angle; its wall stays as thick as it is.
inline std::vector<Eigen::Vector3d> flattened(const Line& line, double angle) {
  const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0);
  std::vector<Eigen::Vector3d> x;
  for (const auto& point : line.mesh.points) {
    const Eigen::Vector3d radial = point.normalized(), inside = 0.95 * radial;
    x.push_back(inside - 0.95 * along.dot(inside) * along + (point - inside));
  }
  return x;
}

} // namespace rubato::test
