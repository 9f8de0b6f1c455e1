// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/mean_dilatation.hpp"

#include "rubato/element/nonlinear/small_square.hpp"

#include <cmath>

namespace rubato::element {
namespace {

using Eigen::Matrix3d;

/// F⁻ᵀ of F = 1 + H.
Matrix3d inverse_transposed(const Matrix3d& h) {
  Square<3> f, inverse;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      f[place(i + 3 * j)] = h(i, j) + (i == j ? 1 : 0);
  invert(f, inverse);
  Matrix3d transposed;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      transposed(j, i) = inverse[place(i + 3 * j)];
  return transposed;
}

/// a += factor · Q, Q_iKkJ = L_iJ L_kK.
void add_turned_product(const Matrix3d& l, double factor, Moduli& a) {
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k)
      for (int n = 0; n < 3; ++n) {
        const double scaled = factor * l(k, n);
        for (int i = 0; i < 3; ++i)
          a(i + 3 * n, k + 3 * j) += l(i, j) * scaled;
      }
}

} // namespace

MeanDilatation::MeanDilatation(CellPoints& cell)
    : cell_(cell), space_(cell.kind.type, cell.input.points, cell.gradients) {}

void MeanDilatation::set_conjugates(bool for_tangent) {
  AtPoints<double> by_theta;
  for (std::size_t q = 0; q < cell_.at.seen.size(); ++q) {
    pressure_[q] = pressure(static_cast<int>(q));
    by_theta[q] = pressure_[q] / theta_[q];
  }
  kappa_ = space_.projected(by_theta);
  for (std::size_t q = 0; q < cell_.at.seen.size(); ++q) {
    cell_.at.conjugate[q] =
        scale_[q] * cell_.at.piola[q] + (kappa_[q] * jacobian_[q] - pressure_[q]) * inverse_[q];
    if (for_tangent)
      change_[q] = jacobian_[q] / space_.volume() * inverse_[q];
  }
}

void MeanDilatation::set_moduli(std::span<material::Tangent6> moduli) {
  for (int q = 0; q < cell_.count(); ++q)
    put_small(q, moduli[place(q)]);
}

void MeanDilatation::set_moduli(std::span<Moduli> moduli) {
  for (int q = 0; q < cell_.count(); ++q) {
    put_large(q, moduli[place(q)]);
    moduli[place(q)] *= cell_.gradients.weight(q);
  }
}

CellResult MeanDilatation::see_small() {
  AtPoints<double> trace;
  for (std::size_t q = 0; q < cell_.at.seen.size(); ++q)
    trace[q] = cell_.at.gradient[q].trace();
  const auto projected = space_.projected(trace);
  for (std::size_t q = 0; q < cell_.at.seen.size(); ++q) {
    scale_[q] = jacobian_[q] = theta_[q] = 1;
    inverse_[q].setIdentity();
    Matrix3& seen = cell_.at.seen[q].h;
    seen = cell_.at.gradient[q];
    seen.diagonal().array() += (projected[q] - trace[q]) / 3;
  }
  return {};
}

CellResult MeanDilatation::see_large() {
  AtPoints<double> change;
  for (int q = 0; q < cell_.count(); ++q) {
    change[place(q)] = volume_change(cell_.at.gradient[place(q)]);
    if (!(change[place(q)] > -1))
      return {Failure::inverted, q};
  }
  const auto projected = space_.projected(change);
  for (int q = 0; q < cell_.count(); ++q) {
    const auto p = place(q);
    if (!(projected[p] > -1))
      return {Failure::inverted, q};
    theta_[p] = 1 + projected[p];
    scale(q, std::expm1((std::log1p(projected[p]) - std::log1p(change[p])) / 3), change[p]);
  }
  return {};
}

void MeanDilatation::scale(int q, double scale_less_one, double change) {
  const Matrix3& h = cell_.at.gradient[place(q)];
  scale_[place(q)] = 1 + scale_less_one;
  jacobian_[place(q)] = 1 + change;
  inverse_[place(q)] = inverse_transposed(h);
  Matrix3& seen = cell_.at.seen[place(q)].h;
  seen = scale_[place(q)] * h;
  seen.diagonal().array() += scale_less_one;
}

double MeanDilatation::pressure(int q) const {
  const Matrix3& p = cell_.at.piola[place(q)];
  if (cell_.is_small())
    return p.trace() / 3;
  return (p.trace() + p.cwiseProduct(cell_.at.seen[place(q)].h).sum()) / 3;
}

void MeanDilatation::put_small(int q, material::Tangent6& tangent) {
  cell_.put_weighted_tangent(q, tangent);
  material::Stress6 y, half;
  for (int i = 0; i < 6; ++i)
    y[i] = tangent(i, 0) + tangent(i, 1) + tangent(i, 2);
  const double phi = y[0] + y[1] + y[2];
  for (int i = 0; i < 6; ++i)
    half[i] = y[i] / 3 - (i < 3 ? phi / 18 : 0);
  for (int i = 0; i < 6; ++i) // 1⊗half + half⊗1 with the unit tensor
    for (int j = 0; j < 3; ++j) {
      tangent(j, i) -= half[i];
      tangent(i, j) -= half[i];
    }
  along_[place(q)] = phi / 9;
  const double by_weight = 1 / (3 * cell_.gradients.weight(q));
  for (int i = 0; i < 6; ++i)
    half[i] = (y[i] - (i < 3 ? phi / 3 : 0)) * by_weight;
  across_[place(q)] = tensor_of(half);
}

void MeanDilatation::put_large(int q, Moduli& a) {
  const auto p = place(q);
  cell_.put_moduli(q, a);
  const double s = scale_[p], s2 = s * s;
  const double by_volume = kappa_[p] * jacobian_[p];
  const double* const l = inverse_[p].data();
  const double* const first = cell_.at.piola[p].data();
  Matrix3 f = cell_.at.gradient[p];
  f.diagonal().array() += 1;
  std::array<double, 9> y{}, half;
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i)
      y[place(i)] += a(i, j) * f.data()[j];
  double phi = 0;
  for (int i = 0; i < 9; ++i)
    phi += y[place(i)] * f.data()[i];
  const double of_l = (s2 * phi / 9 + pressure_[p] / 3 + by_volume) / 2;
  for (int i = 0; i < 9; ++i)
    half[place(i)] = -s2 / 3 * y[place(i)] - s / 3 * first[i] + of_l * l[i];
  for (int j = 0; j < 9; ++j)
    for (int i = 0; i < 9; ++i)
      a(i, j) = s2 * a(i, j) + l[i] * half[place(j)] + half[place(i)] * l[j];
  add_turned_product(inverse_[p], pressure_[p] - by_volume, a);
  double* const across = across_[p].data();
  for (int i = 0; i < 9; ++i)
    across[i] =
        (s2 / 3 * (y[place(i)] - phi / 3 * l[i]) + s / 3 * first[i] - pressure_[p] / 3 * l[i]) / theta_[p];
  along_[p] = cell_.gradients.weight(q) * (s2 * phi / 9 - 2. / 3 * pressure_[p]) / (theta_[p] * theta_[p]);
}

} // namespace rubato::element
