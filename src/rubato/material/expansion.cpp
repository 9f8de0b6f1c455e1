// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/expansion.hpp"

#include "rubato/study/study.hpp"
#include "rubato/study/temperature.hpp"

#include <cmath>

namespace rubato::material {
namespace {

using Eigen::Matrix3d;
using study::Physics;

constexpr Eigen::Index z = 2;

/// Those of the physics among all six.
Voigt of_physics(Physics physics, const FullExpansion& all) {
  Voigt strain = all.head(strain_size(physics));
  if (direct_count(physics) == 2)
    strain << all[0], all[1], all[3];
  return strain;
}

} // namespace

FullExpansion expansion_strain(const Law& law, const study::ThermalExpansion& expansion) {
  const Eigen::Vector3d along(expansion.along[0], expansion.along[1], expansion.along[2]);
  const Matrix3d axes = own_axes(law);
  const Matrix3d tensor = axes * along.asDiagonal() * axes.transpose();
  FullExpansion strain;
  strain << tensor(0, 0), tensor(1, 1), tensor(2, 2), 2 * tensor(0, 1), 2 * tensor(1, 2), 2 * tensor(0, 2);
  return strain;
}

Voigt free_strain(const Law& law, Physics physics, const study::ThermalExpansion& expansion) {
  const auto all = expansion_strain(law, expansion);
  Voigt strain = of_physics(physics, all);
  if (physics == Physics::plane_strain)
    for (Eigen::Index i = 0; i < strain.size(); ++i) // −S_iz/S_zz is σ_zz of a stress 1
      strain[i] += full_stress(law, physics, Voigt::Unit(strain.size(), i))[z] * all[z];
  return strain;
}

double held_energy(const Law& law, Physics physics, const study::ThermalExpansion& expansion) {
  const auto strain = free_strain(law, physics, expansion);
  double energy = strain.dot(stress(law, physics, strain));
  if (physics == Physics::plane_strain)
    energy += modulus_along_z(law) * std::pow(expansion_strain(law, expansion)[z], 2);
  return energy;
}

FullStress heated_stress(const Law& law, Physics physics, const Voigt& strain,
                         const study::ThermalExpansion& expansion, double degrees) {
  const Voigt elastic = strain - degrees * free_strain(law, physics, expansion);
  auto full = full_stress(law, physics, stress(law, physics, elastic));
  if (physics == Physics::plane_strain)
    full[z] -= modulus_along_z(law) * expansion_strain(law, expansion)[z] * degrees;
  return full;
}

FullStrain heated_strain(const Law& law, Physics physics, const Voigt& strain,
                         const study::ThermalExpansion& expansion, double degrees) {
  auto full = tensor_of(physics, strain);
  if (physics == Physics::plane_stress) {
    const Voigt elastic = strain - degrees * free_strain(law, physics, expansion);
    full[z] = full_strain(law, physics, elastic)[z] + degrees * expansion_strain(law, expansion)[z];
  }
  return full;
}

} // namespace rubato::material
