// SPDX-License-Identifier: LGPL-3.0-or-later
/// The gradients of HEXA8 at its 2×2×2 points, two by two, for two cells at once (formulas and source:
/// hexa8_stiffness.cpp).
#pragma once

#include "rubato/element/nonlinear/pair.hpp"

#include <Eigen/Core>

#include <array>
#include <bit>
#include <cstddef>
#include <numbers>
#include <span>

namespace rubato::element::hexa8_modes {

/// The nodes of both cells.
using PointsOfTwo = std::array<std::span<const Eigen::Vector3d>, 2>;
/// A number of each of them.
using Twin = Pair;
using FourTwins = std::array<Twin, 4>;
using EightTwins = std::array<Twin, 8>;
/// Of a tensor T: T_xx, T_yy, T_zz, then xy, yz, zx of T + Tᵀ.
using SymmetricTwins = std::array<Twin, 6>;
/// These, and xy, yz, zx of T − Tᵀ.
using TensorTwins = std::array<Twin, 9>;
/// A vector for each direction of ξ: direction, component, point.
using DirectionTwins = std::array<std::array<EightTwins, 3>, 3>;

inline constexpr std::array<std::size_t, 8> node_of_sign{6, 7, 5, 4, 2, 3, 1, 0};

constexpr std::size_t next_axis(std::size_t k) {
  return (k + 1) % 3;
}
constexpr std::size_t only(std::size_t k) {
  return std::size_t{1} << k;
}
constexpr bool is_odd(std::size_t set) {
  return std::popcount(set) % 2 == 1;
}
/// The other two bits beside each other.
constexpr std::size_t without_axis(std::size_t set, std::size_t k) {
  return (set & (only(k) - 1)) | ((set >> (k + 1)) << k);
}
constexpr std::size_t with_axis_free(std::size_t two_bits, std::size_t k) {
  return (two_bits & (only(k) - 1)) | ((two_bits >> k) << (k + 1));
}

/// a and its powers.
inline constexpr double gauss = std::numbers::inv_sqrt3;
inline constexpr std::array<double, 5> gauss_power{1, gauss, gauss* gauss, gauss* gauss* gauss,
                                                   gauss* gauss* gauss* gauss};

inline void add_and_subtract(Twin& x, Twin& y) {
  const Twin sum = x + y;
  y = x - y;
  x = sum;
}

inline void transform(FourTwins& v) {
  add_and_subtract(v[0], v[1]);
  add_and_subtract(v[2], v[3]);
  add_and_subtract(v[0], v[2]);
  add_and_subtract(v[1], v[3]);
}

/// Bits 1 and 2, where bit 0 is done.
inline void transform_rest(EightTwins& v) {
  add_and_subtract(v[0], v[2]);
  add_and_subtract(v[1], v[3]);
  add_and_subtract(v[4], v[6]);
  add_and_subtract(v[5], v[7]);
  add_and_subtract(v[0], v[4]);
  add_and_subtract(v[1], v[5]);
  add_and_subtract(v[2], v[6]);
  add_and_subtract(v[3], v[7]);
}

inline void transform(EightTwins& v) {
  add_and_subtract(v[0], v[1]);
  add_and_subtract(v[2], v[3]);
  add_and_subtract(v[4], v[5]);
  add_and_subtract(v[6], v[7]);
  transform_rest(v);
}

/// ∂x/∂ξ_k, which does not change along ξ_k: direction, which of its four values, component.
using JacobianTwins = std::array<std::array<std::array<Twin, 3>, 4>, 3>;

inline JacobianTwins jacobians(const PointsOfTwo& cells) {
  JacobianTwins j;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto row = static_cast<Eigen::Index>(a);
    EightTwins x;
    for (std::size_t i = 0; i < 8; ++i)
      x[i] = Twin{cells[0][node_of_sign[i]][row], cells[1][node_of_sign[i]][row]};
    transform(x);
    for (std::size_t m = 1; m < 8; ++m)
      x[m] *= gauss_power[static_cast<std::size_t>(std::popcount(m)) - 1] / 8;
    for (std::size_t k = 0; k < 3; ++k) {
      FourTwins values;
      for (std::size_t i = 0; i < 4; ++i)
        values[i] = x[with_axis_free(i, k) + only(k)];
      transform(values);
      for (std::size_t i = 0; i < 4; ++i)
        j[k][i][a] = values[i];
    }
  }
  return j;
}

