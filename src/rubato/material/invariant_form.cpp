// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/material/invariant_form.hpp"

#include "rubato/material/six.hpp"

#include <array>
#include <cmath>

namespace rubato::material {
namespace {

constexpr int xx = 0, yy = 1, zz = 2, xy = 3, yz = 4, xz = 5;

double determinant(const Stress6& a) {
  return a[xx] * (a[yy] * a[zz] - a[yz] * a[yz]) - a[xy] * (a[xy] * a[zz] - a[yz] * a[xz]) +
         a[xz] * (a[xy] * a[yz] - a[yy] * a[xz]);
}

Stress6 adjugate(const Stress6& a) {
  Stress6 adj;
  adj[xx] = a[yy] * a[zz] - a[yz] * a[yz];
  adj[yy] = a[xx] * a[zz] - a[xz] * a[xz];
  adj[zz] = a[xx] * a[yy] - a[xy] * a[xy];
  adj[xy] = a[xz] * a[yz] - a[xy] * a[zz];
  adj[yz] = a[xy] * a[xz] - a[xx] * a[yz];
  adj[xz] = a[xy] * a[yz] - a[xz] * a[yy];
  return adj;
}

/// a b of two that commute.
Stress6 product(const Stress6& a, const Stress6& b) {
  Stress6 c;
  c[xx] = a[xx] * b[xx] + a[xy] * b[xy] + a[xz] * b[xz];
  c[yy] = a[xy] * b[xy] + a[yy] * b[yy] + a[yz] * b[yz];
  c[zz] = a[xz] * b[xz] + a[yz] * b[yz] + a[zz] * b[zz];
  c[xy] = a[xx] * b[xy] + a[xy] * b[yy] + a[xz] * b[yz];
  c[yz] = a[xy] * b[xz] + a[yy] * b[yz] + a[yz] * b[zz];
  c[xz] = a[xx] * b[xz] + a[xy] * b[yz] + a[xz] * b[zz];
  return c;
}

Stress6 with_one(const Stress6& a) {
  return a + six_of(six_of_one);
}

/// d += `factor` (u⊗v + v⊗u).
void add_pair(Tangent6& d, double factor, const Stress6& u, const Stress6& v) {
  for (int j = 0; j < 6; ++j)
    d.col(j) += factor * (v[j] * u + u[j] * v);
}

/// d += `factor` ½ (c_ik c_jl + c_il c_jk).
void add_symmetrizer(Tangent6& d, double factor, const Stress6& c) {
  constexpr std::array<std::array<int, 3>, 3> place{{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}}};
  constexpr std::array<std::array<std::size_t, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};
  for (std::size_t row = 0; row < 6; ++row)
    for (std::size_t column = 0; column < 6; ++column) {
      const auto [i, j] = pairs[row];
      const auto [k, l] = pairs[column];
      d(static_cast<int>(row), static_cast<int>(column)) +=
          0.5 * factor * (c[place[i][k]] * c[place[j][l]] + c[place[i][l]] * c[place[j][k]]);
    }
}

void add_second_invariant(Tangent6& d, double factor, const Invariants& at, const Stress6& a2,
                          const Stress6& inverse) {
  const double i2 = at.scale * at.scale * (3 + at.minor);
  add_pair(d, -2.0 / 3 * factor, a2, inverse);
  add_pair(d, -2.0 / 9 * factor * i2, inverse, inverse);
  add_symmetrizer(d, 2.0 / 3 * factor * i2, inverse);
  d.topLeftCorner<3, 3>().array() += factor;
  d.diagonal() -= factor * six_of(six_with_half_shears);
}

} // namespace

bool find_invariants(const Strain6& strain, Invariants& out) {
  const double change = 2.0 / 3 * trace(strain);
  out.scale = 1 + change;
  out.d = 2 / out.scale * halved_shears(deviator(strain));
  out.minor = -0.5 * double_dot(out.d, out.d);
  const double g = out.minor + determinant(out.d); // less 1
  const Stress6 one_and_d = with_one(out.d);
  const Stress6 adj = adjugate(one_and_d);
  if (!(out.scale > 0 && one_and_d[xx] > 0 && adj[zz] > 0 && 1 + g > 0) || !std::isfinite(out.scale + g))
    return false;
  out.b = adj / (1 + g);
  const double logarithm = std::log1p(g);
  out.first = 3 * std::expm1(-logarithm / 3);
  const double second = std::expm1(-2 * logarithm / 3);
  out.second = 3 * second + out.minor * (1 + second);
  const double cube = change * (3 + change * (3 + change)); // m³ − 1
  out.square = cube + (1 + cube) * g;
  out.a = (1 + out.first / 3) / out.scale;
  return true;
}

void set_response(const Invariants& at, const InvariantEnergy& shape, const VolumeEnergy& volume, Want want,
                  Response& out) {
  const Stress6 inverse = at.b / at.scale;
  const Stress6 a1 = product(at.b, at.d);
  const Stress6 a2 = at.scale * (a1 - product(a1, at.d) - 2.0 / 3 * at.minor * at.b);
  const double w1 = at.a * shape.first;
  const double w2 = at.a * at.a * shape.second;
  out.stored = shape.energy + volume.energy;
  out.stress = 2 * w1 * a1 + 2 * w2 * a2 + volume.first * inverse;
  if (want == Want::stress)
    return;
  const double i1 = 3 * at.scale;
  auto& d = out.tangent;
  d.setZero();
  add_pair(d, -4.0 / 3 * w1, a1, inverse);
  add_pair(d, 0.5 * volume.second - 2.0 / 9 * w1 * i1, inverse, inverse);
  add_symmetrizer(d, 4.0 / 3 * w1 * i1 - 2 * volume.first, inverse);
  if (shape.first_first != 0)
    add_pair(d, 2 * at.a * at.a * shape.first_first, a1, a1);
  if (w2 != 0)
    add_second_invariant(d, 4 * w2, at, a2, inverse);
}

} // namespace rubato::material
