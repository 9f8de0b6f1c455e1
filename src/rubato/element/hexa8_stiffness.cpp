// SPDX-License-Identifier: LGPL-3.0-or-later
/// In the modes of the trilinear cell instead of its nodes (D. P. Flanagan, T. Belytschko, A uniform strain
/// hexahedron and quadrilateral with orthogonal hourglass control, Int. J. Numer. Methods Eng. 17 (1981)
/// 679–706). A set m of the axes is a number whose bit k says whether ξ_k is in it, m + n the exclusive or:
///   φ_m = Π_{k in m} ξ_k,   φ_m φ_n = φ_{m+n} where |ξ_k| = 1,   N_i = ⅛ Σ_m φ_m(i) φ_m.
/// Corner i has ξ_k = −1 where bit k of i is set: φ_m(i) = φ_i(m) = (−1)^|m and i|, and sums over corners
/// with these signs are Walsh-Hadamard transforms, 24 additions. The points lie at ξ = a φ, a = 1/√3, where φ
/// is that of the corners. With g_k = ∂ξ_k/∂x
///   ∂φ_m/∂x = Σ_{k in m} a^(|m|−1) φ_{m+k} g_k,
///   A(m,n) = ∫ ∂φ_m ⊗ ∂φ_n dV = a^(|m|+|n|−2) Σ_{k in m, l in n} F_kl(m+n+k+l),
///   F_kl(s) = Σ_q φ_s(q) det J g_k ⊗ g_l:
/// transforms over the points. With A = A(m,n) the stiffness of modes is M = λ A + μ Aᵀ + μ tr A 1, that of
/// corners
///   K(i,i+t) = 1/64 Σ_p φ_p(i) Σ_n φ_n(t) M(n+p,n).
/// n and n + p together give M + Mᵀ = (λ+μ)(A + Aᵀ) + 2 μ tr A 1 where φ_p(t) = 1, otherwise
/// M − Mᵀ = (λ−μ)(A − Aᵀ): of all tensors the symmetric and the skew part are held. Products with mode 0 are
/// zero.
#include "rubato/element/hexa8_stiffness.hpp"

#include "rubato/element/hexa8_gram.hpp"

#include <bit>
#include <cstddef>
#include <cstring>

