// SPDX-License-Identifier: LGPL-3.0-or-later
/// TRIA3: area coordinates. TRIA6: complete quadratics. TRIA7: TRIA6 and the bubble b = 27 L0 L1 L2, which
/// takes the value of each TRIA6 function at the centre (−1/9 at corners, 4/9 at mid-edge nodes) away from
/// it.
#include "rubato/cell/families/building_blocks.hpp"
#include "rubato/cell/families/families.hpp"
#include "rubato/cell/rules.hpp"

#include <algorithm>

namespace rubato::cell {
namespace {

using Eigen::Vector3d;

constexpr double corner_at_centre = -1. / 9.;
constexpr double mid_edge_at_centre = 4. / 9.;

template <int Stride> void add_centre(std::span<double> rows, const std::array<double, Stride>& bubble) {
  double* row = rows.data();
  for (int node = 0; node < 6; ++node)
    for (int k = 0; k < Stride; ++k)
      *row++ -= (node < 3 ? corner_at_centre : mid_edge_at_centre) * bubble[static_cast<std::size_t>(k)];
  std::ranges::copy(bubble, row);
}

void values3(const Vector3d& xi, std::span<double> n) {
  n[0] = 1 - xi[0] - xi[1];
  n[1] = xi[0];
  n[2] = xi[1];
}

void gradients3(const Vector3d&, std::span<double> dn) {
  constexpr std::array<double, 6> rows{-1, -1, 1, 0, 0, 1};
  std::ranges::copy(rows, dn.begin());
}

void hessians3(const Vector3d&, std::span<double> ddn) {
  std::fill_n(ddn.begin(), 12, 0.);
}

void values6(const Vector3d& xi, std::span<double> n) {
  std::ranges::copy(hierarchic_triangle(xi[0], xi[1]).value, n.begin());
  subtract_half_of_face_edges<3>(n);
}

void gradients6(const Vector3d& xi, std::span<double> dn) {
  auto out = dn.begin();
  for (const auto& slope : hierarchic_triangle(xi[0], xi[1]).slope)
    out = std::ranges::copy(slope, out).out;
  subtract_half_of_mid_edges<2>(CellType::tria6, dn);
}

void hessians6(const Vector3d&, std::span<double> ddn) {
  constexpr std::array<double, 24> rows{4,  4,  4,  4, 4, 0, 0, 0, 0, 0,  0,  4, //
                                        -8, -4, -4, 0, 0, 4, 4, 0, 0, -4, -4, -8};
  std::ranges::copy(rows, ddn.begin());
}

void values7(const Vector3d& xi, std::span<double> n) {
  const double x = xi[0], y = xi[1], z = 1 - x - y;
  values6(xi, n);
  add_centre<1>(n, {27 * x * y * z});
}

void gradients7(const Vector3d& xi, std::span<double> dn) {
  const double x = xi[0], y = xi[1], z = 1 - x - y;
  gradients6(xi, dn);
  add_centre<2>(dn, {27 * y * (z - x), 27 * x * (z - y)});
}

void hessians7(const Vector3d& xi, std::span<double> ddn) {
  const double x = xi[0], y = xi[1];
  const double mixed = 27 * (1 - 2 * x - 2 * y);
  hessians6(xi, ddn);
  add_centre<4>(ddn, {-54 * y, mixed, mixed, -54 * x});
}

} // namespace

std::span<const ReferenceCell> tria_cells() {
  static const std::array<Vector3d, 7> nodes{
      Vector3d(0, 0, 0),     Vector3d(1, 0, 0),   Vector3d(0, 1, 0),          Vector3d(0.5, 0, 0),
      Vector3d(0.5, 0.5, 0), Vector3d(0, 0.5, 0), Vector3d(1. / 3, 1. / 3, 0)};
  static const std::array<ReferenceCell, 3> cells{{
      {CellType::tria3, 2, 3, values3, gradients3, hessians3, std::span(nodes).first(3), triangle_of_degree,
       0, 2},
      {CellType::tria6, 2, 6, values6, gradients6, hessians6, std::span(nodes).first(6), triangle_of_degree,
       2, 4},
      {CellType::tria7, 2, 7, values7, gradients7, hessians7, nodes, triangle_of_degree, 4, 6},
  }};
  return cells;
}

} // namespace rubato::cell
