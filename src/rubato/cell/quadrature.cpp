// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/cell/quadrature.hpp"

#include "rubato/cell/parts.hpp"
#include "rubato/cell/reference_cell.hpp"
#include "rubato/cell/rules.hpp"

#include <array>
#include <stdexcept>
#include <string>

namespace rubato::cell {
namespace {

using RuleTable = std::array<Rule, cell_type_count>;

RuleTable every_rule(int ReferenceCell::*degree) {
  RuleTable table;
  for (const auto& shape : cell::all_topologies())
    if (has_reference_cell(shape.type)) {
      const auto& cell = reference_cell(shape.type);
      table[static_cast<std::size_t>(cell.type)] = cell.rule_of_degree(cell.*degree);
    }
  return table;
}

std::span<const QuadraturePoint> rule_in(const RuleTable& table, CellType type) {
  return table[static_cast<std::size_t>(reference_cell(type).type)];
}

} // namespace

Rule rule_of_degree(CellType type, int degree) {
  if (degree < 0)
    throw std::invalid_argument("a quadrature rule needs a degree of at least 0");
  return reference_cell(type).rule_of_degree(degree);
}

Rule gauss_rule(CellType type, int n) {
  if (n < 1)
    throw std::invalid_argument("a Gauss rule needs at least one point");
  switch (linear_type(type)) {
  case CellType::seg2:
    return line_rule(n);
  case CellType::quad4:
    return square_rule(n);
  case CellType::hexa8:
    return cube_rule(n);
  case CellType::tria3:
    return triangle_rule(n);
  case CellType::penta6:
    return prism_rule(triangle_rule(n - 1), n);
  default:
    throw std::invalid_argument("no Gauss points a direction on cells of type " +
                                std::string(cell::topology(type).name));
  }
}

std::span<const QuadraturePoint> stiffness_rule(CellType type) {
  static const RuleTable table = every_rule(&ReferenceCell::stiffness_degree);
  return rule_in(table, type);
}

std::span<const QuadraturePoint> mass_rule(CellType type) {
  static const RuleTable table = every_rule(&ReferenceCell::mass_degree);
  return rule_in(table, type);
}

} // namespace rubato::cell
