// SPDX-License-Identifier: LGPL-3.0-or-later
/// The points of a cell over a step: H = ∂u/∂X at both ends, and what {x} and [x] of it are needed.
///
/// Displacements are taken from those of the first node, where that is a rigid motion: their rounding must
/// not grow with the way that the cell has gone. Modes of the cell's own stand behind its nodes.
#pragma once

#include "rubato/element/energy_momentum.hpp"
#include "rubato/element/nonlinear/enhanced_modes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace rubato::element {

template <class S> class BetweenMotion {
public:
  static constexpr int d = S::d;
  static constexpr int most_nodes = S::most_nodes + (S::may_be_enhanced ? d : 0);
  template <class T> using AtPoints = std::array<T, static_cast<std::size_t>(S::most_points)>;
  /// Nodal values, a row a node or mode.
  using Nodal = Eigen::Matrix<double, Eigen::Dynamic, d, Eigen::ColMajor, most_nodes, d>;

  /// `modes`: how many modes there are, d or 0; their values are 0.
  BetweenMotion(const CellKind& kind, const BetweenInput& input, int modes)
      : gradients_(reference_gradients(kind.type), input.points, kind.section),
        nodes_(gradients_.nodes() + modes) {
    if constexpr (S::may_be_enhanced)
      if (modes > 0)
        put_modes(reference_gradients(kind.type), input.points, gradients_);
    before_ = relative(input.before);
    after_ = relative(input.after);
  }

  const CellGradients<S>& gradients() const { return gradients_; }
  int points() const { return gradients_.points(); }
  int nodes() const { return nodes_; } ///< and modes

  /// Values of the modes, mode · d + component.
  void set_modes_before(const double* values) { put(values, before_); }
  void set_modes_after(const double* values) { put(values, after_); }

  /// Sets what follows; the first point with J ≤ 0 fails.
  CellResult move() {
    for (int q = 0; q < points(); ++q)
      if (!move(q))
        return {Failure::inverted, q};
    return {};
  }

  AtPoints<Eigen::Matrix3d> before;      ///< H at the start
  AtPoints<Eigen::Matrix3d> after;       ///< H at the end
  AtPoints<Eigen::Matrix3d> middle;      ///< {H}
  AtPoints<Eigen::Matrix3d> half_change; ///< ½[C] = sym {F}ᵀ[F]
  AtPoints<double> reach;                ///< Σ |∂N/∂X||u|: rounding of H by that of one number

  /// Nodes × rows of one point.
  auto gradients(int q) const {
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, S::rows, Eigen::ColMajor, most_nodes, S::rows>;
    return Eigen::Map<const Matrix, Eigen::Aligned16, Eigen::OuterStride<S::stride>>(gradients_.pair(q, 0, 0),
                                                                                     nodes_, S::rows);
  }

  Nodal no_force() const { return Nodal::Zero(nodes_, d); }

  /// `sum` += volume · tensor_aI ∂N_i/∂X_I of one point.
  void add_force(int q, const Eigen::Matrix3d& tensor, Nodal& sum) const {
    const typename S::Gradient weighted = gradients_.weight(q) * part<S>(tensor);
    sum.noalias() += gradients(q) * weighted.transpose();
  }

private:
  using Matrix3 = Eigen::Matrix3d;

  Nodal relative(std::span<const double> values) const {
    Nodal u = no_force();
    u.topRows(gradients_.nodes()) = gradients_.by_component(values);
    for (int a = S::rows > d ? 1 : 0; a < d; ++a) // axisymmetric: a radial motion is none of a rigid body
      u.col(a).head(gradients_.nodes()).array() -= values[static_cast<std::size_t>(a)];
    return u;
  }

  void put(const double* values, Nodal& u) const {
    for (int m = 0; m < nodes_ - gradients_.nodes(); ++m)
      for (int a = 0; a < d; ++a)
        u(gradients_.nodes() + m, a) = values[m * d + a];
  }

  Matrix3 gradient_of(int q, const Nodal& u) const { return whole<S>(u.transpose() * gradients(q)); }

  bool move(int q) {
    const auto p = static_cast<std::size_t>(q);
    before[p] = gradient_of(q, before_);
    after[p] = gradient_of(q, after_);
    middle[p] = 0.5 * (before[p] + after[p]);
    const Matrix3 change = gradient_of(q, after_ - before_);
    const Matrix3 turned = change + middle[p].transpose() * change;
    half_change[p] = 0.5 * (turned + turned.transpose());
    const Nodal size = before_.cwiseAbs().cwiseMax(after_.cwiseAbs());
    reach[p] = (size.transpose() * gradients(q).cwiseAbs()).norm();
    return volume_change(before[p]) > -1 && volume_change(after[p]) > -1;
  }

  CellGradients<S> gradients_;
  int nodes_;
  Nodal before_, after_;
};

} // namespace rubato::element
