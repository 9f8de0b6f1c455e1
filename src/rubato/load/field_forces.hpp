// SPDX-License-Identifier: LGPL-3.0-or-later
/// Consistent nodal forces of loads whose value depends on the undeformed place, F = Σ_p w_p f(x_p, t).
///
/// Places are the quadrature points of faces and edges, the nodes of nodal forces, and of body forces the
/// nodes of each cell: between them f has the cell's shape functions.
#pragma once

#include "rubato/core/field_function.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace rubato::domain {
struct Bulk;
struct DofMap;
} // namespace rubato::domain

namespace rubato::element {
struct Section;
} // namespace rubato::element

namespace rubato::load {

struct Face;

/// What a value of 1 at one place puts on the nodes.
struct LoadedPlace {
  std::array<double, 3> place{};
  std::vector<int> dofs;
  std::vector<double> weights; ///< one a dof: [force] by the unit of the value
};

/// Told of each place of a load, in an order that is always the same.
using VisitPlace = std::function<void(const LoadedPlace&)>;

/// The places of the loads of nodal_forces.hpp, with what those throw; `component` is the direction of the
/// force, 0 to 2, but for pressures.
void visit_nodal_force(const mesh::Mesh& mesh, const domain::DofMap& dofs,
                       std::span<const mesh::NodeIndex> nodes, int component, const VisitPlace& visit);
void visit_line_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const Face> edges,
                      int component, const VisitPlace& visit);
void visit_surface_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                         std::span<const Face> faces, int component, const VisitPlace& visit);
void visit_pressure(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                    std::span<const Face> faces, const VisitPlace& visit);
void visit_gravity(const mesh::Mesh& mesh, const domain::DofMap& dofs, const domain::Bulk& bulk,
                   int component, const VisitPlace& visit);

/// A load whose value changes with place and time.
struct FieldForce {
  FieldFunction value;
  std::vector<LoadedPlace> places;
};

/// Adds what `value` at one place puts on the nodes to `force`, one a dof.
void add_at(const LoadedPlace& at, double value, Eigen::VectorXd& force);

/// Adds its nodal forces at instant t to `force`, one a dof. Throws what the value throws.
void add_field_force(const FieldForce& load, double t, Eigen::VectorXd& force);

} // namespace rubato::load
