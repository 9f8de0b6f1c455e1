// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the folder only: directions of slave nodes between two meshes.
///
///   n̄_j = ∫Φ_j n_m / |…|                            n_m: outward normals of the master before node j
///   r   = min(1, o_j / 0.05)          o_j: way from node j to what the master covers, in faces
///   κ_s = κ_j + (1 − r) [j at an edge]    κ: kinks of the undeformed surfaces (kinks.hpp)
///   κ_m = r + ∫H_j ΣN_l (κ_l + [l at an edge, j at none]) / ∫H_j
///   α   = κ_m / (κ_s + κ_m + 1e-6)
///   p_j = (α m_j − (1 − α) n̄_j) / |…|,   n_j = −p_j
///
/// Where the master is smooth α is 0. A gap that is measured from places of the slave changes by −n_m when
/// the slave moves. So the gap of Φ_j changes by −n̄_j, and closed points do no work while they slide. Forces
/// along the slave's normal m_j would do work at an edge of a tilted block. Where the master has a kink or
/// an edge and the slave has none, α is 1: the force is along the normal of the smooth side, whichever of
/// them is the slave (P. Farah, W. Wall, A. Popp, Int. J. Numer. Methods Eng. 114 (2018) 255–291).
#pragma once

#include "rubato/contact/mortar/parts.hpp"

namespace rubato::contact::mortar {

/// Sets the frames of kept nodes. Needs the shares.
void set_directions(const Surface& slave, const SlaveReference& reference,
                    std::span<const Eigen::Vector3d> slave_x, const Options& options,
                    const Workspace::Impl& work, Operators& into);

} // namespace rubato::contact::mortar
