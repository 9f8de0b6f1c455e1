// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/enhanced_modes.hpp"

#include "rubato/element/nonlinear/small_square.hpp"

namespace rubato::element {
namespace {

/// ∂X/∂ξ at the centre; in the plane zz is 1.
Square<3> jacobian_of_centre(const ReferenceGradients& reference, std::span<const Eigen::Vector3d> points,
                             int d) {
  Square<3> j{0, 0, 0, 0, 0, 0, 0, 0, 1};
  if (d == 3)
    j[8] = 0;
  for (int b = 0; b < d; ++b)
    for (int a = 0; a < d; ++a)
      for (int i = 0; i < reference.nodes; ++i)
        j[static_cast<std::size_t>(a + 3 * b)] +=
            points[static_cast<std::size_t>(i)][a] * reference.centre(i, b);
  return j;
}

double radius_of_centre(const ReferenceGradients& reference, std::span<const Eigen::Vector3d> points) {
  double radius = 0;
  for (int i = 0; i < reference.nodes; ++i)
    radius += points[static_cast<std::size_t>(i)][0] * reference.centre_values[i];
  return radius;
}

} // namespace

ModeRatios put_modes(const ReferenceGradients& reference, std::span<const Eigen::Vector3d> points,
                     CellGradients& gradients) {
  const int d = gradients.components(), rows = gradients.rows(), nodes = gradients.nodes();
  Square<3> inverse;
  const double determinant = invert(jacobian_of_centre(reference, points, d), inverse);
  const double radius = rows > d ? radius_of_centre(reference, points) : 1;
  ModeRatios ratios;
  for (int q = 0; q < gradients.points(); ++q) {
    const double by_radius = rows > d ? radius / gradients.radius(q) : 1;
    const double ratio = determinant / gradients.jacobian(q) * by_radius;
    ratios[static_cast<std::size_t>(q)] = ratio;
    for (int row = 0; row < rows; ++row) {
      double* const modes = gradients.row(q, row) + nodes;
      for (int m = 0; m < gradients.stride() - nodes; ++m) {
        const bool is_mode = m < d && row < d;
        modes[m] =
            is_mode ? -2 * reference.xi(m, q) * (ratio * inverse[static_cast<std::size_t>(m + 3 * row)]) : 0;
      }
    }
  }
  return ratios;
}

} // namespace rubato::element
