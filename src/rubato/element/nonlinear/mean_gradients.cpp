// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/mean_gradients.hpp"

#include "rubato/cell/wave_patterns.hpp"
#include "rubato/element/nonlinear/pair.hpp"

#include <algorithm>

namespace rubato::element {
namespace {

template <int d> Waves<d> waves_of(CellType type) {
  const Eigen::MatrixXd table = cell::shortest_waves(type);
  Waves<d> waves;
  std::copy_n(table.data(), waves.values.size(), waves.values.begin());
  return waves;
}

/// Nodes by ξ + 2 η + 4 ζ, each 0 or 1.
template <int d> constexpr std::array<std::size_t, 1 << d> nodes_by_corner() {
  if constexpr (d == 2)
    return {0, 1, 3, 2};
  else
    return {0, 1, 3, 2, 4, 5, 7, 6};
}

/// Σ over corners with the signs of each wave.
template <class T, std::size_t n> void sum_over_corners(std::array<T, n>& values) {
  for (std::size_t bit = 1; bit < n; bit *= 2)
    for (std::size_t i = 0; i < n; ++i)
      if ((i & bit) == 0) {
        const T start = values[i], end = values[i + bit];
        values[i] = start + end;
        values[i + bit] = end - start;
      }
}

/// Σ over waves with their signs at each corner.
template <class T, std::size_t n> void sum_over_waves(std::array<T, n>& values) {
  for (std::size_t bit = 1; bit < n; bit *= 2)
    for (std::size_t i = 0; i < n; ++i)
      if ((i & bit) == 0) {
        const T even = values[i], odd = values[i + bit];
        values[i] = even - odd;
        values[i + bit] = even + odd;
      }
}

using Three = std::array<double, 3>;

Three cross(const Three& x, const Three& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

/// by · x + y/3.
Three sum(double by, const Three& x, const Three& y) {
  return {by * x[0] + y[0] / 3, by * x[1] + y[1] / 3, by * x[2] + y[2] / 3};
}

/// ∂V/∂c_w of a cell of reference size 1.
std::array<Three, 8> change_of_volume(const std::array<Three, 8>& c) {
  constexpr double third = 1. / 3;
  const auto &xi = c[1], &eta = c[2], &xi_eta = c[3], &zeta = c[4], &zeta_xi = c[5], &eta_zeta = c[6];
  return {Three{},
          sum(1, cross(eta, zeta), cross(xi_eta, zeta_xi)),
          sum(1, cross(zeta, xi), cross(eta_zeta, xi_eta)),
          sum(third, cross(zeta_xi, xi), cross(eta, eta_zeta)),
          sum(1, cross(xi, eta), cross(zeta_xi, eta_zeta)),
          sum(third, cross(xi, xi_eta), cross(eta_zeta, zeta)),
          sum(third, cross(xi_eta, eta), cross(zeta, zeta_xi)),
          Three{}};
}

std::array<Three, 4> change_of_volume(const std::array<Three, 4>& c) {
  return {Three{}, Three{c[2][1], -c[2][0]}, Three{-c[1][1], c[1][0]}, Three{}};
}

} // namespace

template <> const Waves<2>& waves<2>() {
  static const auto table = waves_of<2>(CellType::quad4);
  return table;
}

template <> const Waves<3>& waves<3>() {
  static const auto table = waves_of<3>(CellType::hexa8);
  return table;
}

template <int d> std::array<Three, 1 << d> wave_sums(std::span<const Eigen::Vector3d> points) {
  constexpr std::size_t n = 1 << d;
  constexpr auto nodes = nodes_by_corner<d>();
  std::array<Pair, n> xy;
  std::array<double, n> z{};
  for (std::size_t i = 0; i < n; ++i) {
    const double* const x = points[nodes[i]].data();
    xy[i] = Pair{x[0], x[1]};
    if constexpr (d == 3)
      z[i] = x[2];
  }
  sum_over_corners(xy);
  if constexpr (d == 3)
    sum_over_corners(z);
  std::array<Three, n> sums;
  for (std::size_t w = 0; w < n; ++w)
    sums[w] = {xy[w][0], xy[w][1], z[w]};
  return sums;
}

template <int d>
double set_mean_gradients(std::span<const Eigen::Vector3d> points, int stride, double* gradients) {
  constexpr std::size_t n = 1 << d;
  constexpr auto nodes = nodes_by_corner<d>();
  auto c = wave_sums<d>(points);
  for (auto& wave : c)
    for (std::size_t a = 0; a < d; ++a)
      wave[a] /= n;
  const auto change = change_of_volume(c);
  double volume = 0;
  for (std::size_t w = 1; w + 1 < n; ++w)
    for (std::size_t a = 0; a < d; ++a)
      volume += c[w][a] * change[w][a];
  volume *= static_cast<double>(n) / d;
  const double by = 1 / volume;
  std::array<Pair, n> xy;
  std::array<double, n> z;
  for (std::size_t w = 0; w < n; ++w) {
    xy[w] = Pair{change[w][0], change[w][1]} * by;
    z[w] = change[w][2] * by;
  }
  sum_over_waves(xy);
  if constexpr (d == 3)
    sum_over_waves(z);
  for (std::size_t i = 0; i < n; i += 2) {
    // both numbers of a pair are written at once, because they are read so
    const bool turned = nodes[i] > nodes[i + 1];
    const std::size_t first = turned ? i + 1 : i, second = turned ? i : i + 1;
    double* const at = gradients + nodes[first];
    put_pair(Pair{xy[first][0], xy[second][0]}, at);
    put_pair(Pair{xy[first][1], xy[second][1]}, at + stride);
    if constexpr (d == 3)
      put_pair(Pair{z[first], z[second]}, at + 2 * stride);
  }
  return volume;
}

template std::array<Three, 4> wave_sums<2>(std::span<const Eigen::Vector3d>);
template std::array<Three, 8> wave_sums<3>(std::span<const Eigen::Vector3d>);
template double set_mean_gradients<2>(std::span<const Eigen::Vector3d>, int, double*);
template double set_mean_gradients<3>(std::span<const Eigen::Vector3d>, int, double*);

} // namespace rubato::element
