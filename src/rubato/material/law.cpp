// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/law.hpp"

#include "rubato/material/make_point_law.hpp"

#include <stdexcept>

namespace rubato::material {

using study::Physics;

Law make_law(const study::Material& material) {
  const double density = material.density.value_or(0.0);
  switch (material.law) {
  case study::LawKind::elastic:
    return LinearElastic{material.young, material.poisson, density};
  case study::LawKind::orthotropic:
    return make_orthotropic(material.orthotropy, density);
  case study::LawKind::plastic:
  case study::LawKind::prony:
  case study::LawKind::hyperelastic:
  case study::LawKind::yeoh:
  case study::LawKind::ogden: {
    const auto [young, poisson] = small_strain_moduli(material);
    return LinearElastic{young, poisson, density};
  }
  }
  throw std::logic_error("a material law without its row in make_law");
}

double density(const Law& law) {
  return std::visit([](const auto& one) { return one.density; }, law);
}

int state_size(const Law& law) {
  return std::visit([](const auto& one) { return state_size(one); }, law);
}

std::optional<Lame> isotropic(const Law& law, Physics physics) {
  return std::visit([&](const auto& one) { return isotropic(one, physics); }, law);
}

double energy(const Law& law, Physics physics, const Voigt& strain) {
  return std::visit([&](const auto& one) { return energy(one, physics, strain); }, law);
}

Voigt stress(const Law& law, Physics physics, const Voigt& strain) {
  return std::visit([&](const auto& one) { return stress(one, physics, strain); }, law);
}

Tangent tangent(const Law& law, Physics physics) {
  return std::visit([&](const auto& one) { return tangent(one, physics); }, law);
}

FullStress full_stress(const Law& law, Physics physics, const Voigt& stress) {
  return std::visit([&](const auto& one) { return full_stress(one, physics, stress); }, law);
}

FullStrain full_strain(const Law& law, Physics physics, const Voigt& strain) {
  return std::visit([&](const auto& one) { return full_strain(one, physics, strain); }, law);
}

Eigen::Matrix3d own_axes(const Law& law) {
  return std::visit([](const auto& one) { return own_axes(one); }, law);
}

double modulus_along_z(const Law& law) {
  return std::visit([](const auto& one) { return modulus_along_z(one); }, law);
}

std::string described(const Law& law) {
  return std::visit([](const auto& one) { return described(one); }, law);
}

} // namespace rubato::material
