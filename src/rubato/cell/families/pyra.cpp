// SPDX-License-Identifier: LGPL-3.0-or-later
/// PYRA5: rational functions that are bilinear on the base and linear on the triangles, so that they fit
/// hexahedra and tetrahedra (G. Bedrosian, Shape functions and integration formulas for three-dimensional
/// finite element analysis, Int. J. Numer. Methods Eng. 35 (1992) 95–108; Code_Aster documentation R3.01.01).
/// On the square u = ξ/s, v = η/s, s = 1−ζ, to which each level of the pyramid is spread, they are
/// polynomials.
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

} // namespace

std::span<const ReferenceCell> pyra_cells() {
  static const std::array<Vector3d, 5> nodes{Vector3d(-1, -1, 0), Vector3d(1, -1, 0), Vector3d(1, 1, 0),
                                             Vector3d(-1, 1, 0), Vector3d(0, 0, 1)};
  static const std::array<ReferenceCell, 1> cells{{
      {CellType::pyra5, 3, 5, values5, gradients5, nullptr, nodes, pyramid_of_degree, 2, 2},
  }};
  return cells;
}

} // namespace rubato::cell
