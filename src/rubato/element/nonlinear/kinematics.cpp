// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/kinematics.hpp"

#include <array>

namespace rubato::element {
namespace {

using Eigen::Matrix3d;
using material::Tangent6;

void small_moduli(const Tangent6& tangent, Moduli& moduli) {
  for (int column = 0; column < 9; ++column)
    for (int row = 0; row < 9; ++row)
      moduli(row, column) = tangent(voigt_place(row % 3, row / 3), voigt_place(column % 3, column / 3));
}

} // namespace

double volume_change(const Matrix3d& h) {
  const double second = h(0, 0) * h(1, 1) - h(0, 1) * h(1, 0) + h(1, 1) * h(2, 2) - h(1, 2) * h(2, 1) +
                        h(2, 2) * h(0, 0) - h(2, 0) * h(0, 2);
  const double third = h(0, 0) * (h(1, 1) * h(2, 2) - h(1, 2) * h(2, 1)) -
                       h(0, 1) * (h(1, 0) * h(2, 2) - h(1, 2) * h(2, 0)) +
                       h(0, 2) * (h(1, 0) * h(2, 1) - h(1, 1) * h(2, 0));
  return h(0, 0) + h(1, 1) + h(2, 2) + second + third;
}

void set_moduli_between(const Matrix3d& f, const Tangent6& c, const Matrix3d& other, Moduli& moduli) {
  std::array<double, 54> stressed; // C B(F'): component at row + 6 (k + 3 n)
  for (int n = 0; n < 3; ++n)
    for (int k = 0; k < 3; ++k)
      for (int row = 0; row < 6; ++row)
        stressed[static_cast<std::size_t>(row + 6 * (k + 3 * n))] = other(k, 0) * c(row, voigt_place(0, n)) +
                                                                    other(k, 1) * c(row, voigt_place(1, n)) +
                                                                    other(k, 2) * c(row, voigt_place(2, n));
  for (int column = 0; column < 9; ++column) {
    const double* const of_column = stressed.data() + 6 * column;
    for (int n = 0; n < 3; ++n)
      for (int k = 0; k < 3; ++k)
        moduli(k + 3 * n, column) = f(k, 0) * of_column[voigt_place(0, n)] +
                                    f(k, 1) * of_column[voigt_place(1, n)] +
                                    f(k, 2) * of_column[voigt_place(2, n)];
  }
}

void add_stress_part(const Matrix3d& s, Moduli& moduli) {
  for (int l = 0; l < 3; ++l)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i)
        moduli(i + 3 * j, i + 3 * l) += s(j, l);
}

material::Strain6 strain_of(StrainKind kind, Deformation& deformation) {
  const Matrix3d& h = deformation.h;
  if (kind == StrainKind::small) {
    material::Strain6 strain;
    strain << h(0, 0), h(1, 1), h(2, 2), h(0, 1) + h(1, 0), h(1, 2) + h(2, 1), h(0, 2) + h(2, 0);
    return strain;
  }
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
  if (kind == StrainKind::small)
    return small_moduli(response.tangent, moduli);
  const bool is_logarithmic = kind == StrainKind::logarithmic;
  const Matrix3d f = gradient_of(deformation.h);
  const Matrix3d s =
      is_logarithmic ? second_piola(deformation.logarithm, response.stress) : tensor_of(response.stress);
  if (is_logarithmic)
    set_moduli_between(f, green_lagrange_tangent(deformation.logarithm, response), f, moduli);
  else
    set_moduli_between(f, response.tangent, f, moduli);
  add_stress_part(s, moduli);
}

material::Stress6 cauchy_stress(StrainKind kind, const Matrix3d& h, const Matrix3d& piola) {
  if (kind == StrainKind::small)
    return stress_of(piola);
  const double by_volume = 1 + volume_change(h);
  const auto component = [&](int i, int j) {
    return (piola(i, j) + (piola(i, 0) * h(j, 0) + piola(i, 1) * h(j, 1) + piola(i, 2) * h(j, 2))) /
           by_volume;
  };
  material::Stress6 sigma;
  sigma << component(0, 0), component(1, 1), component(2, 2), component(0, 1), component(1, 2),
      component(0, 2);
  return sigma;
}

} // namespace rubato::element
