// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/bubble_cell.hpp"

#include "rubato/element/nonlinear/small_square.hpp"

#include <algorithm>

namespace rubato::element {
namespace {

using Eigen::Vector3d;

struct Bubble {
  double value;
  Vector3d gradient; ///< ∂M/∂ξ
};

/// 1 − x².
double arch(double x) {
  return 1 - x * x;
}

/// Product of arches in the first `d` coordinates.
Bubble bubble_at(const Vector3d& xi, int d) {
  Bubble bubble{1, Vector3d::Zero()};
  for (int a = 0; a < d; ++a) {
    bubble.value *= arch(xi[a]);
    bubble.gradient[a] = -2 * xi[a];
    for (int b = 0; b < d; ++b)
      bubble.gradient[a] *= b == a ? 1 : arch(xi[b]);
  }
  return bubble;
}

/// ∂X/∂ξ at a point; in the plane zz is 1.
Square<3> jacobian_at(const ReferenceGradients& reference, std::span<const Vector3d> points, int d, int q) {
  Square<3> j{0, 0, 0, 0, 0, 0, 0, 0, d == 3 ? 0. : 1.};
  for (int b = 0; b < d; ++b)
    for (int a = 0; a < d; ++a)
      for (int i = 0; i < reference.nodes; ++i)
        j[place(a + 3 * b)] += points[place(i)][a] * reference.gradients(i, q * d + b);
  return j;
}

} // namespace

bool has_bubble(CellType type) {
  return type == CellType::quad8 || type == CellType::hexa20;
}

void put_bubble(CellType type, std::span<const Vector3d> points, CellGradients& gradients) {
  const auto& reference = reference_gradients(type);
  const int d = gradients.components(), nodes = gradients.nodes();
  for (int q = 0; q < gradients.points(); ++q) {
    const auto bubble = bubble_at(reference.xi.col(q), d);
    Square<3> inverse;
    invert(jacobian_at(reference, points, d, q), inverse);
    for (int row = 0; row < gradients.rows(); ++row) {
      double* const out = gradients.row(q, row) + nodes;
      std::fill(out, gradients.row(q, row) + gradients.stride(), 0.);
      if (row == d)
        *out = bubble.value / gradients.radius(q);
      else
        for (int m = 0; m < d; ++m)
          *out += bubble.gradient[m] * inverse[place(m + 3 * row)];
    }
  }
}

} // namespace rubato::element
