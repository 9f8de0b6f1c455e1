// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/kinematics.hpp"

#include <Eigen/LU>

namespace rubato::element {
namespace {

using Eigen::Matrix3d;
using material::Tangent6;

void moduli_of(const Matrix3d& f, const Matrix3d& s, const Tangent6& tangent, Moduli& moduli) {
  const auto map = strain_by_gradient(f);
  const Eigen::Matrix<double, 6, 9> stressed = tangent.lazyProduct(map);
  moduli.noalias() = map.transpose().lazyProduct(stressed);
  add_stress_part(s, moduli);
}

void small_moduli(const Tangent6& tangent, Moduli& moduli) {
  for (int column = 0; column < 9; ++column)
    for (int row = 0; row < 9; ++row)
      moduli(row, column) = tangent(voigt_place(row % 3, row / 3), voigt_place(column % 3, column / 3));
}

} // namespace

double volume_change(const Matrix3d& h) {
  const double second = h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0) + h(1, 1) * h(2, 2) - h(1, 2) * h(2, 1) +
                        h(2, 2) * h(0, 0) - h(2, 0) * h(0, 2);
  return h.trace() + second + h.determinant();
}

Eigen::Matrix<double, 6, 9> strain_by_gradient(const Matrix3d& f) {
  Eigen::Matrix<double, 6, 9> map = Eigen::Matrix<double, 6, 9>::Zero();
  for (int n = 0; n < 3; ++n)
    for (int m = 0; m < 3; ++m)
      for (int k = 0; k < 3; ++k)
        map(voigt_place(m, n), k + 3 * n) = f(k, m);
  return map;
}

void set_moduli_between(const Matrix3d& h, const Tangent6& c, const Matrix3d& other_h, Moduli& moduli) {
  const Eigen::Matrix<double, 6, 9> stressed =
      c.lazyProduct(strain_by_gradient(Matrix3d::Identity() + other_h));
  moduli.noalias() = strain_by_gradient(Matrix3d::Identity() + h).transpose().lazyProduct(stressed);
}

void add_stress_part(const Matrix3d& s, Moduli& moduli) {
  for (int l = 0; l < 3; ++l)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        moduli(i + 3 * j, i + 3 * l) += s(j, l);
}

material::Strain6 strain_of(StrainKind kind, Deformation& deformation) {
  const Matrix3d& h = deformation.h;
  if (kind == StrainKind::small)
    return half_strain_of(h + h.transpose());
  if (kind == StrainKind::green_lagrange)
    return half_strain_of(green_lagrange_doubled(h));
  deformation.logarithm = logarithm_of(green_lagrange_doubled(h));
  return strain_of(deformation.logarithm);
}

Matrix3d first_piola(StrainKind kind, const Deformation& deformation, const material::Stress6& stress) {
  if (kind == StrainKind::small)
    return tensor_of(stress);
  const Matrix3d s =
      kind == StrainKind::green_lagrange ? tensor_of(stress) : second_piola(deformation.logarithm, stress);
  return piola_of(deformation.h, s);
}

void first_moduli(StrainKind kind, const Deformation& deformation, const material::Response& response,
                  Moduli& moduli) {
  const Matrix3d f = Matrix3d::Identity() + deformation.h;
  switch (kind) {
  case StrainKind::small:
    return small_moduli(response.tangent, moduli);
  case StrainKind::green_lagrange:
    return moduli_of(f, tensor_of(response.stress), response.tangent, moduli);
  case StrainKind::logarithmic:
    return moduli_of(f, second_piola(deformation.logarithm, response.stress),
                     green_lagrange_tangent(deformation.logarithm, response), moduli);
  }
}

material::Stress6 cauchy_stress(StrainKind kind, const Matrix3d& h, const Matrix3d& piola) {
  Matrix3d sigma = piola;
  if (kind != StrainKind::small)
    sigma = (piola + piola * h.transpose()) / (1 + volume_change(h));
  return stress_of(sigma);
}

} // namespace rubato::element
