// SPDX-License-Identifier: LGPL-3.0-or-later
/// Forces of the loads and the damping of a model.
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/model/sparse_matrix.hpp"

#include <Eigen/Core>

namespace rubato::model {

/// Of loads that do not depend on displacements [force], one a dof. `load_factor`: multiplies those without
/// a function of time where the study follows a path (study::ArcLength), and 1 elsewhere.
Eigen::VectorXd external_force(const Model& model, double t, double load_factor = 1);

/// Adds the forces of pressures that follow their faces at displacements u to `force`, both with an entry a
/// dof [force].
void add_follower_forces(const Model& model, double t, const Eigen::VectorXd& u, Eigen::VectorXd& force,
                         double load_factor = 1);
/// Adds `factor` times the symmetric part of their −∂f/∂u to a compressed matrix with the places of the
/// stiffness.
void add_follower_tangent(const Model& model, double t, const Eigen::VectorXd& u, double factor,
                          SparseMatrix& matrix, double load_factor = 1);
/// What the loads that have the factor do at a factor of one [force], one a dof.
Eigen::VectorXd controlled_force(const Model& model, double t, const Eigen::VectorXd& u);

/// Whether velocities are resisted.
bool is_damped(const Model& model);
/// What resists them: C v, with the damping of modes, and of dashpots that rotate at displacements u [force].
Eigen::VectorXd damping_force(const Model& model, const Eigen::VectorXd& u, const Eigen::VectorXd& v);

} // namespace rubato::model
