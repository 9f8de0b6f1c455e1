// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/voigt.hpp"

#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/study/study.hpp"

#include <array>
#include <cmath>

namespace rubato::material {

using study::Physics;

int direct_count(Physics physics) {
  return physics == Physics::solid || physics == Physics::axisymmetric ? 3 : 2;
}

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

FullStress with_zeros(Physics physics, const Voigt& stress) {
  FullStress full = FullStress::Zero();
  switch (physics) {
  case Physics::solid:
    full = stress;
    break;
  case Physics::axisymmetric:
    full.head<4>() = stress;
    break;
  default:
    full.head<2>() = stress.head<2>();
    full[3] = stress[2];
    break;
  }
  return full;
}

FullStrain tensor_of(Physics physics, const Voigt& strain) {
  auto full = with_zeros(physics, strain);
  full.tail<3>() /= 2;
  return full;
}

double von_mises(const FullStress& stress) {
  const double direct = std::pow(stress[0] - stress[1], 2) + std::pow(stress[1] - stress[2], 2) +
                        std::pow(stress[2] - stress[0], 2);
  return std::sqrt(0.5 * direct + 3 * stress.tail<3>().squaredNorm());
}

Eigen::Vector3d principal_values(const FullStress& stress) {
  Eigen::Matrix3d tensor;
  tensor << stress[0], stress[3], stress[5], //
      stress[3], stress[1], stress[4],       //
      stress[5], stress[4], stress[2];
  return linalg::symmetric_eigenvalues(tensor).reverse();
}

double tresca(const FullStress& stress) {
  const auto principal = principal_values(stress);
  return principal[0] - principal[2];
}

double mean_stress(const FullStress& stress) {
  return stress.head<3>().sum() / 3;
}

Eigen::Matrix<double, 6, 6> strain_rotation(const Eigen::Matrix3d& r) {
  constexpr std::array<std::array<int, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  Eigen::Matrix<double, 6, 6> t;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const auto [a, b] = pairs[static_cast<std::size_t>(i)];
      const auto [c, d] = pairs[static_cast<std::size_t>(j)];
      const double both = r(c, a) * r(d, b) + r(d, a) * r(c, b);
      t(i, j) = i < 3 ? 0.5 * both : both;
    }
  return t;
}

} // namespace rubato::material
