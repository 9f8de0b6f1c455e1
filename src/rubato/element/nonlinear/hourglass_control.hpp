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

#include "rubato/element/nonlinear.hpp"
#include "rubato/element/nonlinear/cell_gradients.hpp"

#include <Eigen/LU>

#include <cmath>

namespace rubato::element {

/// κ. Cubes bend with 0.45 of their true stiffness from one layer on (ν = 0), squares with 0.3.
constexpr double hourglass_coefficient = 0.1;

template <class S> class HourglassForces {
  static constexpr int d = S::d;
  static constexpr int patterns = d == 2 ? 1 : 4;
  using Nodal = typename S::Nodal;

public:
  HourglassForces(const CellKind& kind, const CellGradients<S>& gradients, const CellInput& input)
      : limit_(kind.hourglass.limit),
        stiffness_(hourglass_coefficient * kind.hourglass.modulus * gradients.weight(0)) {
    const Nodal u = gradients.by_component(input.displacement);
    const auto mean = gradients.gradients(0).template leftCols<d>();
    set_shapes(gradients.coordinates(input.points), mean);
    set_scale(mean);
    half_gradient_ = scale_ * shapes_.lazyProduct(shapes_.transpose().lazyProduct(u));
    if constexpr (S::rows > d)
      add_rolling(gradients, kind, input.points, u);
    strain_squared_ = half_gradient_.cwiseProduct(u).sum();
    root_ = limit_ > 0 ? std::sqrt(1 + strain_squared_ / (limit_ * limit_)) : 1;
  }

  double energy() const { return stiffness_ * strain_squared_ / (1 + root_); }
  Nodal forces() const { return stiffness_ / root_ * half_gradient_; }

  /// K += ∂forces/∂u.
  template <class Matrix> void add_tangent(Matrix& k) const {
    const double secant = stiffness_ / root_;
    const double yielding = limit_ > 0 ? secant / (limit_ * limit_ * root_ * root_) : 0;
    for (int j = 0; j < S::nodes; ++j)
      for (int i = 0; i < S::nodes; ++i) {
        const double alike = secant * scale_ * shapes_.row(i).dot(shapes_.row(j));
        for (int a = 0; a < d; ++a)
          k(i * d + a, j * d + a) += alike;
        if constexpr (S::rows > d)
          k(i * d, j * d) += secant * rolling_.row(i).dot(rolling_.row(j));
      }
    if (yielding > 0)
      subtract_square(yielding, k);
  }

private:
  /// γ_α.
  template <class Mean> void set_shapes(const Nodal& x, const Mean& mean) {
    const auto& all = waves<d>();
    if constexpr (d == 2)
      shapes_ = all.col(2);
    else
      shapes_ << all.col(2), all.template rightCols<3>();
    const Eigen::Matrix<double, d, patterns> moments = x.transpose().lazyProduct(shapes_);
    shapes_ -= mean.lazyProduct(moments);
  }

  template <class Mean> void set_scale(const Mean& mean) {
    const Eigen::Matrix<double, d, d> squares = mean.transpose().lazyProduct(mean);
    const Eigen::Matrix<double, d, d> inverse = squares.inverse();
    const double harmonic = d / inverse.trace();
    scale_ = harmonic * d / S::nodes;
  }

  /// A column a point: √(2w/V) (N_i/R − its mean).
  void add_rolling(const CellGradients<S>& gradients, const CellKind& kind,
                   std::span<const Eigen::Vector3d> points, const Nodal& u) {
    const CellGradients<Shape<d, S::rows, S::nodes, S::nodes>> at(reference_gradients(kind.type), points,
                                                                  kind.section);
    const auto mean = gradients.gradients(0).col(d);
    for (int q = 0; q < S::nodes; ++q)
      rolling_.col(q) = std::sqrt(2 * at.weight(q) / gradients.weight(0)) * (at.gradients(q).col(d) - mean);
    half_gradient_.col(0) += rolling_.lazyProduct(rolling_.transpose().lazyProduct(u.col(0)));
  }

  /// K −= factor g gᵀ, g the half gradient.
  template <class Matrix> void subtract_square(double factor, Matrix& k) const {
    const auto dof = [&](int i) { return half_gradient_(i / d, i % d); };
    for (int j = 0; j < S::nodes * d; ++j)
      for (int i = 0; i < S::nodes * d; ++i)
        k(i, j) -= factor * (dof(i) * dof(j));
  }

  double limit_;
  double stiffness_; ///< κ G V
  double scale_ = 0; ///< b d/n
  Eigen::Matrix<double, S::nodes, patterns> shapes_;
  Eigen::Matrix<double, S::nodes, S::rows == d ? 0 : S::nodes> rolling_;
  Nodal half_gradient_;       ///< ½ ∂e²/∂u
  double strain_squared_ = 0; ///< e²
  double root_ = 1;           ///< r
};

} // namespace rubato::element
