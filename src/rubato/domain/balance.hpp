// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the work of internal forces goes at the points of cells, over a step. Notation of
/// docs/theory/energy.md: [x] = x₁ − x₀, {x} = (x₀ + x₁)/2 of the step's ends.
///
/// With stress and strain of the law, P and F of the cell, and w the volume of a point, the work [u]·{f_int}
/// of the cells is
///
///   Σ w {P}:[F] = [Σ w stored] + back_stress + plastic + viscous + scheme − heat
///
/// to rounding, as {stress}:[strain] = [stored] + what material::dissipation gives, of laws whose stress is
/// linear in the elastic strain.
#pragma once

#include "rubato/domain/balance_terms.hpp"
#include "rubato/element/nonlinear.hpp"
#include "rubato/material/point_law.hpp"

#include <span>

namespace rubato::domain {

void add(const Balance& part, Balance& sum);

/// What a law saw at a point, what expanded freely there (element::PointRecord) and the stress.
struct LawEnd {
  const material::Strain6& strain;
  const material::Strain6& free;
  const material::Stress6& stress;
};
/// Put into a volume of 1 by what expands freely over a step: −{stress}:[free]. Of hyperelastic laws, which
/// see F/(1 + a) and store by undeformed volume, {∂W/∂a} [a] with ∂W/∂a = −S:(1 + 2E)/(1 + a).
double heat_between(const material::PointLaw& law, const LawEnd& old, const LawEnd& now);

/// Whether {stress}:[strain] is what is stored and dissipated: of all laws but hyperelastic ones.
bool has_linear_stress(const material::PointLaw& law);

/// One cell at one end of a step.
struct CellEnd {
  std::span<const element::PointRecord> records; ///< one a point
  std::span<const double> states;                ///< of the law, point by point
};

void add_balance(const material::PointLaw& law, element::StrainKind strain, const CellEnd& old,
                 const CellEnd& now, Balance& sum);

/// Σ w ⅓ C α:α [force · length].
double back_stress_energy(const material::PointLaw& law, const CellEnd& end);

} // namespace rubato::domain
