// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/shape_table.hpp"

#include "rubato/cell/reference_cell.hpp"

#include <array>

namespace rubato::cell {
namespace {

using Tables = std::array<ShapeTable, cell_type_count>;

Tables every_table(std::span<const QuadraturePoint> (*rule)(CellType)) {
  Tables tables;
  for (const auto& cell : cell::all_topologies())
    if (has_reference_cell(cell.type))
      tables[static_cast<std::size_t>(cell.type)] = tabulate(cell.type, rule(cell.type));
  return tables;
}

const ShapeTable& table_in(const Tables& tables, CellType type) {
  return tables[static_cast<std::size_t>(reference_cell(type).type)];
}

} // namespace

ShapeTable tabulate(CellType type, std::span<const QuadraturePoint> rule) {
  const auto& cell = reference_cell(type);
  const auto points = static_cast<Eigen::Index>(rule.size());
  ShapeTable table{Eigen::VectorXd(points), Eigen::MatrixXd(cell.node_count, points),
                   Eigen::MatrixXd(cell.node_count * cell.dimension, points)};
  for (Eigen::Index q = 0; q < points; ++q) {
    const auto& [xi, weight] = rule[static_cast<std::size_t>(q)];
    table.weights[q] = weight;
    cell.values(xi, {table.values.col(q).data(), static_cast<std::size_t>(table.values.rows())});
    cell.gradients(xi, {table.gradients.col(q).data(), static_cast<std::size_t>(table.gradients.rows())});
  }
  return table;
}

const ShapeTable& stiffness_table(CellType type) {
  static const Tables tables = every_table(stiffness_rule);
  return table_in(tables, type);
}

const ShapeTable& mass_table(CellType type) {
  static const Tables tables = every_table(mass_rule);
  return table_in(tables, type);
}

} // namespace rubato::cell
