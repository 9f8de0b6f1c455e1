// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the energy of a run is and where it came from. [force · length]
#pragma once

#include <algorithm>
#include <cmath>

namespace rubato::step {

struct EnergyLedger {
  // Held by the bodies and their contact at this instant:
  double kinetic = 0;
  double strain = 0;
  double contact = 0; ///< stored in penalty springs, normal and tangential
  // Given and taken since the start of the run:
  double external_work = 0; ///< of the loads on the bodies
  double support_work = 0;  ///< of supports that move
  double damping = 0;       ///< dissipated by Rayleigh damping
  double friction = 0;      ///< dissipated by friction
  double start = 0;         ///< kinetic + strain + contact when the run began

  double stored() const { return kinetic + strain + contact; }
  /// What the run has gained from nowhere (> 0) or lost (< 0): 0 but for the errors of integration in time.
  double balance() const { return stored() - start + damping + friction - external_work - support_work; }
  /// The largest of all parts: what the balance is measured by.
  double largest() const {
    return std::max({std::abs(kinetic), std::abs(strain), std::abs(contact), std::abs(external_work),
                     std::abs(support_work), std::abs(damping), std::abs(friction), std::abs(start)});
  }
};

} // namespace rubato::step
