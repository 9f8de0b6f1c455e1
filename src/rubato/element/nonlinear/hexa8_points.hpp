// SPDX-License-Identifier: LGPL-3.0-or-later
/// The 2×2×2 points of HEXA8, all at once.
///
/// A trilinear function has at them four values of each derivative ∂/∂ξ_k, which does not change along ξ_k:
/// differences along the edges, mixed by the shape functions across.
#pragma once

#include "rubato/element/nonlinear/pair.hpp"

#include <array>
#include <cstddef>
#include <numbers>

namespace rubato::element::hexa8 {

inline constexpr std::size_t corner_count = 8; ///< and points

/// A number at every point, ξ running first, then η: two points in each pair.
using Lanes = std::array<Pair, corner_count / 2>;
/// A tensor at every point: row, column.
using Tensors = std::array<std::array<Lanes, 3>, 3>;

inline double at(const Lanes& lanes, std::size_t q) {
  return lanes[q / 2][q % 2];
}

/// Corners by ξ + 2 η + 4 ζ, as points: the nodes of a cell in this order.
inline constexpr std::array<std::size_t, corner_count> node_of_corner{0, 1, 3, 2, 4, 5, 7, 6};

/// Of direction k the corners where ξ_k begins, in their order.
inline constexpr std::array<std::array<std::size_t, 4>, 3> starts{{{0, 2, 4, 6}, {0, 1, 4, 5}, {0, 1, 2, 3}}};
/// From there to where it ends.
constexpr std::size_t across(std::size_t k) {
  return std::size_t{1} << k;
}

/// ½(1 ± 1/√3): shape functions along an axis at the points of Gauss.
inline constexpr double near_shape = 0.5 + 0.5 * std::numbers::inv_sqrt3;
inline constexpr double far_shape = 0.5 - 0.5 * std::numbers::inv_sqrt3;

template <std::size_t n> void mix(std::array<Pair, n>& at_start, std::array<Pair, n>& at_end) {
  for (std::size_t i = 0; i < n; ++i) {
    const Pair start = near_shape * at_start[i] + far_shape * at_end[i];
    at_end[i] = far_shape * at_start[i] + near_shape * at_end[i];
    at_start[i] = start;
  }
}

/// From the corners of a square to its points, or forces at points to its corners: the matrix is symmetric.
template <std::size_t n> void mix(std::array<std::array<Pair, n>, 4>& values) {
  mix(values[0], values[1]);
  mix(values[2], values[3]);
  mix(values[0], values[2]);
  mix(values[1], values[3]);
}

/// For each direction, which of its four values two points have that lie side by side along ξ.
using PairOfFour = std::array<std::size_t, 2>;
inline constexpr std::array<std::array<PairOfFour, 4>, 3> values_of_pair{
    {{{{0, 0}, {1, 1}, {2, 2}, {3, 3}}},
     {{{0, 1}, {0, 1}, {2, 3}, {2, 3}}},
     {{{0, 1}, {2, 3}, {0, 1}, {2, 3}}}}};

/// ∂/∂ξ_k of each of the 2 n components c of the corners: into derivatives_of(c)[k]. Two numbers are written
/// at once because they are read so: a read waits for two writes that it needs both of.
template <std::size_t n, class DerivativesOf>
void derive(const std::array<std::array<Pair, n>, corner_count>& corners,
            const DerivativesOf& derivatives_of) {
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<std::array<Pair, n>, 4> along;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t m = 0; m < n; ++m)
        along[i][m] = 0.5 * (corners[starts[k][i] + across(k)][m] - corners[starts[k][i]][m]);
    mix(along);
    for (std::size_t c = 0; c < 2 * n; ++c)
      for (std::size_t pair = 0; pair < 4; ++pair) {
        const auto [first, second] = values_of_pair[k][pair];
        derivatives_of(c)[k][pair] = Pair{along[first][c / 2][c % 2], along[second][c / 2][c % 2]};
      }
  }
}

/// det J, and its derivatives by J: det J · J⁻ᵀ.
inline Lanes set_cofactors(const Tensors& j, Tensors& cofactors) {
  Lanes determinant;
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a1 = (a + 1) % 3, a2 = (a + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      for (std::size_t p = 0; p < 4; ++p)
        cofactors[a][k][p] = j[a1][k1][p] * j[a2][k2][p] - j[a1][k2][p] * j[a2][k1][p];
    }
  for (std::size_t p = 0; p < 4; ++p)
    determinant[p] =
        j[0][0][p] * cofactors[0][0][p] + j[1][0][p] * cofactors[1][0][p] + j[2][0][p] * cofactors[2][0][p];
  return determinant;
}

} // namespace rubato::element::hexa8
