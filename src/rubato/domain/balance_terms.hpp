// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the work of internal forces becomes (balance.hpp).
#pragma once

namespace rubato::domain {

/// Energies [force · length].
struct Balance {
  double plastic = 0;     ///< dissipated by plastic strain; what hardening of the yield stress takes, too
  double back_stress = 0; ///< what back stresses store more than at the start
  double viscous = 0;     ///< dissipated by Prony series
  /// Σ w ({P}:[F] − {stress}:[strain + free]) at finite strain, of hyperelastic laws Σ w ({P}:[F] − [stored])
  /// + heat: the work over the step is not what the laws have it to be at its ends. Of third order in the
  /// step.
  double scheme = 0;
  double heat = 0; ///< put into the cells by what expands freely
};

} // namespace rubato::domain
