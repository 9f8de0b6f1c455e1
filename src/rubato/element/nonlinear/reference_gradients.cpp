// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/reference_gradients.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/rules.hpp"
#include "rubato/cell/shape_table.hpp"
#include "rubato/linalg/dense_decompositions.hpp"
#include "rubato/linalg/dense_products.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace rubato::element {
namespace {

using Eigen::Index;

/// Gradients of one point, numbered as ShapeTable has them, as nodes × dimension.
Eigen::MatrixXd by_node(const Eigen::MatrixXd& gradients, Index q, int dimension) {
  return gradients.col(q).reshaped(dimension, gradients.rows() / dimension).transpose();
}

void add_centre(const cell::ReferenceCell& cell, ReferenceGradients& reference) {
  const std::array centre{cell::QuadraturePoint{Eigen::Vector3d::Zero(), 1}};
  const auto table = cell::tabulate(cell.type, centre);
  reference.centre = by_node(table.gradients, 0, cell.dimension);
  reference.centre_values = table.values;
}

ReferenceGradients made(const cell::ReferenceCell& cell, std::span<const cell::QuadraturePoint> rule) {
  const auto table = cell::tabulate(cell.type, rule);
  const auto points = static_cast<Index>(rule.size());
  ReferenceGradients reference{cell.node_count, static_cast<int>(points), table.weights, {}, {}, {}, {}, {}};
  reference.values.setZero(even(cell.node_count), points);
  reference.values.topRows(cell.node_count) = table.values;
  reference.gradients.setZero(even(cell.node_count), points * cell.dimension);
  reference.xi.resize(3, points);
  for (Index q = 0; q < points; ++q) {
    reference.gradients.block(0, q * cell.dimension, cell.node_count, cell.dimension) =
        by_node(table.gradients, q, cell.dimension);
    reference.xi.col(q) = rule[static_cast<std::size_t>(q)].xi;
  }
  add_centre(cell, reference);
  return reference;
}

using Tables = std::array<ReferenceGradients, cell_type_count>;

Tables every_table() {
  Tables tables;
  for (const auto& cell : cell::all_topologies())
    if (cell::has_reference_cell(cell.type))
      tables[static_cast<std::size_t>(cell.type)] =
          made(cell::reference_cell(cell.type), cell::stiffness_rule(cell.type));
  return tables;
}

/// Gauss points along the edges of a cell of lower order; along the axis of a prism.
struct EdgePoints {
  CellType type;
  int count;
};
constexpr std::array edge_points{EdgePoints{CellType::quad8, 2}, EdgePoints{CellType::hexa20, 2},
                                 EdgePoints{CellType::penta6, 2}, EdgePoints{CellType::penta15, 3}};

/// Powers of the reference coordinates up to which functions through the points go: in a triangle x and y
/// have no product.
Eigen::MatrixXd powers_at(CellType type, std::span<const cell::QuadraturePoint> places) {
  const bool prism = cell::topology(type).corner_count == 6, solid = cell::topology(type).dimension == 3;
  const int across = type == CellType::penta6 ? 0 : 1,
            along = solid ? (type == CellType::penta15 ? 2 : 1) : 0;
  std::vector<std::array<int, 3>> powers;
  for (int z = 0; z <= along; ++z)
    for (int y = 0; y <= across; ++y)
      for (int x = 0; x <= across - (prism ? y : 0); ++x)
        powers.push_back({x, y, z});
  Eigen::MatrixXd values(static_cast<Index>(places.size()), static_cast<Index>(powers.size()));
  for (Index i = 0; i < values.rows(); ++i)
    for (Index k = 0; k < values.cols(); ++k) {
      const auto& xi = places[static_cast<std::size_t>(i)].xi;
      const auto& of = powers[static_cast<std::size_t>(k)];
      values(i, k) = std::pow(xi[0], of[0]) * std::pow(xi[1], of[1]) * std::pow(xi[2], of[2]);
    }
  return values;
}

struct LowerOrder {
  explicit LowerOrder(EdgePoints of)
      : type(of.type), rule(cell::gauss_rule(type, of.count)), table(cell::tabulate(type, rule)),
        gradients(made(cell::reference_cell(type), rule)) {}

  CellType type;
  cell::Rule rule;
  cell::ShapeTable table;
  ReferenceGradients gradients;
};

const LowerOrder& lower_order(CellType type) {
  static const std::vector<LowerOrder> all(edge_points.begin(), edge_points.end());
  const auto found = std::ranges::find(all, type, &LowerOrder::type);
  if (found == all.end())
    throw std::invalid_argument(std::string(cell::topology(type).name) + " has no rule of lower order");
  return *found;
}

} // namespace

bool has_lower_order_rule(CellType type) {
  return std::ranges::find(edge_points, type, &EdgePoints::type) != edge_points.end();
}

std::span<const cell::QuadraturePoint> lower_order_rule(CellType type) {
  return lower_order(type).rule;
}

Eigen::MatrixXd from_lower_order_points(CellType type, std::span<const cell::QuadraturePoint> places) {
  return linalg::product(powers_at(type, places),
                         linalg::pseudo_inverse(powers_at(type, lower_order_rule(type))));
}

const cell::ShapeTable& lower_order_table(CellType type) {
  return lower_order(type).table;
}

const ReferenceGradients& reference_gradients(CellType type, PointRule rule) {
  if (rule == PointRule::lower_order)
    return lower_order(type).gradients;
  static const Tables tables = every_table();
  return tables[static_cast<std::size_t>(cell::reference_cell(type).type)];
}

} // namespace rubato::element
