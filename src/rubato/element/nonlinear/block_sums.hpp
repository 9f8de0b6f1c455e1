// SPDX-License-Identifier: LGPL-3.0-or-later
/// K(ia,jk) = Σ_q Σ_IJ ∂N_i/∂X_I A_aIkJ ∂N_j/∂X_J, volumes in A, for symmetric A: blocks i ≤ j only, two
/// nodes i at once. For each j the products A ∂N_j at all points come first.
#pragma once

#include "rubato/element/nonlinear/cell_gradients.hpp"

#include <utility>

namespace rubato::element {

/// A of small strain at the points: D, in Voigt's order.
template <class S> struct SmallModuli {
  using Product = Eigen::Matrix<double, 6, S::d>;
  static constexpr int row(int a, int gradient_row) {
    const int place = tensor_place(a, gradient_row, S::d);
    return place < 0 ? -1 : voigt_place(place % 3, place / 3);
  }
  std::array<material::Tangent6, static_cast<std::size_t>(S::most_points)> at;
};

/// A of large motions at the points.
template <class S> struct LargeModuli {
  using Product = Eigen::Matrix<double, 9, S::d>;
  static constexpr int row(int a, int gradient_row) { return tensor_place(a, gradient_row, S::d); }
  std::array<Moduli, static_cast<std::size_t>(S::most_points)> at;
};

/// Calls work(integral_constant 0) … work(integral_constant count − 1), unrolled.
template <int count, class Work> constexpr void unrolled(const Work& work) {
  [&]<int... i>(std::integer_sequence<int, i...>) {
    (work(std::integral_constant<int, i>{}), ...);
  }
  (std::make_integer_sequence<int, count>{});
}

/// Blocks (i, j) and (i + 1, j), i even: lane, a + d k.
template <int d> using BlockPair = std::array<Eigen::Array2d, static_cast<std::size_t>(d* d)>;

/// Puts the blocks of `pair` with i ≤ j into K, and their mirror images.
template <int d, class Matrix> void put_blocks(const BlockPair<d>& pair, int i, int j, Matrix& k) {
  for (int lane = 0; lane < 2 && i + lane <= j; ++lane) {
    const int row = d * (i + lane), column = d * j;
    for (int m = 0; m < d * d; ++m) {
      const double value = pair[static_cast<std::size_t>(m)][lane];
      k(row + m % d, column + m / d) = value;
      k(column + m / d, row + m % d) = value;
    }
  }
}

template <class S, class Held> class BlockSums {
public:
  BlockSums(const CellGradients<S>& gradients, const Held& moduli) : gradients_(gradients), moduli_(moduli) {}

  /// Blocks of all nodes (and modes) `first` (even) ≤ i ≤ j < last.
  template <class Matrix> void put(int first, int last, Matrix& k) {
    for (int j = first; j < last; ++j) {
      set_products(j);
      for (int i = first; i <= j; i += 2)
        put_blocks<S::d>(sum(i), i, j, k);
    }
  }

private:
  void set_products(int j) {
    for (int q = 0; q < gradients_.points(); ++q) {
      const auto& a = moduli_.at[static_cast<std::size_t>(q)];
      auto& product = products_[static_cast<std::size_t>(q)];
      unrolled<S::d>([&]<int k>(std::integral_constant<int, k>) {
        constexpr int first = Held::row(k, 0);
        product.col(k) = gradients_.at(q, 0, j) * a.col(first);
        unrolled<S::rows - 1>([&]<int m>(std::integral_constant<int, m>) {
          constexpr int place = Held::row(k, m + 1);
          if constexpr (place >= 0)
            product.col(k) += gradients_.at(q, m + 1, j) * a.col(place);
        });
      });
    }
  }

  BlockPair<S::d> sum(int i) const {
    BlockPair<S::d> total;
    total.fill(Eigen::Array2d::Zero());
    for (int q = 0; q < gradients_.points(); ++q) {
      const auto& product = products_[static_cast<std::size_t>(q)];
      unrolled<S::rows>([&]<int row>(std::integral_constant<int, row>) {
        const Eigen::Array2d g =
            Eigen::Map<const Eigen::Array2d, Eigen::Aligned16>(gradients_.pair(q, row, i));
        unrolled<S::d * S::d>([&]<int m>(std::integral_constant<int, m>) {
          constexpr int place = Held::row(m % S::d, row);
          if constexpr (place >= 0)
            total[static_cast<std::size_t>(m)] += g * product(place, m / S::d);
        });
      });
    }
    return total;
  }

  const CellGradients<S>& gradients_;
  const Held& moduli_;
  std::array<typename Held::Product, static_cast<std::size_t>(S::most_points)> products_;
};

} // namespace rubato::element
