// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/linear_elastic.hpp"

#include "rubato/study/study.hpp"

#include <fmt/format.h>

namespace rubato::material {

using study::Physics;

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
  auto full = with_zeros(physics, stress);
  if (physics == Physics::plane_strain)
    full[2] = law.poisson * (stress[0] + stress[1]);
  return full;
}

FullStrain full_strain(const LinearElastic& law, Physics physics, const Voigt& strain) {
  auto full = tensor_of(physics, strain);
  if (physics == Physics::plane_stress)
    full[2] = -law.poisson / (1 - law.poisson) * (strain[0] + strain[1]);
  return full;
}

std::string described(const LinearElastic& law) {
  return fmt::format("young {:g}, poisson {:g}, density {:g}", law.young, law.poisson, law.density);
}

} // namespace rubato::material
