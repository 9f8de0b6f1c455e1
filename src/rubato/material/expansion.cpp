// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/expansion.hpp"

namespace rubato::material {
namespace {

using Eigen::Matrix3d;
using study::Physics;

constexpr Eigen::Index z = 2;

/// Those of the physics among all six.
Voigt of_physics(Physics physics, const Eigen::Matrix<double, 6, 1>& all) {
  Voigt strain = all.head(strain_size(physics));
  if (direct_count(physics) == 2)
    strain << all[0], all[1], all[3];
  return strain;
}

} // namespace

std::optional<Expansion> make_expansion(const study::Material& material) {
  if (!material.expansion)
    return std::nullopt;
  const auto& along = material.expansion->along;
  Matrix3d axes = Matrix3d::Identity();
  if (material.law == study::LawKind::orthotropic)
    axes = axes_of(material.orthotropy);
  const Matrix3d tensor =
      axes * Eigen::Vector3d(along[0], along[1], along[2]).asDiagonal() * axes.transpose();
  Expansion expansion;
  expansion.strain << tensor(0, 0), tensor(1, 1), tensor(2, 2), 2 * tensor(0, 1), 2 * tensor(1, 2),
      2 * tensor(0, 2);
  expansion.reference = material.expansion->reference;
  return expansion;
}

Voigt free_strain(const Law& law, Physics physics, const Expansion& expansion) {
  Voigt strain = of_physics(physics, expansion.strain);
  if (physics == Physics::plane_strain)
    for (Eigen::Index i = 0; i < strain.size(); ++i) // −S_iz/S_zz is σ_zz of a stress 1
      strain[i] += full_stress(law, physics, Voigt::Unit(strain.size(), i))[z] * expansion.strain[z];
  return strain;
}

double held_energy(const Law& law, Physics physics, const Expansion& expansion) {
  const auto strain = free_strain(law, physics, expansion);
  double energy = strain.dot(stress(law, physics, strain));
  if (physics == Physics::plane_strain)
    energy += modulus_along_z(law) * expansion.strain[z] * expansion.strain[z];
  return energy;
}

FullStress heated_stress(const Law& law, Physics physics, const Voigt& strain, const Expansion& expansion,
                         double degrees) {
  const Voigt elastic = strain - degrees * free_strain(law, physics, expansion);
  auto full = full_stress(law, physics, stress(law, physics, elastic));
  if (physics == Physics::plane_strain)
    full[z] -= modulus_along_z(law) * expansion.strain[z] * degrees;
  return full;
}

FullStrain heated_strain(const Law& law, Physics physics, const Voigt& strain, const Expansion& expansion,
                         double degrees) {
  auto full = tensor_of(physics, strain);
  if (physics == Physics::plane_stress) {
    const Voigt elastic = strain - degrees * free_strain(law, physics, expansion);
    full[z] = full_strain(law, physics, elastic)[z] + degrees * expansion.strain[z];
  }
  return full;
}

} // namespace rubato::material
