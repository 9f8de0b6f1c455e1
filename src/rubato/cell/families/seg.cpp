// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/families/building_blocks.hpp"
#include "rubato/cell/families/families.hpp"
#include "rubato/cell/rules.hpp"

#include <algorithm>

namespace rubato::cell {
namespace {

using Eigen::Vector3d;

template <auto line> void values(const Vector3d& xi, std::span<double> n) {
  std::ranges::copy(line(xi[0]).value, n.begin());
}

template <auto line> void gradients(const Vector3d& xi, std::span<double> dn) {
  std::ranges::copy(line(xi[0]).slope, dn.begin());
}

template <auto line> void hessians(const Vector3d& xi, std::span<double> ddn) {
  std::ranges::copy(line(xi[0]).curvature, ddn.begin());
}

} // namespace

std::span<const ReferenceCell> seg_cells() {
  static const std::array<Vector3d, 3> nodes{Vector3d(-1, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 0, 0)};
  static const std::array<ReferenceCell, 2> cells{{
      {CellType::seg2, 1, 2, values<linear_line>, gradients<linear_line>, hessians<linear_line>,
       std::span(nodes).first(2), segment_of_degree, 2, 2},
      {CellType::seg3, 1, 3, values<quadratic_line>, gradients<quadratic_line>, hessians<quadratic_line>,
       nodes, segment_of_degree, 4, 4},
  }};
  return cells;
}

} // namespace rubato::cell
