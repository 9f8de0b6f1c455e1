// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/strain_energy.hpp"

#include "rubato/element/nonlinear/kinematics.hpp"
#include "rubato/element/nonlinear/small_square.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::element {
namespace {

using Eigen::Matrix3d;
using material::Stress6;
using material::Tangent6;

/// Of C = 1 + `excess`.
Stress6 inverse_of(const Matrix3d& excess) {
  Square<3> c, inverse;
  std::copy_n(excess.data(), 9, c.begin());
  for (const std::size_t diagonal : {0, 4, 8})
    c[diagonal] += 1;
  invert(c, inverse);
  return stress_of(Eigen::Map<const Matrix3d>(inverse.data()));
}

/// κ J.
double pressure_by_volume(std::size_t q, const EnergyState& state) {
  return state.kappa[q] * state.jacobian[q];
}

/// c += factor · I_C.
void add_symmetrizer(double factor, const Matrix3d& l, Tangent6& c) {
  constexpr std::array<std::array<int, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  for (int row = 0; row < 6; ++row)
    for (int column = 0; column < 6; ++column) {
      const auto [i, j] = pairs[place(row)];
      const auto [m, n] = pairs[place(column)];
      c(row, column) += 0.5 * factor * (l(i, m) * l(j, n) + l(i, n) * l(j, m));
    }
}

} // namespace

CellResult StrainEnergy::respond(std::span<const Matrix3d> excess, material::Want want,
                                 EnergyState& out) const {
  std::ranges::copy(excess, out.seen.begin());
  if (is_averaged())
    if (const auto result = average(excess, out); !result)
      return result;
  if (const auto result = ask_laws(want, out); !result)
    return result;
  set_stresses(out);
  return {Failure::none, -1, out.stored};
}

void StrainEnergy::set_moduli(const EnergyState& state, EnergyModuli& moduli) const {
  AtPoints<double> along;
  for (int q = 0; q < gradients_.points(); ++q) {
    moduli.at[place(q)] = seen_tangent(place(q), state);
    if (is_averaged())
      along[place(q)] = set_mean_moduli(q, state, moduli);
  }
  if (is_averaged())
    moduli.along = space_.products(along);
}

CellResult StrainEnergy::average(std::span<const Matrix3d> excess, EnergyState& out) const {
  AtPoints<double> square_change, change; // J² − 1, J − 1
  for (int q = 0; q < gradients_.points(); ++q) {
    const auto p = place(q);
    square_change[p] = volume_change(excess[p]);
    if (!(square_change[p] > -1))
      return {Failure::inverted, q};
    out.jacobian[p] = std::sqrt(1 + square_change[p]);
    change[p] = square_change[p] / (1 + out.jacobian[p]);
  }
  const auto projected = space_.projected(change);
  for (std::size_t q = 0; q < excess.size(); ++q) {
    if (!(projected[q] > -1))
      return {Failure::inverted, static_cast<int>(q)};
    out.theta[q] = 1 + projected[q];
    const double less_one = std::expm1((2 * std::log1p(projected[q]) - std::log1p(square_change[q])) / 3);
    out.square[q] = 1 + less_one;
    out.seen[q] = out.square[q] * excess[q];
    out.seen[q].diagonal().array() += less_one;
    out.inverse[q] = inverse_of(excess[q]);
  }
  return {};
}

CellResult StrainEnergy::ask_laws(material::Want want, EnergyState& out) const {
  const bool is_logarithmic = kind_.strain == StrainKind::logarithmic;
  const auto size = place(gradients_.points());
  for (std::size_t q = 0; q < size; ++q) {
    if (is_logarithmic)
      out.logarithm[q] = logarithm_of(out.seen[q]);
    out.strain[q] = is_logarithmic ? strain_of(out.logarithm[q]) : half_strain_of(out.seen[q]);
    free_strains_.take_from(q, out.strain[q]);
  }
  const auto states = size * place(laws_.state_size());
  const auto failed = laws_.respond({{out.strain.data(), size},
                                     input_.old.first(states),
                                     now_.first(states),
                                     input_.step,
                                     want,
                                     {out.response.data(), size}});
  if (failed < size)
    return {Failure::law, static_cast<int>(failed)};
  return {};
}

void StrainEnergy::set_stresses(EnergyState& out) const {
  AtPoints<double> by_theta;
  out.stored = 0;
  for (int q = 0; q < gradients_.points(); ++q) {
    const auto p = place(q);
    out.stored += gradients_.weight(q) * out.response[p].stored;
    out.stress[p] = out.seen_stress[p] = seen_stress(p, out);
    if (is_averaged()) {
      const Matrix3d s = tensor_of(out.seen_stress[p]);
      out.pressure[p] = (s.trace() + s.cwiseProduct(out.seen[p]).sum()) / 3;
      by_theta[p] = out.pressure[p] / out.theta[p];
    }
  }
  if (!is_averaged())
    return;
  out.kappa = space_.projected(by_theta);
  for (std::size_t q = 0; q < place(gradients_.points()); ++q)
    out.stress[q] =
        out.square[q] * out.seen_stress[q] + (pressure_by_volume(q, out) - out.pressure[q]) * out.inverse[q];
}

Stress6 StrainEnergy::seen_stress(std::size_t q, const EnergyState& state) const {
  const Stress6 stress = free_strains_.shrinking(q) * state.response[q].stress;
  return kind_.strain == StrainKind::logarithmic ? stress_of(second_piola(state.logarithm[q], stress))
                                                 : stress;
}

Tangent6 StrainEnergy::seen_tangent(std::size_t q, const EnergyState& state) const {
  const auto& response = state.response[q];
  const double shrinking = free_strains_.shrinking(q), factor = 0.5 * shrinking * shrinking;
  material::Response symmetric;
  symmetric.stress = response.stress;
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      symmetric.tangent(i, j) = factor * (response.tangent(i, j) + response.tangent(j, i));
  return kind_.strain == StrainKind::logarithmic ? green_lagrange_tangent(state.logarithm[q], symmetric)
                                                 : symmetric.tangent;
}

double StrainEnergy::set_mean_moduli(int q, const EnergyState& state, EnergyModuli& moduli) const {
  const auto p = place(q);
  Tangent6& c = moduli.at[p];
  const double square = state.square[p], by_volume = pressure_by_volume(p, state);
  const Stress6& l = state.inverse[p];
  material::Strain6 whole = 2 * half_strain_of(state.seen[p]); // engineering shears of C̄
  whole.head<3>().array() += 1;
  Stress6 y = Stress6::Zero();
  for (int j = 0; j < 6; ++j)
    y += whole[j] * c.col(j);
  const double both = y.dot(whole) / 9 + 2. / 3 * state.pressure[p];
  const Stress6 side = square / 3 * (y + 2 * state.seen_stress[p]);
  const Stress6 half = (both + by_volume) / 2 * l - side;
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      c(i, j) = square * square * c(i, j) + l[i] * half[j] + half[i] * l[j];
  add_symmetrizer(2 * (state.pressure[p] - by_volume), tensor_of(l), c);
  const double theta = state.theta[p];
  moduli.change[p] = state.jacobian[p] / space_.volume() * l;
  moduli.across[p] = (side - both * l) / theta;
  return gradients_.weight(q) * (both - state.pressure[p]) / (theta * theta);
}

} // namespace rubato::element
