// SPDX-License-Identifier: LGPL-3.0-or-later
/// The change of volume of the points is replaced by its projection Π of dilatation_space.hpp, for most cells
/// the mean over the cell (nonlinear.hpp has the sources):
///
///   θ = Π J,   F̄ = s F,   s = (θ/J)^(1/3),   U = Σ w W(F̄)
///   p = P̄:F̄/3,   L = F⁻ᵀ,   κ = Π(p/θ),   P_c = s P̄ − p L + κ J L
///
/// With dθ = Σ_m φ_m τ_m, τ_m = Σ w φ_m J L:dF/V, and y = Ā:F, φ = F:y the tangent is that of moduli
///
///   A_c = s² (Ā − ⅓ (L⊗y + y⊗L) + φ/9 L⊗L) − s/3 (L⊗P̄ + P̄⊗L) + (p/3 + κJ) L⊗L + (p − κJ) Q
///
/// at the points, Q(dF,dF') = tr(F⁻¹dF F⁻¹dF'), plus Σ_m (t_m⊗r_m + r_m⊗t_m) + Σ_mn c_mn t_m⊗t_n with the
/// nodal vectors t_m of τ_m and
///
///   r_m of Σ w φ_m/θ (s²/3 (y − φ/3 L) + s/3 P̄ − p/3 L),   c_mn = Σ w φ_m φ_n/θ² (s² φ/9 − ⅔ p)
///
/// Small strain: tr ε by Π tr ε. It is the same with s = J = θ = 1, F = L = 1 and without the terms of P̄, p
/// and κ in the tangent. Sums are over the volume, 2πR included, the hoop in the trace.
#pragma once

#include "rubato/element/nonlinear/cell_points.hpp"
#include "rubato/element/nonlinear/dilatation_space.hpp"

namespace rubato::element {

class MeanDilatation {
public:
  explicit MeanDilatation(CellPoints& cell);

  /// Sets what the laws see; the first point with J ≤ 0 fails.
  CellResult see() { return cell_.is_small() ? see_small() : see_large(); }

  /// P_c at the points, after the laws have answered, and the tensors of t_m where tangents are wanted.
  void set_conjugates(bool for_tangent);

  /// A_c with the volumes, and what r_m and c_mn are made of.
  void set_moduli(std::span<material::Tangent6> moduli);
  void set_moduli(std::span<Moduli> moduli);

  const DilatationSpace& space() const { return space_; }
  /// The nodal vectors r_m and t_m are the forces of φ_m times these tensors at the points.
  const AtPoints<Eigen::Matrix3d>& across() const { return across_; }
  const AtPoints<Eigen::Matrix3d>& change() const { return change_; }
  Eigen::Matrix4d along() const { return space_.products(along_); } ///< c_mn

private:
  using Matrix3 = Eigen::Matrix3d;

  CellResult see_small();
  CellResult see_large();
  /// H̄ = s H + (s − 1) 1.
  void scale(int q, double scale_less_one, double change);
  double pressure(int q) const;
  void put_small(int q, material::Tangent6& tangent);
  void put_large(int q, Moduli& a);

  CellPoints& cell_;
  DilatationSpace space_;
  AtPoints<double> scale_, jacobian_, pressure_;
  AtPoints<double> theta_, kappa_; ///< θ, κ
  AtPoints<double> along_;         ///< the terms of c_mn without φ
  AtPoints<Matrix3> inverse_;      ///< L
  AtPoints<Matrix3> across_, change_;
};

} // namespace rubato::element
