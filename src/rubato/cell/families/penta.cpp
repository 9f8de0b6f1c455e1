// SPDX-License-Identifier: LGPL-3.0-or-later
/// PENTA6: area coordinates times linear functions of ζ. PENTA15: serendipity (building_blocks.hpp).
#include "rubato/cell/families/building_blocks.hpp"
#include "rubato/cell/families/families.hpp"
#include "rubato/cell/rules.hpp"

namespace rubato::cell {
namespace {

using Eigen::Vector3d;

/// Which function of the triangle, and which of the line, a node multiplies.
constexpr std::array<std::array<LineIndex, 2>, 15> penta_places{{{0, 0},
                                                                 {1, 0},
                                                                 {2, 0},
                                                                 {0, 1},
                                                                 {1, 1},
                                                                 {2, 1},
                                                                 {3, 0},
                                                                 {4, 0},
                                                                 {5, 0},
                                                                 {3, 1},
                                                                 {4, 1},
                                                                 {5, 1},
                                                                 {0, 2},
                                                                 {1, 2},
                                                                 {2, 2}}};

template <int Count> void penta_values(const Vector3d& xi, std::span<double> n) {
  const auto face = hierarchic_triangle(xi[0], xi[1]);
  const auto line = hierarchic_line(xi[2]);
  for (std::size_t i = 0; i < Count; ++i)
    n[i] = face.value[penta_places[i][0]] * line.value[penta_places[i][1]];
}

template <int Count> void penta_gradients(const Vector3d& xi, std::span<double> dn) {
  const auto face = hierarchic_triangle(xi[0], xi[1]);
  const auto line = hierarchic_line(xi[2]);
  for (std::size_t i = 0; i < Count; ++i) {
    const auto [p, q] = penta_places[i];
    dn[3 * i] = face.slope[p][0] * line.value[q];
    dn[3 * i + 1] = face.slope[p][1] * line.value[q];
    dn[3 * i + 2] = face.value[p] * line.slope[q];
  }
}

void values15(const Vector3d& xi, std::span<double> n) {
  penta_values<15>(xi, n);
  subtract_half_of_mid_edges<1>(CellType::penta15, n);
}

void gradients15(const Vector3d& xi, std::span<double> dn) {
  penta_gradients<15>(xi, dn);
  subtract_half_of_mid_edges<3>(CellType::penta15, dn);
}

std::array<Vector3d, 15> penta_nodes() {
  constexpr std::array<std::array<double, 2>, 6> triangle{
      {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}}};
  std::array<Vector3d, 15> nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const auto [x, y] = triangle[penta_places[i][0]];
    nodes[i] = {x, y, line_nodes[penta_places[i][1]]};
  }
  return nodes;
}

} // namespace

std::span<const ReferenceCell> penta_cells() {
  static const auto nodes = penta_nodes();
  static const std::array<ReferenceCell, 2> cells{{
      {CellType::penta6, 3, 6, penta_values<6>, penta_gradients<6>, nullptr, std::span(nodes).first(6),
       prism_of_degree, 2, 2},
      {CellType::penta15, 3, 15, values15, gradients15, nullptr, nodes, prism_of_degree, 4, 4},
  }};
  return cells;
}

} // namespace rubato::cell
