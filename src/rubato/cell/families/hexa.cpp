// SPDX-License-Identifier: LGPL-3.0-or-later
/// HEXA8 and HEXA27: products of Lagrange functions of one variable. HEXA20: serendipity
/// (building_blocks.hpp).
#include "rubato/cell/families/building_blocks.hpp"
#include "rubato/cell/families/families.hpp"
#include "rubato/cell/rules.hpp"

namespace rubato::cell {
namespace {

using Eigen::Vector3d;

constexpr std::array<std::array<LineIndex, 3>, 27> hexa_places{{
    {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1},
    {0, 1, 1}, // corners
    {2, 0, 0}, {1, 2, 0}, {2, 1, 0}, {0, 2, 0}, {2, 0, 1}, {1, 2, 1}, {2, 1, 1},
    {0, 2, 1},                                                                  // edges below, above
    {0, 0, 2}, {1, 0, 2}, {1, 1, 2}, {0, 1, 2},                                 // upright edges
    {0, 2, 2}, {1, 2, 2}, {2, 0, 2}, {2, 1, 2}, {2, 2, 0}, {2, 2, 1}, {2, 2, 2} // faces, body
}};

template <int Count, auto line> void hexa_values(const Vector3d& xi, std::span<double> n) {
  const auto a = line(xi[0]);
  const auto b = line(xi[1]);
  const auto c = line(xi[2]);
  for (std::size_t i = 0; i < Count; ++i)
    n[i] = a.value[hexa_places[i][0]] * b.value[hexa_places[i][1]] * c.value[hexa_places[i][2]];
}

template <int Count, auto line> void hexa_gradients(const Vector3d& xi, std::span<double> dn) {
  const auto a = line(xi[0]);
  const auto b = line(xi[1]);
  const auto c = line(xi[2]);
  for (std::size_t i = 0; i < Count; ++i) {
    const auto [p, q, r] = hexa_places[i];
    dn[3 * i] = a.slope[p] * b.value[q] * c.value[r];
    dn[3 * i + 1] = a.value[p] * b.slope[q] * c.value[r];
    dn[3 * i + 2] = a.value[p] * b.value[q] * c.slope[r];
  }
}

void values20(const Vector3d& xi, std::span<double> n) {
  hexa_values<20, hierarchic_line>(xi, n);
  subtract_half_of_mid_edges<1>(CellType::hexa20, n);
}

void gradients20(const Vector3d& xi, std::span<double> dn) {
  hexa_gradients<20, hierarchic_line>(xi, dn);
  subtract_half_of_mid_edges<3>(CellType::hexa20, dn);
}

std::array<Vector3d, 27> hexa_nodes() {
  std::array<Vector3d, 27> nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    nodes[i] = {line_nodes[hexa_places[i][0]], line_nodes[hexa_places[i][1]], line_nodes[hexa_places[i][2]]};
  return nodes;
}

} // namespace

std::span<const ReferenceCell> hexa_cells() {
  static const auto nodes = hexa_nodes();
  static const std::array<ReferenceCell, 3> cells{{
      {CellType::hexa8, 3, 8, hexa_values<8, linear_line>, hexa_gradients<8, linear_line>, nullptr,
       std::span(nodes).first(8), hexahedron_of_degree, 2, 2},
      {CellType::hexa20, 3, 20, values20, gradients20, nullptr, std::span(nodes).first(20),
       hexahedron_of_degree, 4, 4},
      {CellType::hexa27, 3, 27, hexa_values<27, quadratic_line>, hexa_gradients<27, quadratic_line>, nullptr,
       nodes, hexahedron_of_degree, 4, 4},
  }};
  return cells;
}

} // namespace rubato::cell
