// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/bulk.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/core/error.hpp"
#include "rubato/domain/behaviour.hpp"
#include "rubato/domain/undeformed.hpp"
#include "rubato/element/lower_order.hpp"
#include "rubato/mesh/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace rubato::domain {
namespace {

/// The mean of its nodes.
std::string middle_of(const mesh::Mesh& mesh, mesh::CellIndex cell) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  const auto nodes = mesh.nodes_of(cell);
  for (const auto node : nodes)
    middle += mesh.points[static_cast<std::size_t>(node)] / static_cast<double>(nodes.size());
  return mesh.dimension == 2 ? fmt::format("({:.6g}, {:.6g})", middle[0], middle[1])
                             : fmt::format("({:.6g}, {:.6g}, {:.6g})", middle[0], middle[1], middle[2]);
}

} // namespace

bool Bulk::is_constant(std::size_t i) const {
  const auto* found = behaviour(i);
  return found == nullptr || found->constant;
}

bool is_linear(const Bulk& bulk) {
  for (std::size_t i = 0; i < bulk.cells.size(); ++i)
    if (!bulk.is_constant(i))
      return false;
  return true;
}

element::CellKind kind_of(const Bulk& bulk, const Behaviour& behaviour, CellType type) {
  element::CellKind kind{type, bulk.section, behaviour.strain, behaviour.formulation};
  if (kind.formulation == element::Formulation::reduced && element::has_lower_order_rule(type))
    kind.formulation = element::Formulation::lower_order;
  if (!element::is_offered(kind))
    kind.formulation = element::Formulation::full;
  if (kind.formulation == element::Formulation::reduced)
    kind.hourglass = hourglass_control(behaviour.law, bulk.section.physics);
  return kind;
}

std::string cell_label(const mesh::Mesh& mesh, mesh::CellIndex cell) {
  return fmt::format("cell {} ({}) at {}", mesh::cell_name(mesh, cell),
                     cell::topology(mesh.type_of(cell)).name, middle_of(mesh, cell));
}

namespace {

/// Empty when the cell is sound.
std::string fault_of(const mesh::Mesh& mesh, mesh::CellIndex cell_index, study::Physics physics) {
  const auto type = mesh.type_of(cell_index);
  if (!cell::has_reference_cell(type))
    return "is of a type that has no mechanics";
  const int dimension = element::component_count(physics);
  if (cell::topology(type).dimension != dimension)
    return fmt::format("is not of dimension {}, which the physics asks for", dimension);
  const CellPoints cell(mesh, mesh.nodes_of(cell_index));
  const std::span<const Eigen::Vector3d> points = cell;
  const double jacobian = element::worst_jacobian(type, points);
  if (!(jacobian > 0))
    return fmt::format(
        "is inverted or degenerate: its Jacobian determinant falls to {:.3g}, it must be positive", jacobian);
  const auto left_of_axis = [](const Eigen::Vector3d& x) { return x[0] < 0; };
  if (physics == study::Physics::axisymmetric && std::ranges::any_of(points, left_of_axis))
    return "has a node of negative x, which is the radius in axisymmetric physics";
  return {};
}

} // namespace

std::vector<Fault> cell_faults(const mesh::Mesh& mesh, std::span<const mesh::CellIndex> cells,
                               study::Physics physics) {
  std::vector<Fault> faults;
  for (const auto cell : cells)
    if (const auto text = fault_of(mesh, cell, physics); !text.empty())
      faults.emplace_back().text = cell_label(mesh, cell) + " " + text;
  return faults;
}

} // namespace rubato::domain
