// SPDX-License-Identifier: LGPL-3.0-or-later
/// Integrals over the sides of bodies, by quadrature. Only this module includes this.
#pragma once

#include "rubato/cell/shape_table.hpp"
#include "rubato/load/nodal_forces.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>

namespace rubato::load {

/// A quadrature point of a face: its place, and ∂x/∂ξ, ∂x/∂η there (edges: only the first).
struct FacePoint {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d tangent = Eigen::Vector3d::Zero();
  Eigen::Vector3d second_tangent = Eigen::Vector3d::Zero();
};

/// `place_of(i)`: where the i-th node of the face is.
template <class PlaceOf>
FacePoint face_point(const cell::ShapeTable& table, Eigen::Index q, const PlaceOf& place_of) {
  const bool edge = table.gradients.rows() == table.values.rows();
  FacePoint point;
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    const Eigen::Vector3d& x = place_of(static_cast<std::size_t>(i));
    point.place += table.values(i, q) * x;
    point.tangent += table.gradients(edge ? i : 2 * i, q) * x;
    if (!edge)
      point.second_tangent += table.gradients(2 * i + 1, q) * x;
  }
  return point;
}

/// Outward, its length the area (edges: the length) per reference measure.
Eigen::Vector3d area_vector(CellType type, const FacePoint& point);

/// Calls `add(face, place, table, q, w t)` with `t` = `traction_at(face, point)`, per reference measure, and
/// the weight w of each quadrature point.
template <class Traction, class Add>
void for_each_face_point(const mesh::Mesh& mesh, std::span<const Face> faces, const Traction& traction_at,
                         const Add& add) {
  for (const auto& face : faces) {
    const auto& table = cell::mass_table(face.type);
    const auto place_of = [&](std::size_t i) -> const Eigen::Vector3d& {
      return mesh.points[static_cast<std::size_t>(face.nodes[i])];
    };
    for (Eigen::Index q = 0; q < table.weights.size(); ++q) {
      const auto point = face_point(table, q, place_of);
      const Eigen::Vector3d value = table.weights[q] * traction_at(face, point);
      add(face, point.place, table, q, value);
    }
  }
}

/// Tractions per reference measure of a force s per length, s per area and a pressure p.
inline auto per_length(const Eigen::Vector3d& s) {
  return [s](const Face&, const FacePoint& point) -> Eigen::Vector3d { return point.tangent.norm() * s; };
}
inline auto per_area(const element::Section& section, const Eigen::Vector3d& s) {
  return [&section, s](const Face& face, const FacePoint& point) -> Eigen::Vector3d {
    return area_vector(face.type, point).norm() * element::measure(section, point.place.x()) * s;
  };
}
inline auto against_normal(const element::Section& section, double pressure) {
  return [&section, pressure](const Face& face, const FacePoint& point) -> Eigen::Vector3d {
    return -pressure * element::measure(section, point.place.x()) * area_vector(face.type, point);
  };
}

/// Throws std::invalid_argument where a face has not one dimension less than the body it bounds.
void check_sides(const element::Section& section, std::span<const Face> faces);

/// Throws std::invalid_argument when a cell is no segment.
void check_edges(std::span<const Face> edges);

/// Throws InputError, naming the node, when no cell carries it.
void check_carried(const mesh::Mesh& mesh, const domain::DofMap& dofs, mesh::NodeIndex node);

} // namespace rubato::load
