// SPDX-License-Identifier: LGPL-3.0-or-later
/// R = σ_y + Q (1 − e^(−b p)) + H p (Voce 1948). The isotropic part of Code_Aster's VMIS_CIN1_CHAB: R_0 =
/// σ_y, R_I = σ_y + Q, B = b, W = 0; Abaqus: *CYCLIC HARDENING, PARAMETERS, with H = 0.
#pragma once

#include "rubato/material/point_response.hpp"
#include "rubato/material/yield.hpp"

#include <cmath>

namespace rubato::material {

struct VoceHardening {
  double yield_stress = 0; ///< σ_y > 0 [stress]
  double saturation = 0;   ///< Q; R grows by it in the end [stress]
  double exponent = 0;     ///< b ≥ 0
  double modulus = 0;      ///< H ≥ 0 [stress]
};

inline Yield yield(const VoceHardening& kind, double start, double growth, const StepInfo&) {
  const double p = start + growth;
  const double decay = std::expm1(-kind.exponent * p);
  return {kind.yield_stress - kind.saturation * decay + kind.modulus * p,
          kind.saturation * kind.exponent * (1 + decay) + kind.modulus};
}
constexpr bool depends_on_rate(const VoceHardening&) {
  return false;
}

} // namespace rubato::material
