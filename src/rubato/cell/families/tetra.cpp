// SPDX-License-Identifier: LGPL-3.0-or-later
/// TETRA4: volume coordinates L0 = 1−ξ−η−ζ, ξ, η, ζ. TETRA10: complete quadratics (building_blocks.hpp).
#include "rubato/cell/families/building_blocks.hpp"
#include "rubato/cell/families/families.hpp"
#include "rubato/cell/rules.hpp"

#include <algorithm>

namespace rubato::cell {
namespace {

using Eigen::Vector3d;

constexpr std::array<std::array<double, 3>, 4> n_xi{{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

void values4(const Vector3d& xi, std::span<double> n) {
  n[0] = 1 - xi.sum();
  std::ranges::copy(xi, n.begin() + 1);
}

void gradients4(const Vector3d&, std::span<double> dn) {
  auto out = dn.begin();
  for (const auto& slope : n_xi)
    out = std::ranges::copy(slope, out).out;
}

void values10(const Vector3d& xi, std::span<double> n) {
  values4(xi, n);
  std::size_t node = 4;
  for (const auto [p, q] : cell::topology(CellType::tetra10).edges)
    n[node++] = 4 * n[p] * n[q];
  subtract_half_of_mid_edges<1>(CellType::tetra10, n);
}

void gradients10(const Vector3d& xi, std::span<double> dn) {
  const std::array<double, 4> volume{1 - xi.sum(), xi[0], xi[1], xi[2]};
  gradients4(xi, dn);
  auto out = dn.begin() + 12;
  for (const auto [p, q] : cell::topology(CellType::tetra10).edges)
    for (std::size_t a = 0; a < 3; ++a)
      *out++ = 4 * (n_xi[p][a] * volume[q] + volume[p] * n_xi[q][a]);
  subtract_half_of_mid_edges<3>(CellType::tetra10, dn);
}

} // namespace

std::span<const ReferenceCell> tetra_cells() {
  static const std::array<Vector3d, 10> nodes{
      Vector3d(0, 0, 0),     Vector3d(1, 0, 0),     Vector3d(0, 1, 0),   Vector3d(0, 0, 1),
      Vector3d(0.5, 0, 0),   Vector3d(0.5, 0.5, 0), Vector3d(0, 0.5, 0), Vector3d(0, 0, 0.5),
      Vector3d(0.5, 0, 0.5), Vector3d(0, 0.5, 0.5)};
  static const std::array<ReferenceCell, 2> cells{{
      {CellType::tetra4, 3, 4, values4, gradients4, nullptr, std::span(nodes).first(4), tetrahedron_of_degree,
       0, 2},
      {CellType::tetra10, 3, 10, values10, gradients10, nullptr, nodes, tetrahedron_of_degree, 2, 4},
  }};
  return cells;
}

} // namespace rubato::cell
