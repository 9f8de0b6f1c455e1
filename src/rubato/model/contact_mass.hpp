// SPDX-License-Identifier: LGPL-3.0-or-later
/// Mass taken off contact surfaces.
///
/// A node that has mass and touches at once must lose its momentum at once: it bounces, and its pressure
/// oscillates from step to step whatever the step. A node without mass follows the bodies quasi-statically,
/// the equations of motion become ordinary differential equations with a continuous contact pressure, and
/// energy is conserved (H. B. Khenous, P. Laborde, Y. Renard, Mass redistribution method for finite element
/// contact problems in elastodynamics, Eur. J. Mech. A/Solids 27 (2008) 918–932).
#pragma once

#include "rubato/domain/assembly.hpp"
#include "rubato/domain/bulk.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"

#include <span>

namespace rubato::model {

/// d, one a numbered node, that takes the rows and columns of `massless` nodes out of a consistent mass
/// matrix m ⊗ 1 and gives what they had to the rest of the same body: m_ij → d_i m_ij d_j, which stays
/// positive definite, d 1 in other bodies, 0 at massless nodes, and else the values of a polynomial of second
/// degree at the nodes with which the body keeps its mass, its centre and its moments of inertia (Σ m_ij p_i
/// q_j, p and q of 1, x, y, z). A body whose inside is too thin for that, so that some d would be below 1/2
/// or beyond 2, keeps its mass and d is a constant. Throws InputError for a body without inside.
Eigen::VectorXd mass_factors(const mesh::Mesh& mesh, const domain::Bulk& bulk, const domain::DofMap& dofs,
                             std::span<const mesh::NodeIndex> massless, const domain::SparseMatrix& mass);
void scale_mass(const Eigen::VectorXd& factors, int components, domain::SparseMatrix& mass);

} // namespace rubato::model
