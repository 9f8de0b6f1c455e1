// SPDX-License-Identifier: LGPL-3.0-or-later
/// U of a cell as a function of C = FᵀF at its points. With E = ½(C − 1) everywhere
///
///   dU = Σ w S:dE       d²U = Σ w dE:𝐂:dE' + τ ρ' + ρ τ' + c τ τ',   τ = Σ w t:dE,  ρ = Σ w r:dE
///
/// full: S and 𝐂 of the law at the point, no more. mean_dilatation, with S̄ and 𝐂̄ of the law at C̄ = s² C,
/// J = √det C, θ = Σ w J/V, s = (θ/J)^(1/3), ℓ = C⁻¹, p = S̄:C̄/3, κ = Σ w p/(V θ), y = 𝐂̄:C̄, φ = C̄:y:
///
///   S = s² S̄ − p ℓ + κ J ℓ      t = J ℓ/(V θ)      c = Σ w (φ/9 + ⅔ p) − Σ w p
///   𝐂 = s⁴ 𝐂̄ − s²/3 (ℓ⊗(y + 2 S̄) + (y + 2 S̄)⊗ℓ) + (φ/9 + ⅔ p + κ J) ℓ⊗ℓ + 2 (p − κ J) I_C
///   r = s²/3 (y + 2 S̄) − (φ/9 + ⅔ p) ℓ,   I_C = ½ (ℓ_ik ℓ_jl + ℓ_il ℓ_jk)
///
/// C − 1 is what everything is formed from.
#pragma once

#include "rubato/element/energy_momentum.hpp"
#include "rubato/element/nonlinear/cell_gradients.hpp"
#include "rubato/element/nonlinear/free_strains.hpp"

#include <array>
#include <cmath>
#include <cstddef>

