// SPDX-License-Identifier: LGPL-3.0-or-later
/// Strains and stresses as Voigt vectors with engineering shears (γ_xy = 2 ε_xy), their length that of the
/// physics:
///   solid         6: xx yy zz xy yz xz
///   plane stress  3: xx yy xy
///   plane strain  3: xx yy xy
///   axisymmetric  4: xx yy zz xy with x the radius, y the axis and zz the hoop
/// Tension is positive.
#pragma once

#include <Eigen/Core>

namespace rubato::study {
enum class Physics;
} // namespace rubato::study

namespace rubato::material {

using Voigt = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 6, 1>;
using Tangent = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;
using FullStress = Eigen::Matrix<double, 6, 1>; ///< xx yy zz xy yz xz, whatever the physics

/// Length of the Voigt vectors.
int strain_size(study::Physics physics);

/// How many direct strains there are: they come first in every Voigt vector.
int direct_count(study::Physics physics);

/// Stresses of the physics among all six; those that it leaves out are 0.
FullStress with_zeros(study::Physics physics, const Voigt& stress);

/// Strains of the physics among all six, as a tensor: ε_xy = γ_xy/2; those that it leaves out are 0.
using FullStrain = Eigen::Matrix<double, 6, 1>; ///< xx yy zz xy yz xz, whatever the physics
FullStrain tensor_of(study::Physics physics, const Voigt& strain);

/// √(3/2 s:s), s the deviator.
double von_mises(const FullStress& stress);
/// σ₁ ≥ σ₂ ≥ σ₃.
Eigen::Vector3d principal_values(const FullStress& stress);
/// σ₁ − σ₃.
double tresca(const FullStress& stress);
/// A third of the trace.
double mean_stress(const FullStress& stress);

/// Takes all six strains in the axes of the model to those in axes R, its columns: ε' = Rᵀ ε R with
/// engineering shears. Its transpose takes stresses back.
Eigen::Matrix<double, 6, 6> strain_rotation(const Eigen::Matrix3d& r);

} // namespace rubato::material
