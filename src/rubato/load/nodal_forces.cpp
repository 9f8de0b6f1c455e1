// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/load/nodal_forces.hpp"

#include "rubato/cell/shape_table.hpp"
#include "rubato/mesh/names.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <stdexcept>

namespace rubato::load {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;
using mesh::NodeIndex;

void check_carried(const mesh::Mesh& mesh, const domain::DofMap& dofs, NodeIndex node) {
  if (dofs.has(node))
    return;
  throw InputError(fmt::format("node {} is loaded but carries no cell that could bear a force",
                               mesh::node_name(mesh, node)));
}

void add(const mesh::Mesh& mesh, const domain::DofMap& dofs, NodeIndex node, const Vector3d& value,
         VectorXd& force) {
  check_carried(mesh, dofs, node);
  force.segment(dofs.dof(node, 0), dofs.components) += value.head(dofs.components);
}

/// A quadrature point of a face: its x, and ∂x/∂ξ, ∂x/∂η there (edges: only the first).
struct FacePoint {
  double x = 0;
  Vector3d tangent = Vector3d::Zero();
  Vector3d second_tangent = Vector3d::Zero();
};

FacePoint face_point(const mesh::Mesh& mesh, const Face& face, const cell::ShapeTable& table, Index q) {
  const bool edge = table.gradients.rows() == table.values.rows();
  FacePoint point;
  for (Index i = 0; i < table.values.rows(); ++i) {
    const Vector3d& x = mesh.points[static_cast<std::size_t>(face.nodes[static_cast<std::size_t>(i)])];
    point.x += table.values(i, q) * x[0];
    point.tangent += table.gradients(edge ? i : 2 * i, q) * x;
    if (!edge)
      point.second_tangent += table.gradients(2 * i + 1, q) * x;
  }
  return point;
}

/// Outward, its length the area (edges: the length) per reference measure.
Vector3d area_vector(const Face& face, const FacePoint& point) {
  if (cell::topology(face.type).dimension == 1)
    return {point.tangent[1], -point.tangent[0], 0.};
  return point.tangent.cross(point.second_tangent);
}

/// Adds ∫ N `traction_at(point)` over the reference cell of each face.
template <class Traction>
void add_integral(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const Face> faces,
                  const Traction& traction_at, VectorXd& force) {
  for (const auto& face : faces) {
    const auto& table = cell::mass_table(face.type);
    for (Index q = 0; q < table.weights.size(); ++q) {
      const Vector3d value = table.weights[q] * traction_at(face, face_point(mesh, face, table, q));
      for (Index i = 0; i < table.values.rows(); ++i)
        add(mesh, dofs, face.nodes[static_cast<std::size_t>(i)], table.values(i, q) * value, force);
    }
  }
}

/// Faces have one dimension less than the body they bound.
void check_sides(const element::Section& section, std::span<const Face> faces) {
  for (const auto& face : faces)
    if (cell::topology(face.type).dimension != element::component_count(section.physics) - 1)
      throw std::invalid_argument(std::string(cell::topology(face.type).name) +
                                  " is no side of a body of this physics");
}

} // namespace

void add_nodal_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const NodeIndex> nodes,
                     const Vector3d& value, VectorXd& force) {
  for (const auto node : nodes)
    add(mesh, dofs, node, value, force);
}

void add_line_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const Face> edges,
                    const Vector3d& q, VectorXd& force) {
  for (const auto& edge : edges)
    if (cell::topology(edge.type).dimension != 1)
      throw std::invalid_argument("a line force needs segments, not " +
                                  std::string(cell::topology(edge.type).name));
  const auto per_reference_length = [&](const Face&, const FacePoint& point) -> Vector3d {
    return point.tangent.norm() * q;
  };
  add_integral(mesh, dofs, edges, per_reference_length, force);
}

void add_surface_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                       std::span<const Face> faces, const Vector3d& s, VectorXd& force) {
  check_sides(section, faces);
  const auto per_reference_area = [&](const Face& face, const FacePoint& point) -> Vector3d {
    return area_vector(face, point).norm() * element::measure(section, point.x) * s;
  };
  add_integral(mesh, dofs, faces, per_reference_area, force);
}

void add_pressure(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                  std::span<const Face> faces, double pressure, VectorXd& force) {
  check_sides(section, faces);
  const auto per_reference_area = [&](const Face& face, const FacePoint& point) -> Vector3d {
    return -pressure * element::measure(section, point.x) * area_vector(face, point);
  };
  add_integral(mesh, dofs, faces, per_reference_area, force);
}

void add_gravity(const mesh::Mesh& mesh, const domain::DofMap& dofs, const domain::Bulk& bulk,
                 const Vector3d& acceleration, VectorXd& force) {
  Eigen::MatrixXd consistent;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    const auto [block, index] = mesh.place_of(bulk.cells[i]);
    const auto nodes = block->cell(index);
    const auto size = static_cast<Index>(nodes.size());
    consistent.resize(size, size);
    element::mass(block->type, domain::CellPoints(mesh, nodes), material::density(bulk.law(i)), bulk.section,
                  consistent);
    const VectorXd node_mass = consistent.rowwise().sum();
    for (Index n = 0; n < size; ++n)
      add(mesh, dofs, nodes[static_cast<std::size_t>(n)], node_mass[n] * acceleration, force);
  }
}

} // namespace rubato::load
