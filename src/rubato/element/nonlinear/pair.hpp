// SPDX-License-Identifier: LGPL-3.0-or-later
/// Two numbers in one SSE2 register, with the operators of the compiler: Eigen's arrays of two give the same
/// instructions, but each expression of them takes the compiler a hundred times as long.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>

namespace rubato::element {

using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;

/// Loads two numbers from an address that is a multiple of 16.
inline Pair pair_at(const double* values) {
  Pair pair;
  std::memcpy(&pair, std::assume_aligned<sizeof(Pair)>(values), sizeof(Pair));
  return pair;
}

/// Stores two numbers at an address that is a multiple of 16.
inline void put_pair(Pair pair, double* values) {
  std::memcpy(std::assume_aligned<sizeof(Pair)>(values), &pair, sizeof(Pair));
}

inline Pair twice(double value) {
  return Pair{value, value};
}

inline double sum_of(Pair pair) {
  return pair[0] + pair[1];
}

template <class Work, int... i>
[[gnu::always_inline]] constexpr void unroll(const Work& work, std::integer_sequence<int, i...>) {
  (work(std::integral_constant<int, i>{}), ...);
}

/// Calls work(integral_constant 0) … work(integral_constant count − 1): sums in arrays of such indices are
/// held in registers, those of loops often are not.
template <int count, class Work> [[gnu::always_inline]] constexpr void unrolled(const Work& work) {
  unroll(work, std::make_integer_sequence<int, count>{});
}

/// Σ_i x_i y_i of a number of pairs known at compile time, the sums of both halves first: terms of nodes
/// opposite to each other cancel to zero where a sum one after the other leaves rounding.
template <int pairs> [[gnu::always_inline]] inline Pair sum_of_products(const double* x, const double* y) {
  if constexpr (pairs == 1) {
    return pair_at(x) * pair_at(y);
  } else {
    constexpr int half = pairs / 2;
    return sum_of_products<half>(x, y) + sum_of_products<pairs - half>(x + 2 * half, y + 2 * half);
  }
}

/// Σ_i x_ai y_bi at a + components b, for two numbers i at once. Component a of x is at a · x_stride, the
/// columns of y accordingly; addresses and strides are even. `known`: the number of pairs, or 0. Inlined
/// always: callers know most of the numbers.
template <int components, int columns, int known>
[[gnu::always_inline]] inline std::array<double, static_cast<std::size_t>(components* columns)>
products(const double* x, int x_stride, const double* y, int y_stride, int pairs) {
  std::array<double, static_cast<std::size_t>(components * columns)> out;
  if constexpr (known > 0) {
    unrolled<components * columns>([&](auto m) {
      out[m] = sum_of(sum_of_products<known>(x + m % components * x_stride, y + m / components * y_stride));
    });
  } else {
    std::array<Pair, static_cast<std::size_t>(components * columns)> sums{};
    for (int p = 0; p < pairs; ++p)
      unrolled<columns>([&](auto b) {
        const Pair of_y = pair_at(y + b * y_stride + 2 * p);
        unrolled<components>(
            [&](auto a) { sums[a + components * b] += pair_at(x + a * x_stride + 2 * p) * of_y; });
      });
    unrolled<components * columns>([&](auto m) { out[m] = sum_of(sums[m]); });
  }
  return out;
}

} // namespace rubato::element
