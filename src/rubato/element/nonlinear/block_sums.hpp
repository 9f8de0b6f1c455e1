// SPDX-License-Identifier: LGPL-3.0-or-later
/// K(ia,jk) = Σ_q Σ_IJ ∂N_i/∂X_I A_aIkJ ∂N_j/∂X_J, volumes in A, for symmetric A: blocks i ≤ j only, two
/// nodes i at once. For each j the products A ∂N_j at all points come first.
#pragma once

#include "rubato/element/nonlinear/cell_gradients.hpp"
#include "rubato/element/nonlinear/kinematics.hpp"
#include "rubato/element/nonlinear/pair.hpp"

#include <array>
#include <cstddef>

namespace rubato::element {

/// A matrix in memory, column after column.
struct MatrixView {
  double* values;
  int leading; ///< distance of columns

  double* column(int j) const { return values + static_cast<std::ptrdiff_t>(j) * leading; }
  double& operator()(int i, int j) const { return column(j)[i]; }
};

/// Puts the blocks of all nodes (and modes) `first` (even) ≤ i ≤ j < last and their mirror images. A of small
/// strain at the points is D, in Voigt's order.
void put_block_sums(const CellGradients& gradients, std::span<const material::Tangent6> moduli, int first,
                    int last, const MatrixView& k);
/// A of large motions at the points.
void put_block_sums(const CellGradients& gradients, std::span<const Moduli> moduli, int first, int last,
                    const MatrixView& k);

/// Blocks (i, j) and (i + 1, j), i even: lane, a + d k.
template <int d> using BlockPair = std::array<Pair, static_cast<std::size_t>(d* d)>;

/// Puts the blocks of `pair` with i ≤ j into K, and their mirror images.
template <int d>
[[gnu::always_inline]] inline void put_blocks(const BlockPair<d>& pair, int i, int j, const MatrixView& k) {
  const auto leading = static_cast<std::ptrdiff_t>(k.leading);
  double* const block = k.column(d * j) + d * i;
  double* const mirrored = k.column(d * i) + d * j;
  unrolled<d * d>([&](auto m) {
    constexpr int a = m % d, b = m / d;
    block[b * leading + a] = mirrored[a * leading + b] = pair[m][0];
  });
  if (i < j)
    unrolled<d * d>([&](auto m) {
      constexpr int a = m % d, b = m / d;
      block[b * leading + d + a] = mirrored[(d + a) * leading + b] = pair[m][1];
    });
}

} // namespace rubato::element
