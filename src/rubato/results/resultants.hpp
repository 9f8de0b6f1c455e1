// SPDX-License-Identifier: LGPL-3.0-or-later
/// Resultants of contact zones.
#pragma once

#include <Eigen/Core>

namespace rubato::contact {
struct ZoneState;
} // namespace rubato::contact

namespace rubato::results {

struct Resultants {
  int in_contact = 0;
  int sticking = 0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero(); ///< of the master on the slave [force]
  double normal = 0;                               ///< ∫ p [force]
  double friction = 0;                             ///< |∫ tangential traction| [force]
  double largest_pressure = 0;
  double smallest_gap = 0;
};

/// Of one zone.
Resultants contact_resultants(const contact::ZoneState& state);

} // namespace rubato::results
