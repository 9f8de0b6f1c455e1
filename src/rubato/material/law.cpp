// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/law.hpp"

#include <cmath>

namespace rubato::material {
namespace {

using study::Physics;

/// Direct strains come first in every Voigt vector.
int direct_count(Physics physics) {
  return physics == Physics::solid || physics == Physics::axisymmetric ? 3 : 2;
}

} // namespace

int strain_size(Physics physics) {
  switch (physics) {
  case Physics::solid:
    return 6;
  case Physics::axisymmetric:
    return 4;
  default:
    return 3;
  }
}

Lame lame(const LinearElastic& law, Physics physics) {
  const double nu = law.poisson;
  const double mu = law.young / (2 * (1 + nu));
  if (physics == Physics::plane_stress)
    return {law.young * nu / (1 - nu * nu), mu};
  return {law.young * nu / ((1 + nu) * (1 - 2 * nu)), mu};
}

double energy(const LinearElastic& law, Physics physics, const Voigt& strain) {
  return 0.5 * strain.dot(stress(law, physics, strain));
}

Voigt stress(const LinearElastic& law, Physics physics, const Voigt& strain) {
  const auto [lambda, mu] = lame(law, physics);
  const int direct = direct_count(physics);
  Voigt result = mu * strain;
  result.head(direct) *= 2;
  result.head(direct).array() += lambda * strain.head(direct).sum();
  return result;
}

Tangent tangent(const LinearElastic& law, Physics physics) {
  const auto [lambda, mu] = lame(law, physics);
  const int size = strain_size(physics);
  const int direct = direct_count(physics);
  Tangent result = Tangent::Zero(size, size);
  result.diagonal().setConstant(mu);
  result.diagonal().head(direct) *= 2;
  result.topLeftCorner(direct, direct).array() += lambda;
  return result;
}

FullStress full_stress(const LinearElastic& law, Physics physics, const Voigt& stress) {
  FullStress full = FullStress::Zero();
  switch (physics) {
  case Physics::solid:
    full = stress;
    break;
  case Physics::axisymmetric:
    full.head<4>() = stress;
    break;
  case Physics::plane_strain:
    full[2] = law.poisson * (stress[0] + stress[1]);
    [[fallthrough]];
  case Physics::plane_stress:
    full[0] = stress[0];
    full[1] = stress[1];
    full[3] = stress[2];
    break;
  }
  return full;
}

double von_mises(const FullStress& stress) {
  const double direct = std::pow(stress[0] - stress[1], 2) + std::pow(stress[1] - stress[2], 2) +
                        std::pow(stress[2] - stress[0], 2);
  return std::sqrt(0.5 * direct + 3 * stress.tail<3>().squaredNorm());
}

} // namespace rubato::material