namespace rubato::element {

template <class S, class T> using AtPointsOf = std::array<T, static_cast<std::size_t>(S::most_points)>;

/// U and its derivatives at one C.
template <class S> struct EnergyState {
  double stored = 0;                                      ///< U
  AtPointsOf<S, Eigen::Matrix3d> seen;                    ///< C̄ − 1
  AtPointsOf<S, Logarithm> logarithm;                     ///< of C̄, where the strain is one
  AtPointsOf<S, material::Strain6> strain;                ///< that the law sees
  AtPointsOf<S, material::Response> response;             ///< of the law
  AtPointsOf<S, material::Stress6> seen_stress;           ///< S̄
  AtPointsOf<S, material::Stress6> stress;                ///< S
  AtPointsOf<S, material::Stress6> inverse;               ///< ℓ, here and below: mean_dilatation only
  AtPointsOf<S, double> square, jacobian, pressure;       ///< s², J, p
  double mean_jacobian = 1, volume = 0, all_pressure = 0; ///< θ, V, Σ w p
};

/// The second derivatives.
template <class S> struct EnergyModuli {
  AtPointsOf<S, material::Tangent6> at;            ///< 𝐂
  AtPointsOf<S, material::Stress6> change, across; ///< t and r
  double along = 0;                                ///< c
};

template <class S> class StrainEnergy {
public:
  using Matrix3 = Eigen::Matrix3d;

  /// `old` and `now`: states of the laws. Views all that it is given.
  StrainEnergy(const CellKind& kind, const PointLaws& laws, const CellGradients<S>& gradients,
               const BetweenInput& input, std::span<double> now)
      : kind_(kind), laws_(laws), gradients_(gradients), input_(input), now_(now),
        free_strains_(kind.strain, laws, input.free_strain) {}

  /// U, S and, if wanted, what the moduli are made of, at C = 1 + `excess`; the states are written over.
  CellResult respond(const AtPointsOf<S, Matrix3>& excess, material::Want want, EnergyState<S>& out) const {
    out.seen = excess;
    if (is_averaged())
      if (const auto result = average(excess, out); !result)
        return result;
    if (const auto result = ask_laws(want, out); !result)
      return result;
    set_stresses(out);
    return {Failure::none, -1, out.stored};
  }

  void set_moduli(const EnergyState<S>& state, EnergyModuli<S>& moduli) const {
    moduli.along = -state.all_pressure;
    for (int q = 0; q < gradients_.points(); ++q) {
      moduli.at[place(q)] = seen_tangent(q, state);
      if (is_averaged())
        set_mean_moduli(q, state, moduli);
    }
  }

  bool is_averaged() const { return kind_.formulation == Formulation::mean_dilatation; }

private:
  using Stress6 = material::Stress6;
  using Tangent6 = material::Tangent6;

  static std::size_t place(int q) { return static_cast<std::size_t>(q); }

  CellResult average(const AtPointsOf<S, Matrix3>& excess, EnergyState<S>& out) const {
    AtPointsOf<S, double> square_change; // J² − 1
    double mean = 0;
    out.volume = 0;
    for (int q = 0; q < gradients_.points(); ++q) {
      const double change = square_change[place(q)] = volume_change(excess[place(q)]);
      if (!(change > -1))
        return {Failure::inverted, q};
      const double root = std::sqrt(1 + change);
      out.jacobian[place(q)] = root;
      out.volume += gradients_.weight(q);
      mean += gradients_.weight(q) * change / (1 + root);
    }
    mean /= out.volume;
    out.mean_jacobian = 1 + mean;
    for (int q = 0; q < gradients_.points(); ++q) {
      const double less_one = std::expm1((2 * std::log1p(mean) - std::log1p(square_change[place(q)])) / 3);
      out.square[place(q)] = 1 + less_one;
      out.seen[place(q)] = out.square[place(q)] * excess[place(q)] + less_one * Matrix3::Identity();
      out.inverse[place(q)] = stress_of((Matrix3::Identity() + excess[place(q)]).inverse());
    }
    return {};
  }

  CellResult ask_laws(material::Want want, EnergyState<S>& out) const {
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

  void set_stresses(EnergyState<S>& out) const {
    out.stored = out.all_pressure = 0;
    for (int q = 0; q < gradients_.points(); ++q) {
      out.stored += gradients_.weight(q) * out.response[place(q)].stored;
      out.stress[place(q)] = out.seen_stress[place(q)] = seen_stress(place(q), out);
      if (is_averaged()) {
        const Matrix3 s = tensor_of(out.seen_stress[place(q)]);
        out.pressure[place(q)] = (s.trace() + s.cwiseProduct(out.seen[place(q)]).sum()) / 3;
        out.all_pressure += gradients_.weight(q) * out.pressure[place(q)];
      }
    }
    if (is_averaged())
      for (std::size_t q = 0; q < place(gradients_.points()); ++q)
        out.stress[q] = out.square[q] * out.seen_stress[q] +
                        (pressure_by_volume(q, out) - out.pressure[q]) * out.inverse[q];
  }

  /// κ J.
  static double pressure_by_volume(std::size_t q, const EnergyState<S>& state) {
    return state.all_pressure / (state.volume * state.mean_jacobian) * state.jacobian[q];
  }

  Stress6 seen_stress(std::size_t q, const EnergyState<S>& state) const {
    const Stress6 stress = free_strains_.shrinking(q) * state.response[q].stress;
    return kind_.strain == StrainKind::logarithmic ? stress_of(second_piola(state.logarithm[q], stress))
                                                   : stress;
  }

  /// 𝐂̄.
  Tangent6 seen_tangent(int q, const EnergyState<S>& state) const {
    auto symmetric = state.response[place(q)];
    const double shrinking = free_strains_.shrinking(place(q));
    symmetric.tangent = (0.5 * shrinking * shrinking) *
                        (state.response[place(q)].tangent + state.response[place(q)].tangent.transpose());
    return kind_.strain == StrainKind::logarithmic
               ? green_lagrange_tangent(state.logarithm[place(q)], symmetric)
               : symmetric.tangent;
  }

  void set_mean_moduli(int q, const EnergyState<S>& state, EnergyModuli<S>& moduli) const {
    const auto p = place(q);
    Tangent6& c = moduli.at[p];
    const double square = state.square[p], by_volume = pressure_by_volume(p, state);
    const Stress6& l = state.inverse[p];
    const material::Strain6 whole = 2 * half_strain_of(Matrix3::Identity() + state.seen[p]);
    const Stress6 y = c * whole;
    const double both = y.dot(whole) / 9 + 2. / 3 * state.pressure[p];
    const Stress6 side = square / 3 * (y + 2 * state.seen_stress[p]);
    const Stress6 half = (both + by_volume) / 2 * l - side;
    c = square * square * c + l * half.transpose() + half * l.transpose();
    add_symmetrizer(2 * (state.pressure[p] - by_volume), tensor_of(l), c);
    moduli.change[p] = state.jacobian[p] / (state.volume * state.mean_jacobian) * l;
    moduli.across[p] = side - both * l;
    moduli.along += gradients_.weight(q) * both;
  }

  /// c += factor · I_C.
  static void add_symmetrizer(double factor, const Matrix3& l, Tangent6& c) {
    constexpr std::array<std::array<int, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
    for (int row = 0; row < 6; ++row)
      for (int column = 0; column < 6; ++column) {
        const auto [i, j] = pairs[static_cast<std::size_t>(row)];
        const auto [m, n] = pairs[static_cast<std::size_t>(column)];
        c(row, column) += 0.5 * factor * (l(i, m) * l(j, n) + l(i, n) * l(j, m));
      }
  }

  const CellKind& kind_;
  const PointLaws& laws_;
  const CellGradients<S>& gradients_;
  const BetweenInput& input_;
  std::span<double> now_;
  FreeStrains free_strains_;
};

} // namespace rubato::element
