// SPDX-License-Identifier: LGPL-3.0-or-later
/// Functions φ_m of the undeformed place on which mean_dilatation projects the change of volume of a cell:
///
///   Π x = Σ_m φ_m Σ_q w φ_m x / V,   Σ_q w φ_m φ_n = V δ_mn,   φ_0 = 1
///
/// TRIA7, QUAD9, HEXA27 and the cells with a bubble have the linear functions, all other cells the constant
/// alone. docs/theory has the inf-sup numbers of each (D. Chapelle, K. J. Bathe, Comput. Struct. 47 (1993)
/// 537–545). The functions are linear in X and not in ξ, as only these keep the order of accuracy on
/// distorted cells (D. Boffi, L. Gastaldi, Int. J. Numer. Meth. Fluids 39 (2002) 1001–1011).
#pragma once

#include "rubato/element/nonlinear/cell_gradients.hpp"

namespace rubato::element {

constexpr int most_dilatations = 4;

class DilatationSpace {
public:
  /// `points` of the undeformed cell, `gradients` of all its points.
  DilatationSpace(CellType type, std::span<const Eigen::Vector3d> points, const CellGradients& gradients);

  int size() const { return size_; }
  double volume() const { return volume_; } ///< V
  double at(int m, int q) const { return functions_[place(m)][place(q)]; }

  /// Π x at the points.
  AtPoints<double> projected(const AtPoints<double>& values) const;

  /// Σ_q x φ_m φ_n, without volumes.
  Eigen::Matrix4d products(const AtPoints<double>& values) const;

  /// φ_m x at the points.
  template <class T> AtPoints<T> weighted(int m, const AtPoints<T>& values) const {
    AtPoints<T> out;
    for (int q = 0; q < gradients_.points(); ++q)
      out[place(q)] = at(m, q) * values[place(q)];
    return out;
  }

private:
  void set_linear(CellType type, std::span<const Eigen::Vector3d> points);
  /// Σ_q w φ_m x.
  double sum(int m, const AtPoints<double>& values) const;

  const CellGradients& gradients_;
  int size_ = 1;
  double volume_ = 0;
  std::array<AtPoints<double>, static_cast<std::size_t>(most_dilatations)> functions_;
};

} // namespace rubato::element
