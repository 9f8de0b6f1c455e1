// SPDX-License-Identifier: LGPL-3.0-or-later
/// Energy of what the one point of a reduced cell does not see, and its forces (D. P. Flanagan, T.
/// Belytschko, Int. J. Numer. Meth. Eng. 17 (1981) 679–706, section 5):
///
///   γ_α = φ_α − Σ_I (φ_α·X_I) B_I,   q_α = Σ_i γ_αi u_i,   φ_α = ξη or ηζ, ζξ, ξη, ξηζ at the nodes
///   U = κ G V e²/(1 + r),   e² = b d/n Σ |q_α|² (+ 2/V Σ w (u_r/R − mean)²),   r = √(1 + e²/e_y²)
///
/// V volume, B_I the mean gradients, d components, n nodes. q vanishes for all displacements a + H X, so that
/// rigid motions and constant strains of any size take nothing, and |q_α| does not change where the cell is
/// turned afterwards: U depends on nothing but the present place, and is the energy of its forces.
///
/// b is the harmonic mean of the principal values of Σ_i B_iI B_iJ. Flanagan and Belytschko have the
/// arithmetic one, which the shortest side of a cell alone decides: long cells were too stiff in bending. Of
/// cubes both are the same.
///
/// e is a shear strain. Up to e_y, that at which the law yields, U = ½ κ G V e², G the law's shear modulus at
/// first; then it resists with κ of the yield stress: a body that flows is not held by its elastic stiffness.
///
/// Axisymmetric cells: one hoop strain sees no ring that rolls; the term in brackets, over the points of
/// cell::stiffness_rule, does. It vanishes where u_r = c R.
#pragma once

#include "rubato/element/nonlinear/block_sums.hpp"
#include "rubato/element/nonlinear/cell_gradients.hpp"

namespace rubato::element {

/// κ. Cubes bend with 0.45 of their true stiffness from one layer on (ν = 0), squares with 0.3.
constexpr double hourglass_coefficient = 0.1;

class HourglassForces {
public:
  HourglassForces(const CellKind& kind, const CellGradients& gradients,
                  std::span<const Eigen::Vector3d> points, const NodalValues& u);

  double energy() const { return stiffness_ * strain_squared_ / (1 + root_); }
  NodalValues forces() const;

  /// K += ∂forces/∂u.
  void add_tangent(const MatrixView& k) const;

private:
  static constexpr std::size_t most_nodes = 8;
  static constexpr std::size_t most_patterns = 4;

  template <int d> void set_shapes(const CellGradients& gradients, std::span<const Eigen::Vector3d> points);
  template <int d> void set_half_gradient(const NodalValues& u);
  void add_rolling(const CellGradients& gradients, const CellKind& kind,
                   std::span<const Eigen::Vector3d> points, const NodalValues& u);
  template <int d> NodalValues forces_of() const;
  template <int d> void add_tangent_of(const MatrixView& k) const;
  template <int d> void subtract_square(double factor, const MatrixView& k) const;

  int d_, stride_;
  bool rolls_; ///< axisymmetric
  double limit_;
  double stiffness_;                                                  ///< κ G V
  double scale_ = 0;                                                  ///< b d/n
  alignas(16) std::array<double, most_nodes * most_patterns> shapes_; ///< γ_α of node i at i + nodes · α
  /// Axisymmetric cells: √(2w/V) (N_i/R − its mean) of point q at i + nodes · q.
  alignas(16) std::array<double, 16> rolling_;
  NodalValues half_gradient_; ///< ½ ∂e²/∂u
  double strain_squared_ = 0; ///< e²
  double root_ = 1;           ///< r
};

} // namespace rubato::element
