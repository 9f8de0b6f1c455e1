// SPDX-License-Identifier: LGPL-3.0-or-later
/// Material laws: energy, stress and tangent from a strain; nothing about meshes.
///
/// Strains and stresses are Voigt vectors with engineering shears (γ_xy = 2 ε_xy), their length that of the
/// physics:
///   solid         6: xx yy zz xy yz xz
///   plane stress  3: xx yy xy
///   plane strain  3: xx yy xy
///   axisymmetric  4: xx yy zz xy with x the radius, y the axis and zz the hoop
/// Tension is positive. Units are the user's own: Young's modulus, stress and energy per volume share one.
#pragma once

#include "rubato/study/study.hpp"

#include <Eigen/Core>

namespace rubato::material {

using Voigt = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using Tangent = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using FullStress = Eigen::Matrix<double, 6, 1>; ///< xx yy zz xy yz xz, whatever the physics

/// Isotropic linear elasticity. The deck checks the ranges: young > 0, −1 < poisson < 1/2, density ≥ 0.
struct LinearElastic {
  double young = 0;   ///< E [stress]
  double poisson = 0; ///< ν
  double density = 0; ///< [mass/volume]; 0 when no inertia is asked for
  bool operator==(const LinearElastic&) const = default;
};

/// How many numbers the law remembers of a point's past.
constexpr int state_size(const LinearElastic&) {
  return 0;
}

/// Length of the Voigt vectors.
int strain_size(study::Physics physics);

/// σ = λ (trace of the strains at hand) 1 + 2 μ ε. In plane stress λ is the reduced E ν / (1 − ν²), which
/// keeps σ_zz = 0.
struct Lame {
  double lambda;
  double mu;
};
Lame lame(const LinearElastic& law, study::Physics physics);

/// ½ ε·σ per volume. `strain` has strain_size(physics) components, here and below.
double energy(const LinearElastic& law, study::Physics physics, const Voigt& strain);

Voigt stress(const LinearElastic& law, study::Physics physics, const Voigt& strain);

/// ∂σ/∂ε, symmetric positive definite.
Tangent tangent(const LinearElastic& law, study::Physics physics);

/// All six stresses: in plane strain σ_zz = ν (σ_xx + σ_yy), elsewhere what the physics leaves out is 0.
FullStress full_stress(const LinearElastic& law, study::Physics physics, const Voigt& stress);

/// √(3/2 s:s), s the deviator.
double von_mises(const FullStress& stress);

} // namespace rubato::material
