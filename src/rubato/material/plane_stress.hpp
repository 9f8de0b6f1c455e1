// SPDX-License-Identifier: LGPL-3.0-or-later
/// A law of space in plane stress: E_zz is what makes σ_zz (or S_zz, T_zz) vanish. Functions as point_law.hpp
/// describes them; zz of the strain that is given does not count.
///
/// Newton's method on σ_zz(E_zz) from the E_zz of the step's start, kept between values of opposite sign,
/// until |σ_zz| ≤ 1e-12 max|σ| or ≤ 1e-15 D_zzzz max(1, |E|); then σ ← σ − D_·zz σ_zz/D_zzzz, which takes
/// that rest out, and D ← D − D_·zz D_zz·/D_zzzz (de Souza Neto, Perić, Owen, Computational Methods for
/// Plasticity, 2008, section 9.2). zz of stress and tangent are 0.
#pragma once

#include "rubato/material/space_law.hpp"

namespace rubato::material {

/// State: that of the law, then E_zz.
struct PlaneStress {
  static constexpr bool has_memory = true;
  SpaceLaw law;
};

int state_size(const PlaneStress& law);

bool respond(const PlaneStress& law, const Strain6& strain, std::span<const double> old,
             std::span<double> now, const StepInfo& step, Want want, Response& out);

Dissipation dissipation(const PlaneStress& law, std::span<const double> old, std::span<const double> now,
                        const Stress6& mean_stress);
Strain6 plastic_strain(const PlaneStress& law, std::span<const double> state);
double cumulated_plastic_strain(const PlaneStress& law, std::span<const double> state);
bool tangent_is_symmetric(const PlaneStress& law);
bool is_hyperelastic(const PlaneStress& law);
bool depends_on_rate(const PlaneStress& law);

/// E_zz of a state.
inline double strain_across(std::span<const double> state) {
  return state.back();
}

} // namespace rubato::material
