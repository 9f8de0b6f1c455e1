// SPDX-License-Identifier: LGPL-3.0-or-later
/// The operators of mortar contact before an obstacle: no master, no segments; all Gauss points of the
/// slave's sub-facets that look at it.
///
///   g_j = Σ_q w_q Φ_j g(x_q) / w_j,      n_j = Σ_q w_q Φ_j n(x_q) / |…|,      stencil D_jk / w_j
/// The stencil has scalar weights and each node one averaged normal: a node before an obstacle is then the
/// same to laws and solvers as one before a meshed rigid master, whose forces n_j D_jk λ_j are directed
/// alike. The exact row Σ_q w_q Φ_j n_q N_k differs by the turn of n over a face, to second order in h/R;
/// gaps do not: they are measured point by point.
#pragma once

#include "rubato/contact/mortar/operators.hpp"
#include "rubato/contact/obstacle.hpp"

namespace rubato::contact::mortar {

/// `pose`: where the obstacle is. Points are covered within options.reach on either side, by
/// default at any distance: an obstacle has one face only, and a body may come from afar in one step. The
/// anchor of a node is the mean place it faces. Throws as the other integrate.
void integrate(const Surface& slave, const SlaveReference& reference, const Obstacle& obstacle,
               const Pose& pose, std::span<const Eigen::Vector3d> slave_x, const Options& options,
               Workspace& workspace, Operators& into);

} // namespace rubato::contact::mortar
