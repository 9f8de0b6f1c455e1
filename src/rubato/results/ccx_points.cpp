// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/ccx_points.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/rules.hpp"
#include "rubato/cell/shape_table.hpp"
#include "rubato/domain/recovery.hpp"
#include "rubato/element/lower_order.hpp"
#include "rubato/linalg/dense_decompositions.hpp"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace rubato::results {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Places = std::vector<Vector3d>;

Places places_in(std::span<const cell::QuadraturePoint> rule) {
  Places places;
  for (const auto& point : rule)
    places.push_back(point.xi);
  return places;
}

Places tetra_points(bool quadratic) {
  if (!quadratic)
    return {{0.25, 0.25, 0.25}};
  const double a = (5 - std::sqrt(5.0)) / 20;
  const double b = 1 - 3 * a;
  return {{a, a, a}, {b, a, a}, {a, b, a}, {a, a, b}};
}

/// Layers across the plane that the expanded solid has.
int layers_of(CellType type, bool reduced) {
  const auto& shape = cell::topology(type);
  if (shape.dimension != 2)
    return 1;
  if (shape.order == 1)
    return reduced && type == CellType::quad4 ? 1 : 2;
  return reduced && (type == CellType::quad8 || type == CellType::quad9) ? 2 : 3;
}

Places places_of(CellType type, bool reduced) {
  const auto& shape = cell::topology(type);
  const bool quadratic = shape.order == 2;
  const auto corners = cell::linear_type(type);
  switch (corners) {
  case CellType::hexa8:
  case CellType::quad4:
    return places_in(cell::gauss_rule(corners, shape.order + (reduced ? 0 : 1)));
  case CellType::penta6:
    return places_in(cell::gauss_rule(corners, quadratic ? 3 : 2));
  case CellType::tetra4:
    return tetra_points(quadratic);
  case CellType::tria3:
    return places_in(cell::gauss_rule(corners, quadratic ? 2 : 1));
  default:
    return places_in(cell::stiffness_rule(type));
  }
}

CcxPoints made_points(CellType type, bool reduced) {
  const auto places = places_of(type, reduced);
  const auto own = places_in(cell::stiffness_rule(type));
  std::vector<cell::QuadraturePoint> rule;
  for (const auto& place : places)
    rule.push_back({place, 1.0});
  const Eigen::MatrixXd corners = cell::tabulate(cell::linear_type(type), rule).values;
  CcxPoints points;
  points.layers = layers_of(type, reduced);
  points.from_nodes = cell::tabulate(type, rule).values;
  if (reduced && element::has_lower_order_rule(type)) {
    points.to_points = element::from_lower_order_points(type, cell::stiffness_rule(type)).transpose();
    points.from_points = linalg::pseudo_inverse(points.to_points);
    return points;
  }
  points.from_points = domain::extrapolation(type).topRows(corners.rows()).transpose() * corners;
  constexpr double same = 1e-9;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < own.size(); ++j)
      if ((places[i] - own[j]).norm() < same) {
        points.from_points.col(static_cast<Index>(i)).setZero();
        points.from_points(static_cast<Index>(j), static_cast<Index>(i)) = 1;
      }
  return points;
}

} // namespace

const CcxPoints& ccx_points(CellType type, bool reduced) {
  using PointTable = std::array<std::array<CcxPoints, 2>, cell_type_count>;
  static const PointTable table = [] {
    PointTable made;
    for (const auto& cell : cell::all_topologies())
      if (cell::has_reference_cell(cell.type))
        for (const bool reduced_one : {false, true})
          made[static_cast<std::size_t>(cell.type)][reduced_one ? 1 : 0] =
              made_points(cell.type, reduced_one);
    return made;
  }();
  return table[static_cast<std::size_t>(type)][reduced ? 1 : 0];
}

} // namespace rubato::results
