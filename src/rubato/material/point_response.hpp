// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the laws of one point take and give. Strains and stresses have all six components, whatever the
/// physics: xx yy zz xy yz xz, shears of strains are engineering ones (γ_xy = 2 ε_xy), tension is positive.
#pragma once

#include <Eigen/Core>

#include <span>

namespace rubato::material {

using Strain6 = Eigen::Matrix<double, 6, 1>; ///< xx yy zz xy yz xz, engineering shears
using Stress6 = Eigen::Matrix<double, 6, 1>;
using Tangent6 = Eigen::Matrix<double, 6, 6>;

struct StepInfo {
  double length = 0; ///< of the step [time]; laws that depend on the rate ask for it
};

/// Work-conjugate to the strain that is given: σ to ε, S to Green–Lagrange's E, T to ½ ln C.
struct Response {
  Stress6 stress;
  Tangent6 tangent;  ///< ∂stress/∂strain with the whole step in it
  double stored = 0; ///< energy per volume that elastic strain stores
};

/// `tangent`: also the tangent; `stress` leaves it untouched.
enum class Want { stress, tangent };

/// Energy per volume over a step, for the balance: the work of the mean stress is the change of `stored` of
/// the response plus these three, to rounding, where the stress is linear in the elastic strain.
struct Dissipation {
  double plastic = 0;     ///< {σ}:[ε^p] − [⅓ C α:α]; what R(p) takes is dissipated
  double back_stress = 0; ///< [⅓ C α:α], stored
  double viscous = 0;     ///< Σ {h}:[e_v]
};

/// Every law says of itself whether it is.
template <class L>
concept SaysWhetherHyperelastic = requires {
  L::is_hyperelastic;
};

/// Whether free expansion divides F: the law stores W(F/(1 + α ΔT)). From the strains of other laws it is
/// subtracted.
template <SaysWhetherHyperelastic L> constexpr bool is_hyperelastic(const L&) {
  return L::is_hyperelastic;
}

/// The functions that laws without memory need not have of their own. Such a law says `has_memory = false`.
template <class L>
concept Memoryless = !L::has_memory;

template <Memoryless L> constexpr int state_size(const L&) {
  return 0;
}
template <Memoryless L>
Dissipation dissipation(const L&, std::span<const double>, std::span<const double>, const Stress6&) {
  return {};
}
template <Memoryless L> Strain6 plastic_strain(const L&, std::span<const double>) {
  return Strain6::Zero();
}
template <Memoryless L> double cumulated_plastic_strain(const L&, std::span<const double>) {
  return 0;
}
template <Memoryless L> constexpr bool tangent_is_symmetric(const L&) {
  return true;
}
template <Memoryless L> constexpr bool depends_on_rate(const L&) {
  return false;
}

} // namespace rubato::material
