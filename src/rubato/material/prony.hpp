// SPDX-License-Identifier: LGPL-3.0-or-later
/// Linear viscoelasticity by a Prony series of the shear modulus, G(t) = G_∞ + Σ G_i e^(−t/τ_i); the bulk
/// modulus is elastic. Exact for strains linear in the step (Taylor, Pister, Goudreau 1970, IJNME 2).
/// Functions as point_law.hpp describes them. Abaqus: *VISCOELASTIC, TIME=PRONY (with g_i = G_i/(G_∞ + Σ
/// G_i)).
///
/// With e = dev ε, r = step/τ_i, a = e^(−r):
///   h_i = a h_i0 + 2G_i (1 − a)/r (e − e₀),   e_v,i = e − h_i/(2G_i),   s = 2G_∞ e + Σ h_i
///   D = K 1⊗1 + 2 (G_∞ + Σ G_i (1 − a)/r) I_dev
/// A step of no length is sudden: (1 − a)/r is 1.
#pragma once

#include "rubato/material/point_response.hpp"

#include <vector>

namespace rubato::material {

/// State: e₀ (6, engineering shears), then 6 numbers e_v a term.
struct Prony {
  static constexpr bool has_memory = true;
  static constexpr bool is_hyperelastic = false;
  struct Term {
    double shear = 0; ///< G_i > 0 [stress]
    double time = 0;  ///< τ_i > 0 [time]
  };
  double young = 0;   ///< E after a long time [stress]
  double poisson = 0; ///< ν after a long time
  std::vector<Term> terms;
};

inline int state_size(const Prony& law) {
  return 6 + 6 * static_cast<int>(law.terms.size());
}

bool respond(const Prony& law, const Strain6& strain, std::span<const double> old, std::span<double> now,
             const StepInfo& step, Want want, Response& out);

Dissipation dissipation(const Prony& law, std::span<const double> old, std::span<const double> now,
                        const Stress6& mean_stress);
inline Strain6 plastic_strain(const Prony&, std::span<const double>) {
  return Strain6::Zero();
}
constexpr double cumulated_plastic_strain(const Prony&, std::span<const double>) {
  return 0;
}
constexpr bool tangent_is_symmetric(const Prony&) {
  return true;
}
inline bool depends_on_rate(const Prony& law) {
  return !law.terms.empty();
}

} // namespace rubato::material
