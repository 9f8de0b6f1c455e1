// SPDX-License-Identifier: LGPL-3.0-or-later
/// Mass taken off contact surfaces.
///
/// A node that has mass and touches at once must lose its momentum at once: it bounces, and its pressure
/// oscillates from step to step whatever the step. A node without mass follows the bodies quasi-statically,
/// the equations of motion become ordinary differential equations with a continuous contact pressure, and
/// energy is conserved (H. B. Khenous, P. Laborde, Y. Renard, Mass redistribution method for finite element
/// contact problems in elastodynamics, Eur. J. Mech. A/Solids 27 (2008) 918–932).
///
/// Momentum and kinetic energy of the surface are those of the velocity that the body has nearby: v = P
/// v_inside, M → Pᵀ M P. P follows rigid motions exactly. Hence each body keeps its mass, its centre and its
/// moments of inertia, and M stays positive definite inside.
#pragma once

#include "rubato/contact/zone.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/sparse_matrix.hpp"
#include "rubato/mesh/mesh.hpp"

#include <span>
#include <string>
#include <vector>

namespace rubato::domain {
struct Bulk;
} // namespace rubato::domain

namespace rubato::constraint {
class Reduction;
} // namespace rubato::constraint

namespace rubato::model {

struct MasslessSurfaces {
  std::vector<mesh::NodeIndex> nodes; ///< ascending
  /// P, one row and one column a dof: of a massless node the weights, of others the identity.
  domain::SparseMatrix extrapolation;
  /// A sentence for each body that keeps the mass of its contact surfaces.
  std::vector<std::string> notes;
};

/// The surfaces that lose their mass: the slaves of all zones but ties. `mass`: consistent, whole, m ⊗ 1.
///
/// A body whose nodes inside do not determine a rotation keeps its mass, unless supports hold all of them:
/// then its inertia moves nothing. A zone on a body that keeps its mass keeps that of its whole slave.
MasslessSurfaces massless_surfaces(const mesh::Mesh& mesh, const domain::Bulk& bulk,
                                   const domain::DofMap& dofs, const constraint::Reduction& reduction,
                                   std::span<const contact::Zone> zones, const domain::SparseMatrix& mass);

/// M → Pᵀ M P.
void take_mass_off(const domain::SparseMatrix& extrapolation, domain::SparseMatrix& mass);

} // namespace rubato::model
