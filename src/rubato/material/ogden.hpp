// SPDX-License-Identifier: LGPL-3.0-or-later
/// W = Σ_i 2μ_i/α_i² (λ̄₁^α_i + λ̄₂^α_i + λ̄₃^α_i − 3) + V(J), λ̄ = J^(−1/3) λ (Ogden 1972, Proc. R. Soc. A 326).
/// Functions as point_law.hpp describes them; the strain is Green–Lagrange's. The coefficients are those of
/// Abaqus's *HYPERELASTIC, OGDEN: the shear modulus is Σ μ_i. Ogden's own are 2μ_i/α_i, with ½ Σ μ_i α_i.
/// α = 2: neo-Hookean with c10 = μ/2; α = −2: c01 = μ/2. Code_Aster has no such law.
///
/// In the axes of E, with C_a = 1 + 2E_a, e_a = ½ ln C_a, T_a = ∂W/∂e_a, T_ab = ∂²W/∂e_a∂e_b:
///   S_a = T_a/C_a,   ∂S_a/∂E_b = (T_ab − 2 δ_ab T_a)/(C_a C_b),   dS_ab = (S_a − S_b)/(E_a − E_b) dE_ab
/// The divided difference is formed from that of the exponential and that of the logarithm, neither of which
/// loses digits where two stretches are equal or nearly so.
#pragma once

#include "rubato/material/point_response.hpp"
#include "rubato/material/volumetric.hpp"

#include <vector>

namespace rubato::material {

struct Ogden {
  static constexpr bool has_memory = false;
  static constexpr bool is_hyperelastic = true;
  struct Term {
    double shear = 0;    ///< μ_i [stress]; their sum > 0
    double exponent = 2; ///< α_i, not 0
  };
  std::vector<Term> terms;
  double bulk = 0; ///< K > 0 [stress]
  Volumetric volumetric = Volumetric::logarithmic;
};

bool respond(const Ogden& law, const Strain6& strain, std::span<const double> old, std::span<double> now,
             const StepInfo& step, Want want, Response& out);

} // namespace rubato::material
