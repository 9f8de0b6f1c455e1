// SPDX-License-Identifier: LGPL-3.0-or-later
/// The points of a cell over a step: H = ∂u/∂X at both ends, and what {x} and [x] of it are needed.
///
/// Displacements are taken from those of the first node, where that is a rigid motion: their rounding must
/// not grow with the way that the cell has gone. Modes of the cell's own stand behind its nodes.
#pragma once

#include "rubato/element/energy_momentum.hpp"
#include "rubato/element/nonlinear/cell_gradients.hpp"
#include "rubato/element/nonlinear/mode_factor.hpp"

namespace rubato::element {

class BetweenMotion {
public:
  /// `modes`: how many modes there are, d or 0; their values are 0.
  BetweenMotion(const CellKind& kind, const BetweenInput& input, int modes);

  const CellGradients& gradients() const { return gradients_; }
  int points() const { return gradients_.points(); }
  int nodes() const { return nodes_; } ///< and modes

  /// Values of the modes, mode · d + component.
  void set_modes_before(const ModeValues& values) { put(values, before_); }
  void set_modes_after(const ModeValues& values) { put(values, after_); }

  /// Sets what follows; the first point with J ≤ 0 fails.
  CellResult move();

  /// `sum` += volume · tensor_aI ∂N_i/∂X_I of one point.
  void add_force(int q, const Eigen::Matrix3d& tensor, NodalValues& sum) const;
  /// Number of a node or mode.
  double value(const NodalValues& nodal, int i, int a) const {
    return nodal.component(a, gradients_.stride())[i];
  }

  AtPoints<Eigen::Matrix3d> before;      ///< H at the start
  AtPoints<Eigen::Matrix3d> after;       ///< H at the end
  AtPoints<Eigen::Matrix3d> middle;      ///< {H}
  AtPoints<Eigen::Matrix3d> half_change; ///< ½[C] = sym {F}ᵀ[F]
  AtPoints<double> reach;                ///< Σ |∂N/∂X||u|: rounding of H by that of one number

private:
  NodalValues relative(std::span<const double> values) const;
  void put(const ModeValues& values, NodalValues& u) const;
  Eigen::Matrix3d gradient_of(int q, const NodalValues& u) const;
  double reach_of(int q) const;
  bool move(int q);

  CellGradients gradients_;
  int nodes_;
  NodalValues before_, after_, change_;
};

} // namespace rubato::element
