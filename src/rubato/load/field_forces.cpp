// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/load/field_forces.hpp"

#include "rubato/load/cell_masses.hpp"
#include "rubato/load/face_integrals.hpp"

namespace rubato::load {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

std::array<double, 3> array_of(const Vector3d& x) {
  return {x[0], x[1], x[2]};
}

template <class Traction>
void visit_faces(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const Face> faces,
                 const Traction& traction_at, const VisitPlace& visit) {
  LoadedPlace at;
  const auto take = [&](const Face& face, const Vector3d& place, const cell::ShapeTable& table, Index q,
                        const Vector3d& value) {
    at.place = array_of(place);
    at.dofs.clear();
    at.weights.clear();
    for (Index i = 0; i < table.values.rows(); ++i) {
      const auto node = face.nodes[static_cast<std::size_t>(i)];
      check_carried(mesh, dofs, node);
      for (int c = 0; c < dofs.components; ++c)
        if (value[c] != 0) {
          at.dofs.push_back(dofs.dof(node, c));
          at.weights.push_back(table.values(i, q) * value[c]);
        }
    }
    visit(at);
  };
  for_each_face_point(mesh, faces, traction_at, take);
}

} // namespace

void visit_nodal_force(const mesh::Mesh& mesh, const domain::DofMap& dofs,
                       std::span<const mesh::NodeIndex> nodes, int component, const VisitPlace& visit) {
  for (const auto node : nodes) {
    check_carried(mesh, dofs, node);
    visit({array_of(mesh.points[static_cast<std::size_t>(node)]), {dofs.dof(node, component)}, {1.0}});
  }
}

void visit_line_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const Face> edges,
                      int component, const VisitPlace& visit) {
  check_edges(edges);
  visit_faces(mesh, dofs, edges, per_length(Vector3d::Unit(component)), visit);
}

void visit_surface_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                         std::span<const Face> faces, int component, const VisitPlace& visit) {
  check_sides(section, faces);
  visit_faces(mesh, dofs, faces, per_area(section, Vector3d::Unit(component)), visit);
}

void visit_pressure(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                    std::span<const Face> faces, const VisitPlace& visit) {
  check_sides(section, faces);
  visit_faces(mesh, dofs, faces, against_normal(section, 1.0), visit);
}

void visit_gravity(const mesh::Mesh& mesh, const domain::DofMap& dofs, const domain::Bulk& bulk,
                   int component, const VisitPlace& visit) {
  LoadedPlace at;
  for_each_cell_mass(mesh, bulk, [&](const auto& nodes, const Eigen::MatrixXd& mass) {
    at.dofs.clear();
    for (const auto node : nodes)
      at.dofs.push_back(dofs.dof(node, component));
    for (Index n = 0; n < mass.cols(); ++n) {
      at.place = array_of(mesh.points[static_cast<std::size_t>(nodes[static_cast<std::size_t>(n)])]);
      at.weights.assign(mass.col(n).begin(), mass.col(n).end());
      visit(at);
    }
  });
}

void add_at(const LoadedPlace& at, double value, Eigen::VectorXd& force) {
  for (std::size_t i = 0; i < at.dofs.size(); ++i)
    force[at.dofs[i]] += at.weights[i] * value;
}

void add_field_force(const FieldForce& load, double t, Eigen::VectorXd& force) {
  for (const auto& at : load.places)
    add_at(at, load.value.at(at.place, t), force);
}

} // namespace rubato::load
