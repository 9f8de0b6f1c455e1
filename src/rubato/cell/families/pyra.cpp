// SPDX-License-Identifier: LGPL-3.0-or-later
/// PYRA5: rational functions that are bilinear on the base and linear on the triangles, so that they fit
/// hexahedra and tetrahedra (G. Bedrosian, Shape functions and integration formulas for three-dimensional
/// finite element analysis, Int. J. Numer. Methods Eng. 35 (1992) 95–108; Code_Aster documentation R3.01.01).
/// On the square u = ξ/s, v = η/s, s = 1−ζ, to which each level of the pyramid is spread, they are
/// polynomials. PYRA13: serendipity (building_blocks.hpp) on these, Bedrosian's quadratic functions.
#include "rubato/cell/families/building_blocks.hpp"
#include "rubato/cell/families/families.hpp"
#include "rubato/cell/rules.hpp"

namespace rubato::cell {
namespace {

using Eigen::Vector3d;

/// The corners of the base on the square.
constexpr std::array<std::array<double, 2>, 4> base{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};

struct SpreadPoint {
  double u;
  double v;
  double s;
};

/// At the apex the square has shrunk to a point, and gradients depend on the way there: taken is the axis.
SpreadPoint spread(const Vector3d& xi) {
  const double s = 1 - xi[2];
  return s == 0 ? SpreadPoint{0, 0, 0} : SpreadPoint{xi[0] / s, xi[1] / s, s};
}

void values5(const Vector3d& xi, std::span<double> n) {
  const auto [u, v, s] = spread(xi);
  for (std::size_t i = 0; i < base.size(); ++i)
    n[i] = 0.25 * s * (1 + base[i][0] * u) * (1 + base[i][1] * v);
  n[4] = xi[2];
}

void gradients5(const Vector3d& xi, std::span<double> dn) {
  const auto [u, v, s] = spread(xi);
  for (std::size_t i = 0; i < base.size(); ++i) {
    const auto [a, b] = base[i];
    dn[3 * i] = 0.25 * a * (1 + b * v);
    dn[3 * i + 1] = 0.25 * b * (1 + a * u);
    dn[3 * i + 2] = 0.25 * (a * b * u * v - 1);
  }
  dn[12] = dn[13] = 0;
  dn[14] = 1;
}

/// A mid-edge node of the base is at 0 in one direction and on a side of the square in the other.
struct BaseEdge {
  int along;   ///< 0: the edge runs along ξ, 1: along η
  double side; ///< of the square: −1 or 1
};
constexpr std::array<BaseEdge, 4> base_edges{{{0, -1}, {1, 1}, {0, 1}, {1, -1}}};

void values13(const Vector3d& xi, std::span<double> n) {
  const auto [u, v, s] = spread(xi);
  values5(xi, n);
  for (std::size_t e = 0; e < base_edges.size(); ++e) {
    const auto [along, side] = base_edges[e];
    const double p = along == 0 ? u : v, q = along == 0 ? v : u;
    n[5 + e] = 0.5 * s * s * (1 - p * p) * (1 + side * q);
    n[9 + e] = 4 * xi[2] * n[e];
  }
  subtract_half_of_mid_edges<1>(CellType::pyra13, n);
}

void gradients13(const Vector3d& xi, std::span<double> dn) {
  const auto [u, v, s] = spread(xi);
  std::array<double, 5> linear{};
  values5(xi, linear);
  gradients5(xi, dn);
  for (std::size_t e = 0; e < base_edges.size(); ++e) {
    const auto [along, side] = base_edges[e];
    const double p = along == 0 ? u : v, q = along == 0 ? v : u;
    const auto on_base = dn.subspan(3 * (5 + e), 3), upright = dn.subspan(3 * (9 + e), 3);
    on_base[static_cast<std::size_t>(along)] = -s * p * (1 + side * q);
    on_base[static_cast<std::size_t>(1 - along)] = 0.5 * s * side * (1 - p * p);
    on_base[2] = -s * (1 + 0.5 * side * q * (1 + p * p));
    for (std::size_t a = 0; a < 3; ++a)
      upright[a] = 4 * xi[2] * dn[3 * e + a];
    upright[2] += 4 * linear[e];
  }
  subtract_half_of_mid_edges<3>(CellType::pyra13, dn);
}

} // namespace

std::span<const ReferenceCell> pyra_cells() {
  static const std::array<Vector3d, 13> nodes{
      Vector3d(-1, -1, 0),     Vector3d(1, -1, 0),        Vector3d(1, 1, 0),        Vector3d(-1, 1, 0),
      Vector3d(0, 0, 1),       Vector3d(0, -1, 0),        Vector3d(1, 0, 0),        Vector3d(0, 1, 0),
      Vector3d(-1, 0, 0),      Vector3d(-0.5, -0.5, 0.5), Vector3d(0.5, -0.5, 0.5), Vector3d(0.5, 0.5, 0.5),
      Vector3d(-0.5, 0.5, 0.5)};
  static const std::array<ReferenceCell, 2> cells{{
      {CellType::pyra5, 3, 5, values5, gradients5, nullptr, std::span(nodes).first(5), pyramid_of_degree, 2,
       2},
      {CellType::pyra13, 3, 13, values13, gradients13, nullptr, nodes, pyramid_of_degree, 4, 4},
  }};
  return cells;
}

} // namespace rubato::cell
