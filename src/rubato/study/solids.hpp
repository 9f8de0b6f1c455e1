// SPDX-License-Identifier: LGPL-3.0-or-later
/// Numbers of laws beyond linear elasticity, and how cells that have them are integrated.
#pragma once

#include <array>
#include <optional>
#include <vector>

namespace rubato::study {

/// The strain that the law of a material sees.
enum class StrainKind {
  small,          ///< ε = sym ∂u/∂X; Code_Aster's PETIT
  green_lagrange, ///< E = ½(FᵀF − 1), with S; GROT_GDEP
  logarithmic     ///< E = ½ ln FᵀF, with T; GDEF_LOG
};

/// How the cells of a material are integrated.
enum class Formulation { full, mean_dilatation, enhanced, reduced };

enum class HardeningKind { linear, table, tension_table, voce, johnson_cook };

/// C and γ of dα = dε^p − γ α dp, with the back stress ⅔ C α.
struct BackStress {
  double modulus = 0; ///< C ≥ 0 [stress]
  double recall = 0;  ///< γ ≥ 0; 0: Prager's
  bool operator==(const BackStress&) const = default;
};

inline constexpr int most_back_stresses = 3;

/// von Mises' yield surface, how it grows and how it moves.
struct Plasticity {
  HardeningKind hardening = HardeningKind::linear;
  double yield_stress = 0;                   ///< σ_y > 0 [stress]; tables have it in their first point
  double modulus = 0;                        ///< H = dR/dp ≥ 0, linear and voce [stress]
  std::vector<std::array<double, 2>> points; ///< table: (p, R), tension_table: (ε, σ)
  double saturation = 0;             ///< voce: Q ≥ 0 of R = σ_y + Q (1 − e^(−b p)) + H p [stress]
  double rate = 0;                   ///< voce: b ≥ 0
  double factor = 0;                 ///< johnson_cook: B of (σ_y + B p^n)(1 + C ln ṗ/ε̇₀) [stress]
  double exponent = 1;               ///< johnson_cook: n > 0
  double rate_factor = 0;            ///< johnson_cook: C ≥ 0
  double reference_rate = 1;         ///< johnson_cook: ε̇₀ > 0 [1/time]
  std::vector<BackStress> kinematic; ///< at most most_back_stresses
  bool operator==(const Plasticity&) const = default;
};

struct PronyTerm {
  double shear = 0; ///< G_i > 0 [stress]
  double time = 0;  ///< τ_i > 0 [time]
  bool operator==(const PronyTerm&) const = default;
};

struct OgdenTerm {
  double shear = 0;    ///< μ_i [stress], as Abaqus has it: the shear modulus is Σ μ_i
  double exponent = 2; ///< α_i, not 0
  bool operator==(const OgdenTerm&) const = default;
};

/// V(J) of hyperelastic laws.
enum class VolumeEnergy {
  logarithmic, ///< K/4 (J² − 1 − 2 ln J)
  quadratic    ///< K/2 (J − 1)², Code_Aster's and Abaqus' with K = 2/D1
};

/// Stored energy of an isotropic law of C, with what changes the volume apart.
struct Hyperelasticity {
  double c10 = 0;               ///< hyperelastic, yeoh [stress]
  double c01 = 0;               ///< hyperelastic; 0: neo-Hookean [stress]
  double c20 = 0;               ///< yeoh [stress]
  double c30 = 0;               ///< yeoh [stress]
  std::vector<OgdenTerm> terms; ///< ogden
  std::optional<double> bulk;   ///< K > 0 [stress]; or Poisson's ratio of the material at small strain
  VolumeEnergy volume = VolumeEnergy::logarithmic;
  bool operator==(const Hyperelasticity&) const = default;
};

} // namespace rubato::study
