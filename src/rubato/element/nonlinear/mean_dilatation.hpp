// SPDX-License-Identifier: LGPL-3.0-or-later
/// The change of volume of the points is replaced by that of the cell (nonlinear.hpp has the sources):
///
///   θ = Σ w J/V,   F̄ = s F,   s = (θ/J)^(1/3),   U = Σ w W(F̄)
///   p = P̄:F̄/3,   L = F⁻ᵀ,   κ = Σ w p/(V θ),   P_c = s P̄ − p L + κ J L
///
/// With the nodal vector t of dθ/θ = Σ w J L:dF/(V θ) and y = Ā:F, φ = F:y the tangent is that of moduli
///
///   A_c = s² (Ā − ⅓ (L⊗y + y⊗L) + φ/9 L⊗L) − s/3 (L⊗P̄ + P̄⊗L) + (p/3 + κJ) L⊗L + (p − κJ) Q
///
/// at the points, Q(dF,dF') = tr(F⁻¹dF F⁻¹dF'), plus t⊗r + r⊗t + c t⊗t with
///
///   r of Σ w (s²/3 (y − φ/3 L) + s/3 P̄ − p/3 L),   c = Σ w (s² φ/9 + p/3) − Σ w p
///
/// Small strain: tr ε by its mean over the cell. It is the same with s = J = θ = 1, F = L = 1 and without the
/// terms of P̄, p and κ in the tangent. The mean is over the volume, 2πR included, the hoop in the trace.
#pragma once

#include "rubato/element/nonlinear/cell_points.hpp"

namespace rubato::element {

class MeanDilatation {
public:
  explicit MeanDilatation(CellPoints& cell);

  /// Sets what the laws see; the first point with J ≤ 0 fails.
  CellResult see() { return cell_.is_small() ? see_small() : see_large(); }

  /// P_c at the points, after the laws have answered, and the tensors of t where tangents are wanted.
  void set_conjugates(bool for_tangent);

  /// A_c with the volumes, and c and the tensors of r.
  void set_moduli(std::span<material::Tangent6> moduli);
  void set_moduli(std::span<Moduli> moduli);

  /// The nodal vectors r and t are the forces of these tensors at the points.
  std::span<const Eigen::Matrix3d> across() const { return of_points(across_); }
  std::span<const Eigen::Matrix3d> change() const { return of_points(change_); }
  double along() const { return along_; } ///< c

private:
  using Matrix3 = Eigen::Matrix3d;

  std::span<const Matrix3> of_points(const AtPoints<Matrix3>& tensors) const {
    return std::span(tensors).first(cell_.at.seen.size());
  }
  CellResult see_small();
  CellResult see_large();
  /// H̄ = s H + (s − 1) 1.
  void scale(int q, double scale_less_one, double change);
  double pressure(int q) const;
  void put_small(int q, material::Tangent6& tangent);
  void put_large(int q, Moduli& a);

  CellPoints& cell_;
  double volume_ = 0;
  double theta_ = 1;
  double pressure_sum_ = 0;
  double along_ = 0;
  AtPoints<double> scale_, jacobian_, pressure_;
  AtPoints<Matrix3> inverse_; ///< L
  AtPoints<Matrix3> across_, change_;
};

} // namespace rubato::element
