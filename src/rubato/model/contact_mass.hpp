// SPDX-License-Identifier: LGPL-3.0-or-later
/// Mass taken off contact surfaces.
///
/// A node that has mass and touches at once must lose its momentum at once: it bounces, and its pressure
/// oscillates from step to step whatever the step. A node without mass follows the bodies quasi-statically,
/// the equations of motion become ordinary differential equations with a continuous contact pressure, and
/// energy is conserved (H. B. Khenous, P. Laborde, Y. Renard, Mass redistribution method for finite element
/// contact problems in elastodynamics, Eur. J. Mech. A/Solids 27 (2008) 918–932).
#pragma once

#include "rubato/fem/assembly.hpp"
#include "rubato/fem/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"

#include <span>

namespace rubato::model {

/// Zeroes the rows and columns of `massless` nodes in a consistent mass matrix m ⊗ 1 and gives what they had
/// to the rest of the same body: every other entry of m is multiplied with 1 + ½ Σ λ_pq (p_i q_j + q_i p_j),
/// p and q out of 1, x, y, z, the smallest change (measured with m) with which each body keeps its mass, its
/// centre and its moments of inertia: Σ m_ij p_i q_j of all p and q. Throws InputError when a body has too
/// little left to carry them: every other node of it must get a positive density.
void redistribute_mass(const mesh::Mesh& mesh, const fem::DofMap& dofs,
                       std::span<const mesh::NodeIndex> massless, fem::SparseMatrix& mass);

} // namespace rubato::model
