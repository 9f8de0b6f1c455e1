// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/orthotropic.hpp"

#include "rubato/study/study.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <fmt/format.h>

#include <array>
#include <numbers>
#include <span>

namespace rubato::material {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using study::Physics;
using Matrix6 = Orthotropic::Matrix6;

Matrix6 compliance_in_own_axes(const study::Orthotropy& o) {
  const double young_z = o.young_z.value_or(o.young_x);
  const double shear_yz = o.shear_yz.value_or(o.shear_xy);
  const double shear_xz = o.shear_xz.value_or(o.shear_xy);
  Matrix6 s = Matrix6::Zero();
  s.diagonal() << 1 / o.young_x, 1 / o.young_y, 1 / young_z, 1 / o.shear_xy, 1 / shear_yz, 1 / shear_xz;
  s(0, 1) = s(1, 0) = -o.poisson_xy / o.young_x;
  s(0, 2) = s(2, 0) = -o.poisson_xz.value_or(0) / o.young_x;
  s(1, 2) = s(2, 1) = -o.poisson_yz.value_or(0) / o.young_y;
  return s;
}

/// Where the strains of the physics stand among all six.
std::span<const int> rows_of(Physics physics) {
  static constexpr std::array<int, 6> all{0, 1, 2, 3, 4, 5};
  static constexpr std::array<int, 3> plane{0, 1, 3};
  if (direct_count(physics) == 2)
    return plane;
  return std::span(all).first(static_cast<std::size_t>(strain_size(physics)));
}

} // namespace

Matrix3d axes_of(const study::Orthotropy& numbers) {
  constexpr double degree = std::numbers::pi / 180;
  return (Eigen::AngleAxisd(numbers.angle_z * degree, Vector3d::UnitZ()) *
          Eigen::AngleAxisd(numbers.angle_y * degree, Vector3d::UnitY()) *
          Eigen::AngleAxisd(numbers.angle_x * degree, Vector3d::UnitX()))
      .toRotationMatrix();
}

namespace {

Orthotropic with_axes(const study::Orthotropy& numbers, double density, const Matrix3d& axes) {
  const auto to_own = strain_rotation(axes);
  const Matrix6 own = compliance_in_own_axes(numbers).inverse();
  Matrix6 stiffness = to_own.transpose() * own * to_own; // as energies are the same in all axes
  stiffness = (0.5 * (stiffness + stiffness.transpose())).eval();
  return {numbers, density, axes, stiffness.inverse(), stiffness};
}

} // namespace

Orthotropic make_orthotropic(const study::Orthotropy& numbers, double density) {
  return with_axes(numbers, density, axes_of(numbers));
}

Orthotropic make_orthotropic(const study::Orthotropy& numbers, double density, const Matrix3d& first) {
  return with_axes(numbers, density, first * axes_of(numbers));
}

double energy(const Orthotropic& law, Physics physics, const Voigt& strain) {
  return 0.5 * strain.dot(stress(law, physics, strain));
}

Voigt stress(const Orthotropic& law, Physics physics, const Voigt& strain) {
  return tangent(law, physics) * strain;
}

Tangent tangent(const Orthotropic& law, Physics physics) {
  const auto rows = rows_of(physics);
  if (physics != Physics::plane_stress)
    return law.stiffness(rows, rows);
  const Matrix3d compliance = law.compliance(rows, rows);
  const Matrix3d inverse = compliance.inverse();
  return 0.5 * (inverse + inverse.transpose());
}

FullStress full_stress(const Orthotropic& law, Physics physics, const Voigt& stress) {
  auto full = with_zeros(physics, stress);
  if (physics == Physics::plane_strain)
    full[2] = -law.compliance.row(2).dot(full) / law.compliance(2, 2); // full[2] is 0 so far
  return full;
}

FullStrain full_strain(const Orthotropic& law, Physics physics, const Voigt& strain) {
  auto full = tensor_of(physics, strain);
  if (physics == Physics::plane_stress)
    full[2] = law.compliance.row(2).dot(with_zeros(physics, stress(law, physics, strain)));
  return full;
}

std::string described(const Orthotropic& law) {
  const auto& o = law.numbers;
  return fmt::format("orthotropic, young_x {:g}, young_y {:g}, poisson_xy {:g}, shear_xy {:g}, density {:g}",
                     o.young_x, o.young_y, o.poisson_xy, o.shear_xy, law.density);
}

} // namespace rubato::material
