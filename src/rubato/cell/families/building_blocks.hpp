// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the families share: functions of one variable, of a triangle, and the step from linear to quadratic.
///
/// Every quadratic cell without inner nodes is built alike (Zienkiewicz and Taylor, The Finite Element
/// Method, vol. 1, "serendipity" functions): the function of a mid-edge node is the edge's bubble times
/// linear functions, and a corner's is its linear function minus half of those of the mid-edge nodes beside
/// it.
#pragma once

#include "rubato/cell/topology.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace rubato::cell {

/// Place of a node in a product of lines: 0 stands for −1, 1 for +1, 2 for 0.
using LineIndex = std::uint8_t;
inline constexpr std::array<double, 3> line_nodes{-1., 1., 0.};

/// Functions of one variable on [−1,1] with their first two derivatives.
template <int Count> struct LineFunctions {
  std::array<double, Count> value;
  std::array<double, Count> slope;
  std::array<double, Count> curvature;
};

/// Lagrange functions of the nodes −1, +1.
inline LineFunctions<2> linear_line(double x) {
  return {{0.5 * (1 - x), 0.5 * (1 + x)}, {-0.5, 0.5}, {0., 0.}};
}

/// Lagrange functions of the nodes −1, +1, 0.
inline LineFunctions<3> quadratic_line(double x) {
  return {{0.5 * x * (x - 1), 0.5 * x * (x + 1), 1 - x * x}, {x - 0.5, x + 0.5, -2 * x}, {1., 1., -2.}};
}

/// The two linear functions, and the bubble 1 − x².
inline LineFunctions<3> hierarchic_line(double x) {
  return {{0.5 * (1 - x), 0.5 * (1 + x), 1 - x * x}, {-0.5, 0.5, -2 * x}, {0., 0., -2.}};
}

/// Area coordinates L0 = 1−ξ−η, L1 = ξ, L2 = η, and the edge bubbles 4 L0 L1, 4 L1 L2, 4 L2 L0.
struct TriangleFunctions {
  std::array<double, 6> value;
  std::array<std::array<double, 2>, 6> slope;
};

inline TriangleFunctions hierarchic_triangle(double x, double y) {
  const double z = 1 - x - y;
  return {{z, x, y, 4 * z * x, 4 * x * y, 4 * y * z},
          {{{-1., -1.}, {1., 0.}, {0., 1.}, {4 * (z - x), -4 * x}, {4 * y, 4 * x}, {-4 * y, 4 * (z - y)}}}};
}

/// Turns linear corner functions followed by edge bubbles into nodal functions: `rows` holds `Stride` numbers
/// a node (values, gradients or Hessians alike).
template <int Stride> void subtract_half_of_mid_edges(CellType type, std::span<double> rows) {
  const auto& cell = cell::topology(type);
  auto mid_edge = static_cast<std::size_t>(cell.corner_count);
  for (const auto& edge : cell.edges) {
    for (const std::size_t corner : edge)
      for (std::size_t k = 0; k < Stride; ++k)
        rows[corner * Stride + k] -= 0.5 * rows[mid_edge * Stride + k];
    ++mid_edge;
  }
}

/// The same of the values of a face, each of whose edges runs from a corner to the next one: contact asks for
/// them often.
template <std::size_t Corners> void subtract_half_of_face_edges(std::span<double> values) {
  for (std::size_t edge = 0; edge < Corners; ++edge) {
    values[edge] -= 0.5 * values[Corners + edge];
    values[(edge + 1) % Corners] -= 0.5 * values[Corners + edge];
  }
}

} // namespace rubato::cell
