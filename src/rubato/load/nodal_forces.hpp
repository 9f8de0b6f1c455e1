// SPDX-License-Identifier: LGPL-3.0-or-later
/// Loads as consistent nodal force vectors, on the undeformed shape and dead (they do not turn with the
/// body).
///
/// Each function adds to `force` (size dofs.dof_count, [force]). 2D models take the first two components of a
/// vector. An axisymmetric model's forces are those of the whole ring, 2πr. All throw InputError naming the
/// node when a loaded node carries no bulk cell.
#pragma once

#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <span>

namespace rubato::load {

/// A side of a body. Where a load needs its normal, the nodes stand in the order of cell::CellSide: in 2D the
/// body lies left of the edge, in 3D the face turns counter-clockwise seen from outside.
struct Face {
  CellType type;
  std::span<const mesh::NodeIndex> nodes;
};

/// `value` [force] on each of the nodes.
void add_nodal_force(const mesh::Mesh& mesh, const domain::DofMap& dofs,
                     std::span<const mesh::NodeIndex> nodes, const Eigen::Vector3d& value,
                     Eigen::VectorXd& force);

/// ∫ N q ds with `q` [force/length] along segments. The thickness does not enter; in an axisymmetric model q
/// is the force on the whole ring per length of the meridian. Throws std::invalid_argument when a cell is no
/// segment.
void add_line_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, std::span<const Face> edges,
                    const Eigen::Vector3d& q, Eigen::VectorXd& force);

/// ∫ N s dA with `s` [force/area] over faces; in 2D over edges, times the thickness or 2πr.
void add_surface_force(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                       std::span<const Face> faces, const Eigen::Vector3d& s, Eigen::VectorXd& force);

/// −∫ N p n dA with `pressure` [force/area] and n the outward normal: positive pushes into the body.
void add_pressure(const mesh::Mesh& mesh, const domain::DofMap& dofs, const element::Section& section,
                  std::span<const Face> faces, double pressure, Eigen::VectorXd& force);

/// ∫ ρ N g dV over the cells of `bulk` (those of a part of the body, when only it is heavy).
void add_gravity(const mesh::Mesh& mesh, const domain::DofMap& dofs, const domain::Bulk& bulk,
                 const Eigen::Vector3d& acceleration, Eigen::VectorXd& force);

} // namespace rubato::load
