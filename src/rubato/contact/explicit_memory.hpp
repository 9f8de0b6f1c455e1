// SPDX-License-Identifier: LGPL-3.0-or-later
/// The state of the springs of contact zones between the steps of explicit runs.
#pragma once

#include "rubato/contact/friction_history.hpp"
#include "rubato/contact/status.hpp"

#include <Eigen/Core>

#include <vector>

namespace rubato::contact {

/// The spring of one contact point.
struct ExplicitSpring {
  Status status = Status::open;
  bool paired = true;    ///< at the end of the last step; in the first one no gap has an offset
  double gap_offset = 0; ///< g₀ ≤ 0
  double gap = 0;
  double pressure = 0;
  double tangential_stiffness = 0;
  Eigen::Vector3d slip = Eigen::Vector3d::Zero();     ///< elastic [length]
  Eigen::Vector3d traction = Eigen::Vector3d::Zero(); ///< tangential, on the slave [pressure]
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector2d slip_on_tangents = Eigen::Vector2d::Zero(); ///< of the last step
};

/// The springs of one zone.
struct ExplicitZoneMemory {
  std::vector<ExplicitSpring> springs;           ///< one a contact point
  std::vector<FrictionHistory> friction_history; ///< one a contact point
};

} // namespace rubato::contact
