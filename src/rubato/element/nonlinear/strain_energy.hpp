// SPDX-License-Identifier: LGPL-3.0-or-later
/// U of a cell as a function of C = FᵀF at its points. With E = ½(C − 1) everywhere
///
///   dU = Σ w S:dE       d²U = Σ w dE:𝐂:dE' + Σ_m (τ_m ρ'_m + ρ_m τ'_m) + Σ_mn c_mn τ_m τ'_n
///   τ_m = Σ w φ_m t:dE,  ρ_m = Σ w φ_m r:dE
///
/// full: S and 𝐂 of the law at the point, no more. mean_dilatation, with φ_m and the projection Π of
/// dilatation_space.hpp, S̄ and 𝐂̄ of the law at C̄ = s² C, J = √det C, θ = Π J, s = (θ/J)^(1/3), ℓ = C⁻¹,
/// p = S̄:C̄/3, κ = Π(p/θ), y = 𝐂̄:C̄, φ = C̄:y:
///
///   S = s² S̄ − p ℓ + κ J ℓ      t = J ℓ/V      c_mn = Σ w φ_m φ_n/θ² (φ/9 − p/3)
///   𝐂 = s⁴ 𝐂̄ − s²/3 (ℓ⊗(y + 2 S̄) + (y + 2 S̄)⊗ℓ) + (φ/9 + ⅔ p + κ J) ℓ⊗ℓ + 2 (p − κ J) I_C
///   r = (s²/3 (y + 2 S̄) − (φ/9 + ⅔ p) ℓ)/θ,   I_C = ½ (ℓ_ik ℓ_jl + ℓ_il ℓ_jk)
///
/// C − 1 is what everything is formed from.
#pragma once

#include "rubato/element/energy_momentum.hpp"
#include "rubato/element/nonlinear/cell_gradients.hpp"
#include "rubato/element/nonlinear/dilatation_space.hpp"
#include "rubato/element/nonlinear/free_strains.hpp"
#include "rubato/element/nonlinear/logarithm.hpp"

#include <cstddef>

namespace rubato::element {

/// U and its derivatives at one C.
struct EnergyState {
  double stored = 0;                           ///< U
  AtPoints<Eigen::Matrix3d> seen;              ///< C̄ − 1
  AtPoints<Logarithm> logarithm;               ///< of C̄, where the strain is one
  AtPoints<material::Strain6> strain;          ///< that the law sees
  AtPoints<material::Response> response;       ///< of the law
  AtPoints<material::Stress6> seen_stress;     ///< S̄
  AtPoints<material::Stress6> stress;          ///< S
  AtPoints<material::Stress6> inverse;         ///< ℓ, here and below: mean_dilatation only
  AtPoints<double> square, jacobian, pressure; ///< s², J, p
  AtPoints<double> theta, kappa;               ///< θ, κ
};

/// The second derivatives.
struct EnergyModuli {
  AtPoints<material::Tangent6> at;            ///< 𝐂
  AtPoints<material::Stress6> change, across; ///< t and r
  Eigen::Matrix4d along;                      ///< c_mn
};

class StrainEnergy {
public:
  using Matrix3 = Eigen::Matrix3d;

  /// `old` and `now`: states of the laws. Views all that it is given.
  StrainEnergy(const CellKind& kind, const PointLaws& laws, const CellGradients& gradients,
               const BetweenInput& input, std::span<double> now)
      : kind_(kind), laws_(laws), gradients_(gradients), input_(input), now_(now),
        free_strains_(kind.strain, laws, input.free_strain), space_(kind.type, input.points, gradients) {}

  /// U, S and, if wanted, what the moduli are made of, at C = 1 + `excess`; the states are written over.
  CellResult respond(std::span<const Matrix3> excess, material::Want want, EnergyState& out) const;

  void set_moduli(const EnergyState& state, EnergyModuli& moduli) const;

  bool is_averaged() const { return kind_.formulation == Formulation::mean_dilatation; }
  /// Numbers m of mean_dilatation; none of other cells.
  int dilatations() const { return is_averaged() ? space_.size() : 0; }
  const DilatationSpace& space() const { return space_; }

private:
  using Stress6 = material::Stress6;
  using Tangent6 = material::Tangent6;

  CellResult average(std::span<const Matrix3> excess, EnergyState& out) const;
  CellResult ask_laws(material::Want want, EnergyState& out) const;
  void set_stresses(EnergyState& out) const;
  Stress6 seen_stress(std::size_t q, const EnergyState& state) const;
  /// 𝐂̄.
  Tangent6 seen_tangent(std::size_t q, const EnergyState& state) const;
  /// Returns the term of c_mn without φ.
  double set_mean_moduli(int q, const EnergyState& state, EnergyModuli& moduli) const;

  const CellKind& kind_;
  const PointLaws& laws_;
  const CellGradients& gradients_;
  const BetweenInput& input_;
  std::span<double> now_;
  FreeStrains free_strains_;
  DilatationSpace space_;
};

} // namespace rubato::element
