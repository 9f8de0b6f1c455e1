// SPDX-License-Identifier: LGPL-3.0-or-later
/// Everything a step changes. Accepting a step is a copy of trial to committed, rolling back is none at all.
#pragma once

#include "rubato/contact/enforcement.hpp"
#include "rubato/time/scheme.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::step {

/// What acts on the bodies at an instant, one a dof. The ledger of energies needs them; steps don't.
struct BodyForces {
  Eigen::VectorXd internal; ///< K u [force]
  Eigen::VectorXd external; ///< the loads [force]
  Eigen::VectorXd inertia;  ///< M a [force]
  Eigen::VectorXd momentum; ///< M v [force · time]
  Eigen::VectorXd damping;  ///< C v [force]; empty without damping
  Eigen::VectorXd friction; ///< the part of the contact force along the surfaces, internal side [force]
};

struct State {
  double t = 0;
  time::Motion motion; ///< u, v, a, one a dof
  Eigen::VectorXd
      unbalance; ///< internal + contact − external force at t: the scheme's history bracket [force]
  Eigen::VectorXd contact_force; ///< contact and friction, internal side [force]
  Eigen::VectorXd reaction;      ///< of the supports, on constrained dofs [force]
  double force_scale = 0;        ///< what the residual of the last step was measured by [force]
  std::vector<contact::ZoneState> zones;
  BodyForces forces;
};

} // namespace rubato::step
