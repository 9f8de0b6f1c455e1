// SPDX-License-Identifier: LGPL-3.0-or-later
/// R = (A + B p^n)(1 + C ln(ṗ/ε̇₀))(1 − T*^m), T* = (T − T_room)/(T_melting − T_room) (Johnson, Cook 1983,
/// Proc. 7th Int. Symp. Ballistics). The logarithm counts above the reference rate only, as in Code_Aster's
/// VMIS_JOHN_COOK (A, B, C, N_PUIS, EPSP0, M_PUIS, TROOM, TMELT) and Abaqus's *PLASTIC, HARDENING=JOHNSON
/// COOK with *RATE DEPENDENT. ṗ is Δp by the length of the step; a step of no length has the reference rate.
#pragma once

#include "rubato/material/point_response.hpp"
#include "rubato/material/yield.hpp"

namespace rubato::material {

struct JohnsonCook {
  double yield_stress = 0;   ///< A > 0 [stress]
  double factor = 0;         ///< B ≥ 0 [stress]
  double exponent = 1;       ///< n > 0
  double rate_factor = 0;    ///< C ≥ 0
  double reference_rate = 1; ///< ε̇₀ > 0 [1/time]
  double softening = 1;      ///< 1 − T*^m, > 0, of a temperature that stays
};

/// 1 − T*^m: 1 up to `room`, 0 from `melting` on. All in one unit of temperature; `exponent` m > 0.
double johnson_cook_softening(double temperature, double room, double melting, double exponent);

Yield yield(const JohnsonCook& kind, double start, double growth, const StepInfo& step);

constexpr bool depends_on_rate(const JohnsonCook& kind) {
  return kind.rate_factor != 0;
}

} // namespace rubato::material