/// Of each point which of the four values of each direction it has.
inline constexpr auto value_of_point = [] {
  std::array<std::array<std::size_t, 3>, 8> place{};
  for (std::size_t q = 0; q < 8; ++q)
    for (std::size_t k = 0; k < 3; ++k)
      place[q][k] = without_axis(q, k);
  return place;
}();

/// det J g_k, and g_k.
struct GradientTwins {
  DirectionTwins weighted;
  DirectionTwins plain;
};

inline void set_gradients(const JacobianTwins& j, GradientTwins& g) {
  for (std::size_t q = 0; q < 8; ++q) {
    const auto& place = value_of_point[q];
    const auto& x = j[0][place[0]];
    const auto& y = j[1][place[1]];
    const auto& z = j[2][place[2]];
    const auto set_cross = [&](const auto& v, const auto& w, auto& product) {
      product[0][q] = v[1] * w[2] - v[2] * w[1];
      product[1][q] = v[2] * w[0] - v[0] * w[2];
      product[2][q] = v[0] * w[1] - v[1] * w[0];
    };
    set_cross(y, z, g.weighted[0]);
    set_cross(z, x, g.weighted[1]);
    set_cross(x, y, g.weighted[2]);
    const auto& normal = g.weighted[0];
    const Twin inverse = 1. / (x[0] * normal[0][q] + x[1] * normal[1][q] + x[2] * normal[2][q]);
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t a = 0; a < 3; ++a)
        g.plain[k][a][q] = inverse * g.weighted[k][a][q];
  }
}

/// F_kk(s), which is zero where s has k: that of the sum of two points; then F_kl(s), l after k.
using GramTwins = std::array<TensorTwins, 36>;
constexpr std::size_t own_gram(std::size_t k, std::size_t s) {
  return 4 * k + without_axis(s, k);
}
constexpr std::size_t mixed_gram(std::size_t k, std::size_t s) {
  return 12 + 8 * k + s;
}

inline EightTwins products(const EightTwins& x, const EightTwins& y) {
  EightTwins xy;
  for (std::size_t q = 0; q < 8; ++q)
    xy[q] = x[q] * y[q];
  return xy;
}

template <std::size_t k> void set_own_gram(const GradientTwins& g, GramTwins& gram) {
  constexpr std::array<std::size_t, 6> row{0, 1, 2, 0, 1, 2}, column{0, 1, 2, 1, 2, 0};
  for (std::size_t ab = 0; ab < 6; ++ab) {
    const auto at_point = products(g.weighted[k][row[ab]], g.plain[k][column[ab]]);
    FourTwins sum;
    for (std::size_t i = 0; i < 4; ++i)
      sum[i] = at_point[with_axis_free(i, k)] + at_point[with_axis_free(i, k) + only(k)];
    if (ab >= 3)
      for (auto& value : sum)
        value += value;
    transform(sum);
    for (std::size_t i = 0; i < 4; ++i)
      gram[4 * k + i][ab] = sum[i];
  }
}

inline void set_mixed_gram(std::size_t k, const GradientTwins& g, GramTwins& gram) {
  const auto& weighted = g.weighted[k];
  const auto& plain = g.plain[next_axis(k)];
  auto* const out = &gram[mixed_gram(k, 0)];
  for (std::size_t a = 0; a < 3; ++a) {
    auto aa = products(weighted[a], plain[a]);
    transform(aa);
    for (std::size_t s = 0; s < 8; ++s)
      out[s][a] = aa[s];
  }
  for (std::size_t a = 0; a < 3; ++a) {
    auto ab = products(weighted[a], plain[next_axis(a)]);
    transform(ab);
    auto ba = products(weighted[next_axis(a)], plain[a]);
    transform(ba);
    for (std::size_t s = 0; s < 8; ++s) {
      out[s][3 + a] = ab[s] + ba[s];
      out[s][6 + a] = ab[s] - ba[s];
    }
  }
}

inline void set_gram(const PointsOfTwo& cells, GramTwins& gram) {
  GradientTwins g;
  set_gradients(jacobians(cells), g);
  set_own_gram<0>(g, gram);
  set_own_gram<1>(g, gram);
  set_own_gram<2>(g, gram);
  for (std::size_t k = 0; k < 3; ++k)
    set_mixed_gram(k, g, gram);
}

} // namespace rubato::element::hexa8_modes
