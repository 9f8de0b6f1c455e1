// SPDX-License-Identifier: LGPL-3.0-or-later
/// Strain from displacement modes of the cell's own (nonlinear.hpp has the sources):
///
///   H̃ = Σ α_m ⊗ ∂M_m/∂ξ J₀⁻¹ j₀/j,   M_m = 1 − ξ_m²,   j = det ∂X/∂ξ, ₀ at the centre
///
/// times R₀/R in axisymmetric cells; HEXA8 in small strain has β_k ξ_k ξ_l j₀/j 1 (kl = 12, 23, 31) too (J.
/// C. Simo, F. Armero, R. L. Taylor, CMAME 110 (1993) 359–386). Modes m stand behind the nodes: their ∂M_m/∂X
/// are gradients of further nodes with the displacements α_m. All unknowns are solved in every evaluation, by
/// Newton's method from their values at the start of the step, and eliminated from the tangent:
/// K − K_uα K_αα⁻¹ K_αu.
#pragma once

#include "rubato/element/nonlinear/cell_points.hpp"
#include "rubato/element/nonlinear/enhanced_modes.hpp"

#include <cmath>
#include <limits>

namespace rubato::element {

template <class S, class Held> class EnhancedCell {
  static constexpr int d = S::d;
  static constexpr int all_nodes = S::most_nodes + d;
  static constexpr int node_dofs = S::most_nodes * d;
  static constexpr int gradient_modes = d * d;
  static constexpr bool has_volume_modes = d == 3 && std::is_same_v<Held, SmallModuli<S>>;
  static constexpr int modes = gradient_modes + (has_volume_modes ? 3 : 0);

public:
  explicit EnhancedCell(CellPoints<S>& cell) : cell_(cell), of_nodes_(cell.gradient) {
    set_modes();
    const auto old = cell.input.old.subspan(cell.law_states(), modes);
    unknowns_ = Eigen::Map<const Unknowns>(old.data());
  }

  /// Solves the unknowns and stores them in the cell's state.
  CellResult solve() {
    auto result = respond();
    for (int i = 0; i < cell_.input.modes.most_iterations && result && !is_solved(); ++i)
      result = improved();
    if (result && !is_solved())
      result = {Failure::mode_iteration};
    result.mode_force = scale_;
    Eigen::Map<Unknowns>(cell_.output.now.subspan(cell_.law_states(), modes).data()) = unknowns_;
    return result;
  }

  /// The condensed tangent.
  template <class Matrix> void put_tangent(Matrix& k) {
    cell_.set_moduli(moduli_);
    BlockSums<S, Held>(cell_.gradients, moduli_).put(0, all_nodes, whole_);
    if constexpr (has_volume_modes)
      put_volume_modes(0);
    const auto coupling = whole_.template topRightCorner<node_dofs, modes>();
    const Eigen::PartialPivLU<ModeMatrix> factor(whole_.template bottomRightCorner<modes, modes>());
    const Eigen::Matrix<double, modes, node_dofs> solved = factor.solve(coupling.transpose());
    for (int j = 0; j < node_dofs; ++j)
      for (int i = 0; i <= j; ++i)
        k(i, j) = k(j, i) = whole_(i, j) - coupling.row(i).dot(solved.col(j));
  }

private:
  using Unknowns = Eigen::Matrix<double, modes, 1>;
  using ModeMatrix = Eigen::Matrix<double, modes, modes>;
  using Whole = Eigen::Matrix<double, node_dofs + modes, node_dofs + modes>;
  template <class T> using AtPoints = typename CellPoints<S>::template AtPoints<T>;

  /// What rounding leaves of a force by the largest stress that its strains could make.
  static constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  /// Where no step makes forces on modes smaller, so much of rounding is an end.
  static constexpr double stalled_rounding = 1e3;

  static std::size_t place(int q) { return static_cast<std::size_t>(q); }

  void set_modes() {
    const auto& reference = reference_gradients(cell_.kind.type);
    const auto ratios = put_modes(reference, cell_.input.points, cell_.gradients);
    for (int q = 0; q < cell_.count(); ++q) {
      const Eigen::Vector3d xi = reference.xi.col(q);
      volume_modes_[place(q)] =
          ratios[place(q)] * Eigen::Vector3d(xi[0] * xi[1], xi[1] * xi[2], xi[2] * xi[0]);
    }
  }

  double mode_gradient(int q, int row, int m) const { return cell_.gradients.at(q, row, S::most_nodes + m); }

  Eigen::Matrix3d strain_of_modes(int q) const {
    Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
    for (int m = 0; m < d; ++m)
      for (int row = 0; row < d; ++row)
        h.col(row).template head<d>() += mode_gradient(q, row, m) * unknowns_.template segment<d>(m * d);
    if constexpr (has_volume_modes)
      h.diagonal().array() += volume_modes_[place(q)].dot(unknowns_.template tail<3>());
    return h;
  }

  /// The laws' answer to the present unknowns.
  CellResult respond() {
    for (int q = 0; q < cell_.count(); ++q)
      cell_.seen[place(q)].h = cell_.gradient[place(q)] = of_nodes_[place(q)] + strain_of_modes(q);
    const auto result = cell_.respond(material::Want::tangent);
    if (result)
      set_residual();
    return result;
  }

  /// Forces on the modes, what they are compared with, and what rounding leaves of them.
  void set_residual() {
    residual_.setZero();
    Unknowns size = Unknowns::Zero(), noise = Unknowns::Zero();
    for (int q = 0; q < cell_.count(); ++q) {
      const Unknowns mode_size = add_residual(q);
      const auto& response = cell_.response[place(q)];
      const double stress = cell_.piola[place(q)].norm();
      size += stress * mode_size;
      noise += (response.tangent.cwiseAbs().maxCoeff() * of_nodes_[place(q)].norm() + stress) * mode_size;
    }
    scale_ = size.maxCoeff();
    noise_ = rounding * noise.maxCoeff();
  }

  /// Volume times the size of ∂H/∂α of each mode.
  Unknowns add_residual(int q) {
    Unknowns size;
    const Eigen::Matrix3d weighted = cell_.gradients.weight(q) * cell_.piola[place(q)];
    for (int m = 0; m < d; ++m) {
      Eigen::Matrix<double, d, 1> g;
      for (int row = 0; row < d; ++row)
        g[row] = mode_gradient(q, row, m);
      residual_.template segment<d>(m * d) += weighted.template topLeftCorner<d, d>() * g;
      size.template segment<d>(m * d).setConstant(cell_.gradients.weight(q) * g.norm());
    }
    if constexpr (has_volume_modes) {
      residual_.template tail<3>() += weighted.trace() * volume_modes_[place(q)];
      size.template tail<3>() = cell_.gradients.weight(q) * volume_modes_[place(q)].cwiseAbs();
    }
    return size;
  }

  bool is_solved() const {
    const auto& modes_wanted = cell_.input.modes;
    const double scale = std::max(scale_, modes_wanted.force);
    const double floor = is_stalled_ ? stalled_rounding * noise_ : noise_;
    return residual_.cwiseAbs().maxCoeff() <= std::max(modes_wanted.relative * scale, floor);
  }

  /// One step of Newton's method, halved while a law fails or the forces, measured by K_αα⁻¹, grow.
  CellResult improved() {
    set_mode_matrix();
    const Eigen::PartialPivLU<ModeMatrix> factor(whole_.template bottomRightCorner<modes, modes>());
    const auto level = [&] { return std::abs(residual_.dot(factor.solve(residual_))); };
    const Unknowns step = -factor.solve(residual_);
    const double before = level();
    if (!std::isfinite(before))
      return {Failure::not_finite};
    CellResult result;
    const auto is_better = [&] { return is_solved() || level() < before; };
    if (!go_halving(
            step, unknowns_, result, [&] { return respond(); }, is_better))
      is_stalled_ = true;
    return result;
  }

  void set_mode_matrix() {
    cell_.set_moduli(moduli_);
    BlockSums<S, Held>(cell_.gradients, moduli_).put(S::most_nodes, all_nodes, whole_);
    if constexpr (has_volume_modes)
      put_volume_modes(S::most_nodes);
  }

  /// Columns and rows of β, for nodes and modes from `first` on.
  void put_volume_modes(int first) {
    constexpr int start = node_dofs + gradient_modes;
    whole_.template middleCols<3>(start).setZero();
    for (int q = 0; q < cell_.count(); ++q) {
      const material::Stress6 y = moduli_.at[place(q)].template leftCols<3>().rowwise().sum();
      const Eigen::Matrix3d tensor = tensor_of(y);
      for (int i = first; i < all_nodes; ++i) {
        const Eigen::Vector3d g(cell_.gradients.at(q, 0, i), cell_.gradients.at(q, 1, i),
                                cell_.gradients.at(q, 2, i));
        whole_.template block<3, 3>(3 * i, start) += tensor * g * volume_modes_[place(q)].transpose();
      }
      whole_.template block<3, 3>(start, start) +=
          tensor.trace() * volume_modes_[place(q)] * volume_modes_[place(q)].transpose();
    }
    whole_.template block<3, start>(start, 0) = whole_.template block<start, 3>(0, start).transpose();
  }

  CellPoints<S>& cell_;
  AtPoints<Eigen::Matrix3d> of_nodes_; ///< ∂u/∂X
  AtPoints<Eigen::Vector3d> volume_modes_;
  Held moduli_;
  Whole whole_;
  Unknowns unknowns_, residual_;
  double scale_ = 0, noise_ = 0;
  bool is_stalled_ = false;
};

} // namespace rubato::element
