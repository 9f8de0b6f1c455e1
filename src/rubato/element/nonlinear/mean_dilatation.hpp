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

#include <cmath>

namespace rubato::element {

/// r, c and t.
template <class S> struct MeanTerms {
  typename S::Nodal across; ///< r
  typename S::Nodal change; ///< t
  double along = 0;         ///< c
};

template <class S> class MeanDilatation {
public:
  explicit MeanDilatation(CellPoints<S>& cell)
      : cell_(cell), change_(cell.gradients.no_force()), volume_(whole_volume()) {}

  /// Sets what the laws see; the first point with J ≤ 0 fails.
  CellResult see() { return cell_.is_small() ? see_small() : see_large(); }

  /// P_c at the points, after the laws have answered, and t where tangents are wanted.
  void set_conjugates(bool for_tangent) {
    pressure_sum_ = 0;
    for (int q = 0; q < cell_.count(); ++q)
      pressure_sum_ += cell_.gradients.weight(q) * (pressure_[place(q)] = pressure(q));
    const double by_volume = pressure_sum_ / (volume_ * theta_);
    for (int q = 0; q < cell_.count(); ++q) {
      const auto p = place(q);
      cell_.conjugate[p] =
          scale_[p] * cell_.piola[p] + (by_volume * jacobian_[p] - pressure_[p]) * inverse_[p];
      if (for_tangent)
        cell_.gradients.add_force(q, jacobian_[p] / (volume_ * theta_) * inverse_[p], change_);
    }
  }

  MeanTerms<S> set_moduli(SmallModuli<S>& moduli) const {
    MeanTerms<S> terms{cell_.gradients.no_force(), change_};
    for (int q = 0; q < cell_.count(); ++q)
      put_small(q, moduli.at[place(q)], terms);
    return terms;
  }

  MeanTerms<S> set_moduli(LargeModuli<S>& moduli) const {
    MeanTerms<S> terms{cell_.gradients.no_force(), change_, -pressure_sum_};
    for (int q = 0; q < cell_.count(); ++q) {
      put_large(q, moduli.at[place(q)], terms);
      moduli.at[place(q)] *= cell_.gradients.weight(q);
    }
    return terms;
  }

private:
  template <class T> using AtPoints = typename CellPoints<S>::template AtPoints<T>;
  using Matrix3 = Eigen::Matrix3d;

  static std::size_t place(int q) { return static_cast<std::size_t>(q); }

  double whole_volume() const {
    double volume = 0;
    for (int q = 0; q < cell_.count(); ++q)
      volume += cell_.gradients.weight(q);
    return volume;
  }

  CellResult see_small() {
    double mean = 0;
    for (int q = 0; q < cell_.count(); ++q)
      mean += cell_.gradients.weight(q) / volume_ * cell_.gradient[place(q)].trace();
    for (int q = 0; q < cell_.count(); ++q) {
      const Matrix3& h = cell_.gradient[place(q)];
      scale_[place(q)] = jacobian_[place(q)] = 1;
      inverse_[place(q)].setIdentity();
      cell_.seen[place(q)].h = h + (mean - h.trace()) / 3 * Matrix3::Identity();
    }
    return {};
  }

  CellResult see_large() {
    AtPoints<double> change;
    double mean = 0;
    for (int q = 0; q < cell_.count(); ++q) {
      change[place(q)] = volume_change(cell_.gradient[place(q)]);
      if (!(change[place(q)] > -1))
        return {Failure::inverted, q};
      mean += cell_.gradients.weight(q) / volume_ * change[place(q)];
    }
    theta_ = 1 + mean;
    for (int q = 0; q < cell_.count(); ++q)
      scale(q, std::expm1((std::log1p(mean) - std::log1p(change[place(q)])) / 3), change[place(q)]);
    return {};
  }

  /// H̄ = s H + (s − 1) 1.
  void scale(int q, double scale_less_one, double change) {
    const Matrix3& h = cell_.gradient[place(q)];
    scale_[place(q)] = 1 + scale_less_one;
    jacobian_[place(q)] = 1 + change;
    inverse_[place(q)] = (Matrix3::Identity() + h).inverse().transpose();
    cell_.seen[place(q)].h = scale_[place(q)] * h + scale_less_one * Matrix3::Identity();
  }

  double pressure(int q) const {
    const Matrix3& p = cell_.piola[place(q)];
    if (cell_.is_small())
      return p.trace() / 3;
    return (p.trace() + p.cwiseProduct(cell_.seen[place(q)].h).sum()) / 3;
  }

  void put_small(int q, material::Tangent6& tangent, MeanTerms<S>& terms) const {
    tangent = cell_.weighted_tangent(q);
    material::Strain6 unit;
    unit << 1, 1, 1, 0, 0, 0;
    const material::Stress6 y = tangent.leftCols<3>().rowwise().sum();
    const double phi = y.head<3>().sum();
    const material::Stress6 half = y / 3 - phi / 18 * unit;
    tangent -= unit * half.transpose() + half * unit.transpose();
    terms.along += phi / 9;
    const double weight = cell_.gradients.weight(q);
    cell_.gradients.add_force(q, tensor_of((y - phi / 3 * unit) / (3 * weight)), terms.across);
  }

  void put_large(int q, Moduli& a, MeanTerms<S>& terms) const {
    const auto p = place(q);
    cell_.put_moduli(q, a);
    const double s = scale_[p], s2 = s * s;
    const double by_volume = pressure_sum_ / (volume_ * theta_) * jacobian_[p];
    const Matrix3 f = Matrix3::Identity() + cell_.gradient[p];
    const Vector9 l = as_vector(inverse_[p]), first = as_vector(cell_.piola[p]);
    const Vector9 y = a * as_vector(f);
    const double phi = y.dot(as_vector(f));
    const Vector9 half = -s2 / 3 * y - s / 3 * first + (s2 * phi / 9 + pressure_[p] / 3 + by_volume) / 2 * l;
    a = s2 * a + l * half.transpose() + half * l.transpose();
    add_turned_product(inverse_[p], pressure_[p] - by_volume, a);
    const Vector9 across = s2 / 3 * (y - phi / 3 * l) + s / 3 * first - pressure_[p] / 3 * l;
    cell_.gradients.add_force(q, Eigen::Map<const Matrix3>(across.data()), terms.across);
    terms.along += cell_.gradients.weight(q) * (s2 * phi / 9 + pressure_[p] / 3);
  }

  /// a += factor · Q, Q_iKkJ = L_iJ L_kK.
  static void add_turned_product(const Matrix3& l, double factor, Moduli& a) {
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i)
          for (int n = 0; n < 3; ++n)
            a(i + 3 * n, k + 3 * j) += factor * l(i, j) * l(k, n);
  }

  CellPoints<S>& cell_;
  typename S::Nodal change_;
  double volume_;
  double theta_ = 1;
  double pressure_sum_ = 0;
  AtPoints<double> scale_, jacobian_, pressure_;
  AtPoints<Matrix3> inverse_; ///< L
};

} // namespace rubato::element
