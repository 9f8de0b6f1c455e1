// SPDX-License-Identifier: LGPL-3.0-or-later
/// QUAD4 and QUAD9: products of Lagrange functions of one variable. QUAD8: serendipity (building_blocks.hpp).
#include "rubato/cell/families/building_blocks.hpp"
#include "rubato/cell/families/families.hpp"
#include "rubato/cell/rules.hpp"

namespace rubato::cell {
namespace {

using Eigen::Vector3d;

constexpr std::array<std::array<LineIndex, 2>, 9> quad_places{
    {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {1, 2}, {2, 1}, {0, 2}, {2, 2}}};

template <int Count, auto line> void quad_values(const Vector3d& xi, std::span<double> n) {
  const auto a = line(xi[0]);
  const auto b = line(xi[1]);
  for (std::size_t i = 0; i < Count; ++i)
    n[i] = a.value[quad_places[i][0]] * b.value[quad_places[i][1]];
}

template <int Count, auto line> void quad_gradients(const Vector3d& xi, std::span<double> dn) {
  const auto a = line(xi[0]);
  const auto b = line(xi[1]);
  for (std::size_t i = 0; i < Count; ++i) {
    const auto [p, q] = quad_places[i];
    dn[2 * i] = a.slope[p] * b.value[q];
    dn[2 * i + 1] = a.value[p] * b.slope[q];
  }
}

template <int Count, auto line> void quad_hessians(const Vector3d& xi, std::span<double> ddn) {
  const auto a = line(xi[0]);
  const auto b = line(xi[1]);
  for (std::size_t i = 0; i < Count; ++i) {
    const auto [p, q] = quad_places[i];
    ddn[4 * i] = a.curvature[p] * b.value[q];
    ddn[4 * i + 1] = ddn[4 * i + 2] = a.slope[p] * b.slope[q];
    ddn[4 * i + 3] = a.value[p] * b.curvature[q];
  }
}

void values8(const Vector3d& xi, std::span<double> n) {
  quad_values<8, hierarchic_line>(xi, n);
  subtract_half_of_face_edges<4>(n);
}

void gradients8(const Vector3d& xi, std::span<double> dn) {
  quad_gradients<8, hierarchic_line>(xi, dn);
  subtract_half_of_mid_edges<2>(CellType::quad8, dn);
}

void hessians8(const Vector3d& xi, std::span<double> ddn) {
  quad_hessians<8, hierarchic_line>(xi, ddn);
  subtract_half_of_mid_edges<4>(CellType::quad8, ddn);
}

std::array<Vector3d, 9> quad_nodes() {
  std::array<Vector3d, 9> nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    nodes[i] = {line_nodes[quad_places[i][0]], line_nodes[quad_places[i][1]], 0.};
  return nodes;
}

} // namespace

std::span<const ReferenceCell> quad_cells() {
  static const auto nodes = quad_nodes();
  static const std::array<ReferenceCell, 3> cells{{
      {CellType::quad4, 2, 4, quad_values<4, linear_line>, quad_gradients<4, linear_line>,
       quad_hessians<4, linear_line>, std::span(nodes).first(4), quadrangle_of_degree, 2, 2},
      {CellType::quad8, 2, 8, values8, gradients8, hessians8, std::span(nodes).first(8), quadrangle_of_degree,
       4, 4},
      {CellType::quad9, 2, 9, quad_values<9, quadratic_line>, quad_gradients<9, quadratic_line>,
       quad_hessians<9, quadratic_line>, nodes, quadrangle_of_degree, 4, 4},
  }};
  return cells;
}

} // namespace rubato::cell
