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

#include "rubato/element/nonlinear/block_sums.hpp"
#include "rubato/element/nonlinear/cell_points.hpp"
#include "rubato/element/nonlinear/mode_factor.hpp"

namespace rubato::element {

class EnhancedCell {
public:
  /// `gradients` are those of the cell, which get the modes.
  EnhancedCell(CellPoints& cell, CellGradients& gradients);

  /// Solves the unknowns and stores them in the cell's state.
  CellResult solve();

  /// The condensed tangent.
  void put_tangent(const MatrixView& k);

private:
  static constexpr int most_unknowns = 24 + most_modes_of_cell;
  static constexpr std::size_t most_points = 8;

  std::size_t points() const { return cell_.at.seen.size(); }
  int nodes() const { return cell_.gradients.nodes(); }
  int node_dofs() const { return cell_.gradients.dofs(); }
  int d() const { return cell_.gradients.components(); }
  int all_nodes() const { return nodes() + d(); }
  /// HEXA8, small strain.
  bool has_volume_modes() const { return d() == 3 && cell_.is_small(); }
  MatrixView whole() { return {whole_.data(), node_dofs() + modes_}; }

  template <int d> Eigen::Matrix3d strain_of_modes(int q) const;
  CellResult respond();
  void set_residual();
  template <int d> ModeValues add_residual(int q);
  bool is_solved() const;
  CellResult improved();
  void set_blocks(int first);
  void put_volume_modes(int first, std::span<const material::Tangent6> moduli);

  CellPoints& cell_;
  int modes_;
  std::array<Eigen::Matrix3d, most_points> of_nodes_; ///< ∂u/∂X
  std::array<Eigen::Vector3d, most_points> volume_modes_;
  std::array<double, static_cast<std::size_t>(most_unknowns* most_unknowns)> whole_;
  ModeValues unknowns_, residual_;
  double scale_ = 0, noise_ = 0;
  bool is_stalled_ = false;
};

} // namespace rubato::element
