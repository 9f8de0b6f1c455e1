// SPDX-License-Identifier: LGPL-3.0-or-later
/// Isotropic linear elasticity. Functions as law.hpp describes them.
#pragma once

#include "rubato/material/voigt.hpp"

#include <optional>
#include <string>

namespace rubato::material {

/// The study's rules check the ranges: young > 0, −1 < poisson < 1/2, density ≥ 0.
struct LinearElastic {
  double young = 0;   ///< E [stress]
  double poisson = 0; ///< ν
  double density = 0; ///< [mass/volume]; 0 when no inertia is asked for
  bool operator==(const LinearElastic&) const = default;
};

/// σ = λ (trace of the strains at hand) 1 + 2 μ ε. In plane stress λ is the reduced E ν / (1 − ν²), which
/// keeps σ_zz = 0.
struct Lame {
  double lambda;
  double mu;
};
Lame lame(const LinearElastic& law, study::Physics physics);

constexpr int state_size(const LinearElastic&) {
  return 0;
}
inline std::optional<Lame> isotropic(const LinearElastic& law, study::Physics physics) {
  return lame(law, physics);
}
double energy(const LinearElastic& law, study::Physics physics, const Voigt& strain);
Voigt stress(const LinearElastic& law, study::Physics physics, const Voigt& strain);
Tangent tangent(const LinearElastic& law, study::Physics physics);

/// In plane strain σ_zz = ν (σ_xx + σ_yy).
FullStress full_stress(const LinearElastic& law, study::Physics physics, const Voigt& stress);

/// In plane stress ε_zz = −ν/(1 − ν) (ε_xx + ε_yy).
FullStrain full_strain(const LinearElastic& law, study::Physics physics, const Voigt& strain);

inline Eigen::Matrix3d own_axes(const LinearElastic&) {
  return Eigen::Matrix3d::Identity();
}
constexpr double modulus_along_z(const LinearElastic& law) {
  return law.young;
}

std::string described(const LinearElastic& law);

} // namespace rubato::material
