// SPDX-License-Identifier: LGPL-3.0-or-later
/// R = σ_y + H p. Code_Aster: VMIS_ISOT_LINE with H = E E_T/(E − E_T), E_T its D_SIGM_EPSI; Abaqus: *PLASTIC
/// with two points.
#pragma once

#include "rubato/material/point_response.hpp"
#include "rubato/material/yield.hpp"

namespace rubato::material {

struct LinearHardening {
  double yield_stress = 0; ///< σ_y > 0 [stress]
  double modulus = 0;      ///< H ≥ 0 [stress]
};

inline Yield yield(const LinearHardening& kind, double start, double growth, const StepInfo&) {
  return {kind.yield_stress + kind.modulus * (start + growth), kind.modulus};
}
constexpr bool depends_on_rate(const LinearHardening&) {
  return false;
}

/// H of a bar whose stress grows by E_T times the whole strain: E E_T/(E − E_T) [stress].
constexpr double hardening_modulus(double young, double tangent_modulus) {
  return young * tangent_modulus / (young - tangent_modulus);
}

} // namespace rubato::material
