// SPDX-License-Identifier: LGPL-3.0-or-later
/// Gap, slip and frame of a contact point before an obstacle, with their exact derivatives: those of
/// kinematics.hpp, with what the obstacle's formula says instead of a face.
///   g = g(x_s),   Δs_a = τ_a·[(u_s − u_s⁰) − o],   o the obstacle's way, ⁰ = start of the step
#pragma once

#include "rubato/contact/kinematics.hpp"
#include "rubato/contact/obstacle.hpp"

namespace rubato::contact {

/// What a slave point at `x` sees of the zone's obstacle.
PlaceOnObstacle place_before(const Obstacle& obstacle, const SlavePoint& point, const Eigen::Vector3d& x,
                             const Configuration& configuration);

/// Everything about the point that a contact law asks for; its unknowns are the slave's alone.
void evaluate_before(const Obstacle& obstacle, const SlavePoint& point, const Configuration& configuration,
                     Kinematics& into);

} // namespace rubato::contact
