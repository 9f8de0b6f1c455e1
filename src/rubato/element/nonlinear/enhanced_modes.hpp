// SPDX-License-Identifier: LGPL-3.0-or-later
/// Gradients of a cell's own displacement modes, M_m = 1 − ξ_m²:
///
///   ∂M_m/∂X = ∂M_m/∂ξ J₀⁻¹ j₀/j,   j = det ∂X/∂ξ, ₀ at the centre
///
/// times R₀/R in axisymmetric cells, which get no hoop strain by them.
#pragma once

#include "rubato/element/nonlinear/cell_gradients.hpp"

#include <Eigen/LU>

#include <array>
#include <cstddef>

namespace rubato::element {

/// A step of Newton's method for the modes, halved while a law fails or it leads to nothing better. False: it
/// has stalled.
template <class Unknowns, class Respond, class IsBetter>
bool go_halving(const Unknowns& step, Unknowns& unknowns, CellResult& result, const Respond& respond,
                const IsBetter& is_better) {
  constexpr int most_halvings = 6;
  const Unknowns start = unknowns;
  double part = 1;
  for (int i = 0; i <= most_halvings; ++i, part /= 2) {
    unknowns = start + part * step;
    result = respond();
    if (result && is_better())
      return true;
  }
  return false;
}

/// j₀/j (R₀/R) at the points.
template <class S> using ModeRatios = std::array<double, static_cast<std::size_t>(S::most_points)>;

template <class S>
void put_modes_at(int q, const Eigen::Vector3d& xi, const Eigen::Matrix<double, S::d, S::d>& inverse,
                  CellGradients<S>& gradients) {
  for (int m = 0; m < S::d; ++m) {
    for (int row = 0; row < S::d; ++row)
      *gradients.pair(q, row, S::most_nodes + m) = -2 * xi[m] * inverse(m, row);
    if constexpr (S::rows > S::d)
      *gradients.pair(q, S::d, S::most_nodes + m) = 0;
  }
}

/// Puts the modes behind the nodes.
template <class S>
ModeRatios<S> put_modes(const ReferenceGradients& reference, std::span<const Eigen::Vector3d> points,
                        CellGradients<S>& gradients) {
  const auto x = gradients.coordinates(points);
  const Eigen::Matrix<double, S::d, S::d> j = x.transpose() * reference.centre;
  const Eigen::Matrix<double, S::d, S::d> inverse = j.inverse();
  const double radius = x.col(0).dot(reference.centre_values);
  ModeRatios<S> ratios;
  for (int q = 0; q < gradients.points(); ++q) {
    const double by_radius = S::rows > S::d ? radius / gradients.radius(q) : 1;
    const double ratio = j.determinant() / gradients.jacobian(q) * by_radius;
    put_modes_at<S>(q, reference.xi.col(q), ratio * inverse, gradients);
    ratios[static_cast<std::size_t>(q)] = ratio;
  }
  return ratios;
}

} // namespace rubato::element
