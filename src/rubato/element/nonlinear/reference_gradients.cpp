// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/element/nonlinear/reference_gradients.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/rules.hpp"
#include "rubato/cell/shape_table.hpp"

#include <array>
#include <stdexcept>
#include <string>

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

struct LowerOrder {
  explicit LowerOrder(CellType type)
      : rule(cell::gauss_rule(type, 2)), gradients(made(cell::reference_cell(type), rule)) {}

  cell::Rule rule;
  ReferenceGradients gradients;
};

const LowerOrder& lower_order(CellType type) {
  static const LowerOrder quad8(CellType::quad8), hexa20(CellType::hexa20);
  if (!has_lower_order_rule(type))
    throw std::invalid_argument(std::string(cell::topology(type).name) + " has no rule of lower order");
  return type == CellType::quad8 ? quad8 : hexa20;
}

} // namespace

bool has_lower_order_rule(CellType type) {
  return type == CellType::quad8 || type == CellType::hexa20;
}

std::span<const cell::QuadraturePoint> lower_order_rule(CellType type) {
  return lower_order(type).rule;
}

const ReferenceGradients& reference_gradients(CellType type, PointRule rule) {
  if (rule == PointRule::lower_order)
    return lower_order(type).gradients;
  static const Tables tables = every_table();
  return tables[static_cast<std::size_t>(cell::reference_cell(type).type)];
}

} // namespace rubato::element
