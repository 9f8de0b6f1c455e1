// SPDX-License-Identifier: LGPL-3.0-or-later
/// Everything a step changes. An accepted trial is moved into the state; a rejected one is dropped.
#pragma once

#include "rubato/contact/zone_state.hpp"
#include "rubato/domain/quadrature_states.hpp"
#include "rubato/time/scheme.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <memory>
#include <vector>

namespace rubato::step {

/// What the bulk answers to its motion, kept with it: a step starts without any product.
struct BulkForces {
  Eigen::VectorXd internal; ///< f_int(u), of conserving schemes that of the step that ended here [force]
  Eigen::VectorXd viscous;  ///< C v [force], empty without damping
  Eigen::VectorXd momentum; ///< M v
  Eigen::VectorXd inertia;  ///< M a [force]
};

/// The values of ∂f_int/∂u of the bulk somewhere on the way, in the pattern of its initial tangent
/// [force/length].
using Tangent = std::shared_ptr<const Eigen::VectorXd>;

struct State {
  double t = 0;
  double step = 0;     ///< length of the step that ended here; 0 where none of this run has
  time::Motion motion; ///< u, v, a, one a dof
  BulkForces bulk;
  domain::QuadratureStates bulk_points; ///< what materials remember
  Eigen::VectorXd
      moved;       ///< by the step that ended here, of static runs with nonlinear bodies; else empty [length]
  Tangent tangent; ///< that the last step ended with, of nonlinear bodies; else null
  /// Whether an effective matrix of the last step was not positive definite without contact, or not factored
  /// without it.
  bool indefinite = false;
  /// Internal + contact − external force at t, those that the scheme remembers: its history bracket [force].
  Eigen::VectorXd residual_force;
  Eigen::VectorXd contact_force;  ///< contact and friction, internal side [force]
  Eigen::VectorXd friction_force; ///< the part of it along the surfaces [force]
  Eigen::VectorXd external_force; ///< the loads at t [force]
  double load_factor = 1;         ///< of the loads that follow a path of equilibrium (study::ArcLength)
  Eigen::VectorXd reaction;       ///< of the supports, on constrained dofs [force]
  Eigen::VectorXd shortening;     ///< of each preload, once it is locked; else 0 [length]
  double force_scale = 0;         ///< the forces that the residual of the last step was measured by [force]
  std::vector<contact::ZoneState> zones;
  /// Of points that overlapped at the start of the step, unpressed, and press at its end: how far the step
  /// has moved them out along the normal they press along; 0 of others. One a contact point. [length]
  std::vector<std::vector<double>> moved_out;
};

/// Of all zones.
inline int points_in_contact(const State& state) {
  int count = 0;
  for (const auto& zone : state.zones)
    count += static_cast<int>(
        std::ranges::count_if(zone.status, [](auto status) { return status != contact::Status::open; }));
  return count;
}

} // namespace rubato::step
