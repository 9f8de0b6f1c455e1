// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/ogden.hpp"

#include "rubato/material/six.hpp"
#include "rubato/material/voigt.hpp"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>

namespace rubato::material {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// e^x − 1 − x.
double less_exponential(double x) {
  constexpr double small = 0.1;
  if (std::abs(x) > small)
    return std::expm1(x) - x;
  double sum = 0;
  double term = x;
  for (int k = 2; k < 13; ++k) { // 0.1^11/13! < 1e-20
    term *= x / k;
    sum += term;
  }
  return sum;
}

/// (e^x − 1)/x.
double mean_exponential(double x) {
  return x == 0 ? 1 : std::expm1(x) / x;
}

/// ln(1 + x)/x.
double mean_reciprocal(double x) {
  return x == 0 ? 1 : std::log1p(x) / x;
}

/// In the axes of E.
struct Principal {
  Matrix3d axes;
  Vector3d strain; ///< E_a
  Vector3d square; ///< C_a
  Vector3d shape;  ///< e_a less their mean
  double volume;   ///< ln J
};

bool find_principal(const Strain6& strain, Principal& out) {
  if (!strain.allFinite())
    return false;
  const Stress6 e = halved_shears(strain);
  Matrix3d tensor;
  tensor << e[0], e[3], e[5], e[3], e[1], e[4], e[5], e[4], e[2];
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(tensor);
  out.axes = solver.eigenvectors();
  out.strain = solver.eigenvalues();
  out.square = 1 + 2 * out.strain.array();
  if (!(out.square.minCoeff() > 0) || solver.info() != Eigen::Success)
    return false;
  for (int a = 0; a < 3; ++a)
    out.shape[a] = 0.5 * std::log1p(2 * out.strain[a]);
  out.volume = out.shape.sum();
  out.shape.array() -= out.volume / 3;
  return true;
}

/// T_a without the pressure, and the energy of the shape.
Vector3d add_shape(const Ogden& law, const Principal& at, double& energy) {
  Vector3d stress = Vector3d::Zero();
  for (const auto& [shear, exponent] : law.terms) {
    Vector3d power;
    for (int a = 0; a < 3; ++a) {
      power[a] = std::expm1(exponent * at.shape[a]);
      energy += 2 * shear / (exponent * exponent) * less_exponential(exponent * at.shape[a]);
    }
    stress += 2 * shear / exponent * (power.array() - power.sum() / 3).matrix();
  }
  return stress;
}

/// T_ab without the pressure.
Matrix3d shape_stiffness(const Ogden& law, const Principal& at) {
  Matrix3d all = Matrix3d::Zero();
  for (const auto& [shear, exponent] : law.terms) {
    const Vector3d power = (exponent * at.shape).array().exp();
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        all(a, b) += 2 * shear * ((a == b ? power[a] : 0) - (power[a] + power[b]) / 3 + power.sum() / 9);
  }
  return all;
}

/// (S_a − S_b)/(E_a − E_b), where `stress` is T_b.
double divided_difference(const Ogden& law, const Principal& at, int a, int b, double stress) {
  const double y = 2 * (at.strain[a] - at.strain[b]) / at.square[b];
  const double apart = 0.5 * std::log1p(y); // e_a − e_b
  double sum = 0;
  for (const auto& [shear, exponent] : law.terms)
    sum += 2 * shear * std::exp(exponent * at.shape[b]) * mean_exponential(exponent * apart);
  return (sum * mean_reciprocal(y) - 2 * stress) / (at.square[a] * at.square[b]);
}

Tangent6 principal_tangent(const Ogden& law, const Principal& at, const Vector3d& stress, double pressure) {
  constexpr std::array<std::array<int, 2>, 3> shears{{{0, 1}, {1, 2}, {0, 2}}};
  Tangent6 d = Tangent6::Zero();
  const Matrix3d stiffness = shape_stiffness(law, at);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      d(a, b) = (stiffness(a, b) + pressure - (a == b ? 2 * stress[a] : 0)) / (at.square[a] * at.square[b]);
  for (int i = 0; i < 3; ++i) {
    const auto [a, b] = shears[static_cast<std::size_t>(i)];
    d(3 + i, 3 + i) = 0.5 * divided_difference(law, at, a, b, stress[b]);
  }
  return d;
}

} // namespace

bool respond(const Ogden& law, const Strain6& strain, std::span<const double>, std::span<double>,
             const StepInfo&, Want want, Response& out) {
  Principal at;
  if (!find_principal(strain, at))
    return false;
  const auto volume = volume_energy(law.volumetric, law.bulk, std::expm1(2 * at.volume));
  out.stored = volume.energy;
  const Vector3d stress = add_shape(law, at, out.stored).array() + volume.first; // T_a
  const Tangent6 turn = strain_rotation(at.axes);
  out.stress.noalias() = turn.topRows<3>().transpose() * stress.cwiseQuotient(at.square);
  if (want == Want::tangent)
    out.tangent = turn.transpose() * principal_tangent(law, at, stress, volume.second) * turn;
  return true;
}

} // namespace rubato::material
