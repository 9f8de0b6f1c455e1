// SPDX-License-Identifier: LGPL-3.0-or-later
/// A cell of mean_dilatation, with its bubble where it has one (bubble_cell.hpp): forces on the bubble
/// vanish.
///
/// Its displacement α is solved in every evaluation, by Newton's method from its value at the start of the
/// step, and eliminated from the tangent: K − K_uα K_αα⁻¹ K_αu.
#pragma once

#include "rubato/element/nonlinear/block_sums.hpp"
#include "rubato/element/nonlinear/mean_dilatation.hpp"
#include "rubato/element/nonlinear/mode_factor.hpp"

namespace rubato::element {

class MeanCell {
public:
  /// `gradients` are those of the cell, which get the bubble.
  MeanCell(CellPoints& cell, CellGradients& gradients, bool wants_tangent);

  /// Solves α, stores it in the cell's state and sets P_c at the points.
  CellResult solve();

  /// The tangent on the nodes.
  void put_tangent(const MatrixView& k);

private:
  static constexpr int most_dofs = 3 * most_nodes_of_cell;
  static constexpr int most_with_bubble = 3 * (20 + 1);
  using Forces = std::array<double, static_cast<std::size_t>(most_dofs)>;

  int d() const { return cell_.gradients.components(); }
  int node_dofs() const { return cell_.gradients.dofs(); }
  int all_dofs() const { return node_dofs() + modes_; }
  MatrixView whole() { return {whole_.data(), all_dofs()}; }

  CellResult respond();
  void add_bubble(std::size_t q);
  void set_residual();
  bool is_solved() const;
  CellResult improved();
  void put_stiffness(int first_node, const MatrixView& k);
  void add_dilatation(int first_dof, const MatrixView& k) const;
  Forces forces_of(const AtPoints<Eigen::Matrix3d>& tensors, int m) const;

  CellPoints& cell_;
  MeanDilatation mean_;
  int modes_;
  bool wants_tangent_;
  AtPoints<Eigen::Matrix3d> of_nodes_; ///< ∂u/∂X
  std::array<double, static_cast<std::size_t>(most_with_bubble* most_with_bubble)> whole_;
  ModeValues unknowns_, residual_;
  double scale_ = 0, noise_ = 0;
  bool is_stalled_ = false;
};

} // namespace rubato::element
