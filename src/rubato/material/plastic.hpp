// SPDX-License-Identifier: LGPL-3.0-or-later
/// Plasticity of von Mises with isotropic and kinematic hardening, integrated by backward Euler (Simo,
/// Hughes, Computational Inelasticity, 1998). Functions as point_law.hpp describes them.
///
/// √(3/2 |s − Σ X_i|²) ≤ R(p), X = ⅔ C α, dα = dε^p − γ α dp (Armstrong, Frederick 1966; γ = 0: Prager). With
/// x = Δp, m = 1/(1 + γ x) and sums over the back stresses in place of C m where there are several:
///   Y = s_trial − ⅔ C m α₀,   q = √(3/2 Y:Y),   φ(x) = q − (3G + C m) x − R(p₀ + x) = 0
///   N = 3/2 Y/q,   ε^p = ε^p₀ + x N,   α = m (α₀ + x N),   σ = K tr ε 1 + 2G (dev ε − ε^p)
///   h = 3G + C m² + R' − N:Y',   Y' = ⅔ C γ m² α₀,   N' = 3/2 Y'/q − N (N:Y')/q
///   D = K 1⊗1 + 2G (1 − 3G x/q) I_dev + 4G² (x/q) N⊗N − (4G²/h)(N + x N')⊗N
/// D is symmetric where every γ is 0. Straight strain paths are exact then; γ > 0 is of first order in the
/// step.
///
/// | hardening | kinematic | Code_Aster | Abaqus |
/// |---|---|---|---|
/// | linear | – | VMIS_ISOT_LINE | *PLASTIC |
/// | table | – | VMIS_ISOT_TRAC | *PLASTIC |
/// | H = 0 | C = E E_T/(E − E_T) | VMIS_CINE_LINE | *PLASTIC, HARDENING=KINEMATIC |
/// | linear | C = 3/2 of PRAGER C, H + C = E E_T/(E − E_T) | VMIS_ECMI_LINE | *PLASTIC, HARDENING=COMBINED |
/// | voce | C_I = C, G_0 = γ, K = A_I = 1 | VMIS_CIN1_CHAB, VMIS_CIN2_CHAB | the same |
/// | johnson_cook | – | VMIS_JOHN_COOK | *PLASTIC, HARDENING=JOHNSON COOK |
#pragma once

#include "rubato/material/hardening.hpp"
#include "rubato/material/point_response.hpp"

#include <array>

namespace rubato::material {

struct BackStress {
  double modulus = 0; ///< C ≥ 0 [stress]
  double recall = 0;  ///< γ ≥ 0
};

/// Up to three; those of modulus 0 count for nothing.
struct BackStresses {
  std::array<BackStress, 3> terms;
  int count = 0;
};

/// State: ε^p (6, engineering shears), p, then 6 numbers α a back stress.
struct Plastic {
  static constexpr bool has_memory = true;
  static constexpr bool is_hyperelastic = false;
  double young = 0;   ///< E > 0 [stress]
  double poisson = 0; ///< ν
  Hardening hardening;
  BackStresses kinematic;
};

constexpr int state_size(const Plastic& law) {
  return 7 + 6 * law.kinematic.count;
}

bool respond(const Plastic& law, const Strain6& strain, std::span<const double> old, std::span<double> now,
             const StepInfo& step, Want want, Response& out);

Dissipation dissipation(const Plastic& law, std::span<const double> old, std::span<const double> now,
                        const Stress6& mean_stress);
Strain6 plastic_strain(const Plastic& law, std::span<const double> state);
double cumulated_plastic_strain(const Plastic& law, std::span<const double> state);
bool tangent_is_symmetric(const Plastic& law);
bool depends_on_rate(const Plastic& law);

/// The largest γ Δp of a step: the error of Armstrong and Frederick's rule is of its order.
double recall_of_step(const Plastic& law, std::span<const double> old, std::span<const double> now);

} // namespace rubato::material