namespace rubato::element::hexa8_modes {
namespace {

/// What takes A + Aᵀ and A − Aᵀ to M + Mᵀ and M − Mᵀ.
struct LameTwins {
  Twin axial; ///< of A_xx …
  Twin shear;
  Twin trace;
  Twin skew;
};

LameTwins scaled_lame(const std::array<Hexa8Stiffness, 2>& cells, double scale) {
  const Twin lambda = scale * Twin{cells[0].lame.lambda, cells[1].lame.lambda};
  const Twin mu = scale * Twin{cells[0].lame.mu, cells[1].lame.mu};
  return {2. * (lambda + mu), lambda + mu, 2. * mu, lambda - mu};
}

/// Σ_n φ_n(t) M(n+p,n) at 8 t + p: its symmetric part where φ_p(t) = 1, else the skew one, which comes first.
using HalfTwins = std::array<SymmetricTwins, 64>;

/// With p ≠ 0: n = first, second, and both together; n + p are the other modes, and 0 and p.
struct ModesOfSum {
  std::size_t first, second;
  /// Where the sums with the signs ++ +− −+ −− of `first` and `second` go, φ_p(t) = 1 and −1.
  std::array<std::array<std::size_t, 4>, 2> targets;
};

constexpr ModesOfSum modes_of_sum(std::size_t p, std::size_t first, std::size_t second) {
  ModesOfSum modes{first, second, {}};
  for (std::size_t t = 0; t < 8; ++t)
    modes.targets[is_odd(t & p)][2 * is_odd(t & first) + is_odd(t & second)] = 8 * t + p;
  return modes;
}

using ThreeTwins = std::array<Twin, 3>;

void put_sums(const ThreeTwins& of, const std::array<std::size_t, 4>& targets, std::size_t component,
              HalfTwins& half) {
  const Twin sum = of[1] + of[2], difference = of[1] - of[2], reverse = of[2] - of[1];
  half[targets[0]][component] = of[0] + sum;
  half[targets[1]][component] = of[0] - sum;
  half[targets[2]][component] = difference - of[0];
  half[targets[3]][component] = reverse - of[0];
}

/// `symmetric` and `skew` give component c of A(n+p,n), without its power of a, for the three n.
template <class SymmetricParts, class SkewParts>
void put_modes(const ModesOfSum& modes, const std::array<const LameTwins*, 3>& lame,
               const SymmetricParts& symmetric, const SkewParts& skew, HalfTwins& half) {
  const std::array<ThreeTwins, 3> axial{symmetric(0), symmetric(1), symmetric(2)};
  ThreeTwins trace;
  for (std::size_t n = 0; n < 3; ++n)
    trace[n] = lame[n]->trace * (axial[0][n] + axial[1][n] + axial[2][n]);
  for (std::size_t c = 0; c < 3; ++c) {
    ThreeTwins m;
    for (std::size_t n = 0; n < 3; ++n)
      m[n] = lame[n]->axial * axial[c][n] + trace[n];
    put_sums(m, modes.targets[0], c, half);
  }
  for (std::size_t c = 3; c < 6; ++c) {
    auto m = symmetric(c);
    for (std::size_t n = 0; n < 3; ++n)
      m[n] *= lame[n]->shear;
    put_sums(m, modes.targets[0], c, half);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    auto m = skew(6 + c);
    for (std::size_t n = 0; n < 3; ++n)
      m[n] *= lame[n]->skew;
    put_sums(m, modes.targets[1], c, half);
  }
}

/// p = k: from modes l, m = the axes after it, and l + m.
void put_modes_of_axis(std::size_t k, const GramTwins& gram, const std::array<LameTwins, 4>& lame,
                       HalfTwins& half) {
  constexpr std::array modes{modes_of_sum(1, 2, 4), modes_of_sum(2, 4, 1), modes_of_sum(4, 1, 2)};
  const auto l = next_axis(k), m = next_axis(l);
  const auto &ll = gram[own_gram(l, only(k))], &mm = gram[own_gram(m, only(k))],
             &kl = gram[mixed_gram(k, only(l))], &mk = gram[mixed_gram(m, only(m))],
             &lm = gram[mixed_gram(l, 7)];
  put_modes(
      modes[k], {&lame[1], &lame[1], &lame[3]},
      [&](std::size_t c) {
        const Twin of_l = ll[c] + kl[c], of_m = mm[c] + mk[c];
        return ThreeTwins{of_l, of_m, of_l + of_m + (lm[c] + lm[c])};
      },
      [&](std::size_t c) {
        return ThreeTwins{kl[c], -mk[c], kl[c] - mk[c]};
      },
      half);
}

/// p = l + m, the axes after k: from modes l, k, and k + l.
void put_modes_of_face(std::size_t k, const GramTwins& gram, const std::array<LameTwins, 4>& lame,
                       HalfTwins& half) {
  constexpr std::array modes{modes_of_sum(6, 2, 1), modes_of_sum(5, 4, 2), modes_of_sum(3, 1, 4)};
  const auto l = next_axis(k), m = next_axis(l);
  const auto &kk = gram[own_gram(k, only(l) + only(m))], &lm = gram[mixed_gram(l, 0)],
             &kl = gram[mixed_gram(k, only(k) + only(m))], &mk = gram[mixed_gram(m, only(k) + only(l))];
  put_modes(
      modes[k], {&lame[0], &lame[2], &lame[2]},
      [&](std::size_t c) {
        const Twin of_k = kk[c] + kl[c] + mk[c];
        return ThreeTwins{lm[c], of_k, of_k + lm[c]};
      },
      [&](std::size_t c) {
        return ThreeTwins{-lm[c], mk[c] - kl[c], kl[c] + mk[c] - lm[c]};
      },
      half);
}

/// p = 7: from modes ξ, η, ξη.
void put_modes_of_volume(const GramTwins& gram, const LameTwins& lame, HalfTwins& half) {
  constexpr auto modes = modes_of_sum(7, 1, 2);
  const auto &xy = gram[mixed_gram(0, 4)], &yz = gram[mixed_gram(1, 1)], &zx = gram[mixed_gram(2, 2)];
  put_modes(
      modes, {&lame, &lame, &lame},
      [&](std::size_t c) {
        return ThreeTwins{xy[c] + zx[c], xy[c] + yz[c], yz[c] + zx[c]};
      },
      [&](std::size_t c) {
        return ThreeTwins{zx[c] - xy[c], xy[c] - yz[c], zx[c] - yz[c]};
      },
      half);
}

/// A(n,n), without its power of a.
std::array<SymmetricTwins, 8> diagonal_gram(const GramTwins& gram) {
  const auto &xx = gram[own_gram(0, 0)], &yy = gram[own_gram(1, 0)], &zz = gram[own_gram(2, 0)],
             &xy = gram[mixed_gram(0, 3)], &yz = gram[mixed_gram(1, 6)], &zx = gram[mixed_gram(2, 5)];
  std::array<SymmetricTwins, 8> a;
  for (std::size_t c = 0; c < 6; ++c) {
    const Twin twice_xy = xy[c] + xy[c], twice_yz = yz[c] + yz[c], twice_zx = zx[c] + zx[c];
    a[1][c] = xx[c];
    a[2][c] = yy[c];
    a[4][c] = zz[c];
    a[3][c] = xx[c] + yy[c] + twice_xy;
    a[5][c] = xx[c] + zz[c] + twice_zx;
    a[6][c] = yy[c] + zz[c] + twice_yz;
    a[7][c] = a[3][c] + zz[c] + (twice_yz + twice_zx);
  }
  return a;
}

void apply_lame(const LameTwins& lame, SymmetricTwins& a) {
  const Twin trace = lame.trace * (a[0] + a[1] + a[2]);
  for (std::size_t c = 0; c < 3; ++c)
    a[c] = lame.axial * a[c] + trace;
  for (std::size_t c = 3; c < 6; ++c)
    a[c] *= lame.shear;
}

/// p = 0.
void put_modes_themselves(const std::array<Hexa8Stiffness, 2>& cells, const GramTwins& gram,
                          HalfTwins& half) {
  std::array<LameTwins, 3> lame; // M itself instead of M + Mᵀ
  for (std::size_t power = 0; power < 3; ++power)
    lame[power] = scaled_lame(cells, gauss_power[2 * power] / 128);
  auto m = diagonal_gram(gram);
  for (std::size_t n = 1; n < 8; ++n)
    apply_lame(lame[static_cast<std::size_t>(std::popcount(n)) - 1], m[n]);
  for (std::size_t c = 0; c < 6; ++c) {
    EightTwins v{m[1][c], -m[1][c], m[2][c], m[3][c], m[4][c], m[5][c], m[6][c], m[7][c]};
    add_and_subtract(v[2], v[3]);
    add_and_subtract(v[4], v[5]);
    add_and_subtract(v[6], v[7]);
    transform_rest(v);
    for (std::size_t t = 0; t < 8; ++t)
      half[8 * t][c] = v[t];
  }
}

void set_half(const std::array<Hexa8Stiffness, 2>& cells, const GramTwins& gram, HalfTwins& half) {
  std::array<LameTwins, 4> lame;
  for (std::size_t power = 0; power < 4; ++power)
    lame[power] = scaled_lame(cells, gauss_power[power] / 64);
  put_modes_themselves(cells, gram, half);
  for (std::size_t k = 0; k < 3; ++k) {
    put_modes_of_axis(k, gram, lame, half);
    put_modes_of_face(k, gram, lame, half);
  }
  put_modes_of_volume(gram, lame[1], half);
}

/// At any address.
void put_both(Twin twin, double* values) {
  std::memcpy(values, &twin, sizeof(Twin));
}

/// Of both matrices three entries of a column after each other.
void put_column(const Twin& x, const Twin& y, const Twin& z, double* first, double* second) {
  put_both(Twin{x[0], y[0]}, first);
  first[2] = z[0];
  put_both(Twin{x[1], y[1]}, second);
  second[2] = z[1];
}

/// Where the block of two corners begins.
constexpr std::size_t place_of_block(std::size_t i, std::size_t j) {
  return 3 * (node_of_sign[i] + 24 * node_of_sign[j]);
}

void put_diagonal(const HalfTwins& half, double* first, double* second) {
  std::array<SymmetricTwins, 8> block;
  for (std::size_t c = 0; c < 6; ++c) {
    EightTwins v;
    for (std::size_t p = 0; p < 8; ++p)
      v[p] = half[p][c];
    transform(v);
    for (std::size_t i = 0; i < 8; ++i)
      block[i][c] = v[i];
  }
  for (std::size_t i = 0; i < 8; ++i) {
    const auto& [xx, yy, zz, xy, yz, zx] = block[i];
    double *const a = first + place_of_block(i, i), *const b = second + place_of_block(i, i);
    put_column(xx, xy, zx, a, b);
    put_column(xy, yy, yz, a + 24, b + 24);
    put_column(zx, yz, zz, a + 48, b + 48);
  }
}

/// K(i,i+t) and its mirror image for the four pairs i, i+t.
struct PairsOfCorners {
  std::array<std::size_t, 4> symmetric, skew; ///< what they are sums of
  std::array<std::size_t, 4> place, mirrored;
};

/// φ_p(i) = 1 for the p = the lowest bit of t: the other i are i + t.
constexpr PairsOfCorners pairs_of_corners(std::size_t t) {
  PairsOfCorners pairs{};
  const std::size_t low = t & (~t + 1);
  std::array<std::size_t, 4> even{};
  for (std::size_t p = 0, n = 0; p < 8; ++p)
    if (!is_odd(p & t))
      even[n++] = p;
  for (std::size_t n = 0; n < 4; ++n) {
    pairs.symmetric[n] = 8 * t + even[n];
    pairs.skew[n] = 8 * t + (even[n] ^ low);
  }
  for (std::size_t i = 0; i < 8; ++i)
    if ((i & low) == 0) {
      const std::size_t n = is_odd(i & even[1]) + 2 * is_odd(i & even[2]);
      pairs.place[n] = place_of_block(i, i ^ t);
      pairs.mirrored[n] = place_of_block(i ^ t, i);
    }
  return pairs;
}

constexpr std::array all_pairs{pairs_of_corners(1), pairs_of_corners(2), pairs_of_corners(3),
                               pairs_of_corners(4), pairs_of_corners(5), pairs_of_corners(6),
                               pairs_of_corners(7)};

using FourTensors = std::array<TensorTwins, 4>;

template <std::size_t begin, std::size_t count>
void sum_over_modes(const HalfTwins& half, const std::array<std::size_t, 4>& from, FourTensors& blocks) {
  const auto &a = half[from[0]], &b = half[from[1]], &c = half[from[2]], &d = half[from[3]];
  for (std::size_t i = 0; i < count; ++i) {
    FourTwins v{a[i], b[i], c[i], d[i]};
    transform(v);
    for (std::size_t n = 0; n < 4; ++n)
      blocks[n][begin + i] = v[n];
  }
}

void put_pair(const TensorTwins& block, std::size_t place, std::size_t mirrored, double* first,
              double* second) {
  const auto& [xx, yy, zz, even_xy, even_yz, even_zx, odd_xy, odd_yz, odd_zx] = block;
  const Twin xy = even_xy + odd_xy, yx = even_xy - odd_xy;
  const Twin yz = even_yz + odd_yz, zy = even_yz - odd_yz;
  const Twin zx = even_zx + odd_zx, xz = even_zx - odd_zx;
  double *const a = first + place, *const b = second + place;
  put_column(xx, yx, zx, a, b);
  put_column(xy, yy, zy, a + 24, b + 24);
  put_column(xz, yz, zz, a + 48, b + 48);
  double *const c = first + mirrored, *const d = second + mirrored;
  put_column(xx, xy, xz, c, d);
  put_column(yx, yy, yz, c + 24, d + 24);
  put_column(zx, zy, zz, c + 48, d + 48);
}

void put_pairs(const HalfTwins& half, double* first, double* second) {
  for (const auto& pairs : all_pairs) {
    FourTensors blocks;
    sum_over_modes<0, 6>(half, pairs.symmetric, blocks);
    sum_over_modes<6, 3>(half, pairs.skew, blocks);
    for (std::size_t n = 0; n < 4; ++n)
      put_pair(blocks[n], pairs.place[n], pairs.mirrored[n], first, second);
  }
}

} // namespace
} // namespace rubato::element::hexa8_modes

namespace rubato::element {

void set_hexa8_stiffness(const std::array<Hexa8Stiffness, 2>& cells) {
  hexa8_modes::GramTwins gram;
  hexa8_modes::set_gram({cells[0].points, cells[1].points}, gram);
  hexa8_modes::HalfTwins half;
  hexa8_modes::set_half(cells, gram, half);
  for (const auto& cell : cells)
    cell.k.resize(24, 24);
  hexa8_modes::put_diagonal(half, cells[0].k.data(), cells[1].k.data());
  hexa8_modes::put_pairs(half, cells[0].k.data(), cells[1].k.data());
}

} // namespace rubato::element
