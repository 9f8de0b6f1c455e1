// SPDX-License-Identifier: LGPL-3.0-or-later
/// Terms of the energy of a run (energy.hpp). [force · length]
#pragma once

#include <algorithm>
#include <cmath>

namespace rubato::step {

struct EnergyLedger {
  // Frozen by the bodies and their contact at this instant:
  double kinetic = 0;
  double strain = 0;
  double contact = 0;     ///< stored in penalty springs; implicit runs: normal ones
  double back_stress = 0; ///< stored in back stresses of plasticity
  double hourglass = 0;   ///< stored in what keeps cells of reduced integration in shape
  // Given and taken since the start of the run:
  double external_work = 0; ///< of the loads on the bodies
  double support_work = 0;  ///< of supports and obstacles that move, of interferences and gaps that change
  double overlap_work = 0;  ///< of pressures that close what overlapped when the run began
  double heat = 0;          ///< put into bodies that expand by their temperature
  double damping = 0;       ///< dissipated by Rayleigh damping
  double friction = 0;      ///< dissipated by friction
  double plastic = 0;       ///< dissipated by plastic strain
  double viscous = 0;       ///< dissipated by viscoelastic materials
  double impact = 0;        ///< taken by contact pressures and not stored: > 0 where bodies hit, < 0 gained
  double numerical = 0;     ///< dissipated by the time scheme; < 0 gained
  /// Work of internal forces over steps that bodies of finite strain, and hourglasses of those that yield,
  /// neither store nor dissipate: an error of
  /// the time scheme, too; < 0 gained.
  double bulk_scheme = 0;
  double unbalanced = 0; ///< work of the forces that iterations and the rounding of f_int left unbalanced
  double start = 0;      ///< what was stored when the run began
  /// What the rounding of internal forces may have put into all of these: a floor below which they are none.
  double rounding = 0;
  /// Would be stored in bodies that cannot expand: `strain` and `heat` are differences of such terms.
  double held_heat = 0;

  double stored() const { return kinetic + strain + contact + back_stress + hourglass; }
  /// What the ledger has no entry for: rounding.
  double balance() const {
    return stored() - start + damping + friction + plastic + viscous + impact + numerical + bulk_scheme -
           external_work - support_work - overlap_work - heat - unbalanced;
  }
  /// What the bodies have more than physics allows: < 0 as long as impacts and the scheme only take.
  double gain() const {
    return stored() - start + damping + friction + plastic + viscous - external_work - support_work -
           overlap_work - heat;
  }
  /// The largest of all parts: what the balance is measured by.
  double largest() const {
    return std::max({std::abs(kinetic), std::abs(strain), std::abs(contact), std::abs(back_stress),
                     std::abs(hourglass), std::abs(external_work), std::abs(support_work),
                     std::abs(overlap_work), std::abs(heat), std::abs(held_heat), std::abs(damping),
                     std::abs(friction), std::abs(plastic), std::abs(viscous), std::abs(impact),
                     std::abs(numerical), std::abs(bulk_scheme), std::abs(unbalanced), std::abs(start)});
  }
};

/// How far ledgers of a run were out of balance, and what it gained.
struct EnergyRecord {
  double largest = 0;         ///< of all terms at all instants
  double largest_balance = 0; ///< its magnitude
  double gain = 0;            ///< the largest one, > 0
  double gained_at = 0;       ///< when
  double by_impact = 0;       ///< parts of it
  double by_scheme = 0;
  double by_bulk_scheme = 0;

  void note(double t, const EnergyLedger& ledger);
};

} // namespace rubato::step
