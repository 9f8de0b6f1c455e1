// SPDX-License-Identifier: LGPL-3.0-or-later
/// The 2×2×2 points of HEXA8, all at once.
///
/// A trilinear function has at them four values of each derivative ∂/∂ξ_k, which does not change along ξ_k:
/// differences along the edges, mixed by the shape functions across.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <numbers>

namespace rubato::element::hexa8 {

inline constexpr std::size_t corner_count = 8; ///< and points

/// A number at every point, ξ running first, then η.
using Lanes = Eigen::Array<double, corner_count, 1>;
/// A tensor at every point: row, column.
using Tensors = std::array<std::array<Lanes, 3>, 3>;

/// Corners by ξ + 2 η + 4 ζ, as points: the nodes of a cell in this order.
inline constexpr std::array<std::size_t, corner_count> node_of_corner{0, 1, 3, 2, 4, 5, 7, 6};

/// Two numbers are written at once where they are read so: a read waits for two writes that it needs both of.
using Pair = Eigen::Array2d;
template <class Vector> auto pair_of(Vector& vector, std::size_t i) {
  return vector.array().template segment<2>(static_cast<Eigen::Index>(2 * i));
}

/// Of direction k the corners where ξ_k begins, in their order.
inline constexpr std::array<std::array<std::size_t, 4>, 3> starts{{{0, 2, 4, 6}, {0, 1, 4, 5}, {0, 1, 2, 3}}};
/// From there to where it ends.
constexpr std::size_t across(std::size_t k) {
  return std::size_t{1} << k;
}

/// ½(1 ± 1/√3): shape functions along an axis at the points of Gauss.
inline constexpr double near_shape = 0.5 + 0.5 * std::numbers::inv_sqrt3;
inline constexpr double far_shape = 0.5 - 0.5 * std::numbers::inv_sqrt3;

template <class Values> void mix(Values& at_start, Values& at_end) {
  const Values start = near_shape * at_start + far_shape * at_end;
  at_end = far_shape * at_start + near_shape * at_end;
  at_start = start;
}

/// From the corners of a square to its points, or forces at points to its corners: the matrix is symmetric.
template <class Values> void mix(std::array<Values, 4>& values) {
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

/// ∂/∂ξ_k of each component c of the corners: into derivatives_of(c)[k].
template <class Corner, class DerivativesOf>
void derive(const std::array<Corner, corner_count>& corners, const DerivativesOf& derivatives_of) {
  constexpr std::size_t components = Corner::RowsAtCompileTime;
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<Corner, 4> along;
    for (std::size_t i = 0; i < 4; ++i)
      along[i] = 0.5 * (corners[starts[k][i] + across(k)] - corners[starts[k][i]]);
    mix(along);
    for (std::size_t c = 0; c < components; ++c)
      for (std::size_t pair = 0; pair < 4; ++pair) {
        const auto [first, second] = values_of_pair[k][pair];
        const auto row = static_cast<Eigen::Index>(c);
        pair_of(derivatives_of(c)[k], pair) = Pair(along[first][row], along[second][row]);
      }
  }
}

/// det J, and its derivatives by J: det J · J⁻ᵀ.
inline Lanes set_cofactors(const Tensors& j, Tensors& cofactors) {
  for (std::size_t a = 0; a < 3; ++a)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a1 = (a + 1) % 3, a2 = (a + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      cofactors[a][k] = j[a1][k1] * j[a2][k2] - j[a1][k2] * j[a2][k1];
    }
  return j[0][0] * cofactors[0][0] + j[1][0] * cofactors[1][0] + j[2][0] * cofactors[2][0];
}

} // namespace rubato::element::hexa8
