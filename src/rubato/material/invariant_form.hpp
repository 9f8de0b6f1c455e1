// SPDX-License-Identifier: LGPL-3.0-or-later
/// Hyperelastic laws W(Ī₁, Ī₂) + V(J) of Green–Lagrange's strain, C = 1 + 2E, Ī₁ = J^(−2/3) I₁, Ī₂ = J^(−4/3)
/// I₂.
///
/// Nothing is formed as a difference of numbers near 1: with C = m (1 + d), m = 1 + ⅔ tr E, d = 2 dev E/m,
/// which has no trace, g = det(1 + d) = 1 + II + III, II = −½ d:d, III = det d, B = (1 + d)⁻¹,
///   J² = m³ g,   J^(−2/3) C⁻¹ = g^(−1/3) B/m²,   Ī₁ − 3 = 3 (g^(−1/3) − 1),   Ī₂ − 3 = 3 (g^(−2/3) − 1) + II
///   g^(−2/3) A₁ = 1 − ⅓ I₁ C⁻¹ = B d,   A₂ = I₁ 1 − C − ⅔ I₂ C⁻¹ = m (B d (1 − d) − ⅔ II B)
/// a = J^(−2/3), W₁ = ∂W/∂Ī₁, W₂ = ∂W/∂Ī₂, W₁₁ = ∂²W/∂Ī₁²:
///   S = 2 a W₁ A₁ + 2 a² W₂ A₂ + J V' C⁻¹
///   ∂S/∂E = 4 a W₁ (−⅓ (A₁⊗C⁻¹ + C⁻¹⊗A₁) − ⅑ I₁ C⁻¹⊗C⁻¹ + ⅓ I₁ I_C) + 4 a² W₁₁ A₁⊗A₁
///         + 4 a² W₂ (−⅔ (A₂⊗C⁻¹ + C⁻¹⊗A₂) − 4/9 I₂ C⁻¹⊗C⁻¹ + 1⊗1 − I_sym + ⅔ I₂ I_C)
///         + (J V' + J² V'') C⁻¹⊗C⁻¹ − 2 J V' I_C,   I_C = ½ (C⁻¹_ik C⁻¹_jl + C⁻¹_il C⁻¹_jk)
/// (Holzapfel, Nonlinear Solid Mechanics, 2000, section 6.6, in another arrangement).
#pragma once

#include "rubato/material/point_response.hpp"
#include "rubato/material/volumetric.hpp"

namespace rubato::material {

/// C and what the energies are functions of.
struct Invariants {
  double first;  ///< Ī₁ − 3
  double second; ///< Ī₂ − 3
  double square; ///< J² − 1
  double a;      ///< J^(−2/3)
  double scale;  ///< m
  double minor;  ///< II of d
  Stress6 d;
  Stress6 b; ///< B
};

/// False where C is not positive definite or not finite.
bool find_invariants(const Strain6& strain, Invariants& out);

/// Derivatives of W.
struct InvariantEnergy {
  double energy;
  double first;       ///< W₁
  double second;      ///< W₂
  double first_first; ///< W₁₁
};

void set_response(const Invariants& at, const InvariantEnergy& shape, const VolumeEnergy& volume, Want want,
                  Response& out);

} // namespace rubato::material
