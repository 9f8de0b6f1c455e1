// SPDX-License-Identifier: LGPL-3.0-or-later
/// What a hyperelastic law stores in a change of volume, V(J).
#pragma once

namespace rubato::material {

enum class Volumetric {
  logarithmic, ///< K/4 (J² − 1 − 2 ln J), which keeps J above 0
  quadratic,   ///< K/2 (J − 1)², Code_Aster's ELAS_HYPER and Abaqus's with D1 = 2/K
};

struct VolumeEnergy {
  double energy; ///< V
  double first;  ///< J V'
  double second; ///< J V' + J² V'', the derivative of J V' by ln J
};

/// `square`: J² − 1 > −1, `bulk`: K. Nothing is lost near J = 1.
VolumeEnergy volume_energy(Volumetric kind, double bulk, double square);

/// x − ln(1 + x) ≥ 0, x > −1; nothing is lost where x is small.
double less_logarithm(double x);

/// K of a shear modulus and Poisson's ratio, 2μ(1 + ν)/(3(1 − 2ν)). Code_Aster's ELAS_HYPER without K takes
/// 6(C10 + C01)/(3(1 − 2ν)), that is 1 + ν = 3/2.
constexpr double bulk_modulus(double shear, double poisson) {
  return 2 * shear * (1 + poisson) / (3 * (1 - 2 * poisson));
}

} // namespace rubato::material
