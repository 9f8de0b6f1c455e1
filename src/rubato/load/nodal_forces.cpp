// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/load/nodal_forces.hpp"

#include "rubato/core/error.hpp"
#include "rubato/load/cell_masses.hpp"
#include "rubato/load/face_integrals.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>

namespace rubato::load {

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

namespace {

void add(const mesh::Mesh& mesh, const domain::DofMap& dofs, NodeIndex node, const Vector3d& value,
         VectorXd& force) {
  check_carried(mesh, dofs, node);
  force.segment(dofs.dof(node, 0), dofs.components) += value.head(dofs.components);
}

/// Adds ∫ N `traction_at(point)` over the reference cell of each face.
template <class Traction>
void add_integral(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const Face> faces,
                  const Traction& traction_at, VectorXd& force) {
  for_each_face_point(
      mesh, faces, traction_at,
      [&](const Face& face, const Vector3d&, const cell::ShapeTable& table, Index q, const Vector3d& value) {
        for (Index i = 0; i < table.values.rows(); ++i)
          add(mesh, dofs, face.nodes[static_cast<std::size_t>(i)], table.values(i, q) * value, force);
      });
}

} // namespace

void add_nodal_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const NodeIndex> nodes,
                     const Vector3d& value, VectorXd& force) {
  for (const auto node : nodes)
    add(mesh, dofs, node, value, force);
}

void add_line_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const Face> edges,
                    const Vector3d& q, VectorXd& force) {
  check_edges(edges);
  add_integral(mesh, dofs, edges, per_length(q), force);
}

void add_surface_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                       std::span<const Face> faces, const Vector3d& s, VectorXd& force) {
  check_sides(section, faces);
  add_integral(mesh, dofs, faces, per_area(section, s), force);
}

void add_pressure(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                  std::span<const Face> faces, double pressure, VectorXd& force) {
  check_sides(section, faces);
  add_integral(mesh, dofs, faces, against_normal(section, pressure), force);
}

void add_gravity(const mesh::Mesh& mesh, const domain::DofMap& dofs, const domain::Bulk& bulk,
                 const Vector3d& acceleration, VectorXd& force) {
  for_each_cell_mass(mesh, bulk, [&](const auto& nodes, const Eigen::MatrixXd& mass) {
    const VectorXd node_mass = mass.rowwise().sum();
    for (Index n = 0; n < node_mass.size(); ++n)
      add(mesh, dofs, nodes[static_cast<std::size_t>(n)], node_mass[n] * acceleration, force);
  });
}

} // namespace rubato::load
