// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/cut.hpp"

#include "rubato/domain/behaviour.hpp"
#include "rubato/domain/cell_matrices.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace rubato::domain {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using mesh::NodeIndex;
using Entries = std::vector<Eigen::Triplet<double, int>>;

constexpr Index axes = 3;

using Force = std::array<double, 3>;

/// Adds what a force at a place does: force along and moment about each axis.
void add_effect(const Force& force, const double* arm, double* effect) {
  for (std::size_t a = 0; a < force.size(); ++a)
    effect[a] += force[a];
  effect[3] += arm[1] * force[2] - arm[2] * force[1];
  effect[4] += arm[2] * force[0] - arm[0] * force[2];
  effect[5] += arm[0] * force[1] - arm[1] * force[0];
}

/// Of the forces that the rows of a matrix of one cell give its dofs, those at nodes in the cut: force and
/// moment about `point`, a column each column of the matrix.
MatrixXd effects_of(const mesh::Mesh& mesh, Index components, std::span<const NodeIndex> nodes,
                    const std::vector<char>& in_cut, const Eigen::Vector3d& point, const MatrixXd& forces) {
  MatrixXd effects = MatrixXd::Zero(2 * axes, forces.cols());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    if (in_cut[static_cast<std::size_t>(nodes[n])] != 0) {
      const Eigen::Vector3d arm = mesh.points[static_cast<std::size_t>(nodes[n])] - point;
      for (Index j = 0; j < forces.cols(); ++j) {
        Force force{};
        for (Index a = 0; a < components; ++a)
          force[static_cast<std::size_t>(a)] = forces(static_cast<Index>(n) * components + a, j);
        add_effect(force, arm.data(), &effects(0, j));
      }
    }
  return effects;
}

void add_entries(const MatrixXd& effects, std::span<const int> columns, Entries& entries) {
  for (Index j = 0; j < effects.cols(); ++j)
    for (Index row = 0; row < effects.rows(); ++row)
      if (const double value = effects(row, j); value != 0)
        entries.emplace_back(static_cast<int>(row), columns[static_cast<std::size_t>(j)], value);
}

std::vector<CutForces::Node> arms_of(const mesh::Mesh& mesh, const DofMap& dofs,
                                     std::span<const NodeIndex> nodes, const Eigen::Vector3d& point) {
  std::vector<CutForces::Node> arms;
  for (const auto node : nodes)
    if (dofs.has(node))
      arms.push_back({dofs.dof(node, 0), mesh.points[static_cast<std::size_t>(node)] - point});
  return arms;
}

/// The cells that are evaluated, those that follow large turns apart from those that do not.
std::vector<CutForces::Evaluated> evaluated_cells(const mesh::Mesh& mesh, const Bulk& bulk,
                                                  const DofMap& dofs, std::span<const std::size_t> cells) {
  std::vector<CutForces::Evaluated> all;
  for (const bool large : {false, true}) {
    std::vector<std::size_t> chosen;
    for (const auto cell : cells)
      if (const auto* behaviour = bulk.behaviour(cell); !bulk.is_constant(cell))
        if ((behaviour->strain != element::StrainKind::small) == large)
          chosen.push_back(cell);
    std::ranges::sort(chosen);
    if (!chosen.empty())
      all.push_back({NonlinearCells(mesh, bulk, dofs, chosen), large});
  }
  return all;
}

Force at_node(const Eigen::VectorXd& values, const CutForces::Node& node, int components) {
  Force at{};
  for (int a = 0; a < components; ++a)
    at[static_cast<std::size_t>(a)] = values[node.first_dof + a];
  return at;
}

/// Force and moment of evaluated cells on the nodes of the cut.
Eigen::Matrix<double, 6, 1> evaluated_forces(const CutForces& cut, const CutForces::Evaluated& evaluated,
                                             const Eigen::VectorXd& u, HeatAt heat,
                                             const QuadratureStates& states) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(u.size());
  QuadratureStates unchanged;
  evaluated.cells.add({u, u, heat.t, heat.t}, states, unchanged, {.forces = &forces}, heat.heat);
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (const auto& node : cut.nodes) {
    const auto force = at_node(forces, node, cut.components);
    Eigen::Vector3d arm = node.arm;
    if (evaluated.at_deformed) {
      const auto moved = at_node(u, node, cut.components);
      for (std::size_t a = 0; a < moved.size(); ++a)
        arm[static_cast<Index>(a)] += moved[a];
    }
    add_effect(force, arm.data(), sum.data());
  }
  return sum;
}

std::vector<int> dofs_of(const DofMap& dofs, std::span<const NodeIndex> nodes) {
  std::vector<int> all;
  for (const auto node : nodes)
    for (int a = 0; a < dofs.components; ++a)
      all.push_back(dofs.dof(node, a));
  return all;
}

} // namespace

CutForces make_cut_forces(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                          std::span<const std::size_t> cells, std::span<const NodeIndex> nodes,
                          const Eigen::Vector3d& point, const Heat* heat) {
  std::vector<char> in_cut(mesh.points.size(), 0);
  for (const auto node : nodes)
    in_cut[static_cast<std::size_t>(node)] = 1;
  std::vector<std::size_t> at_cut;
  std::ranges::copy_if(cells, std::back_inserter(at_cut), [&](std::size_t cell) {
    return std::ranges::any_of(mesh.nodes_of(bulk.cells[cell]),
                               [&](NodeIndex n) { return in_cut[static_cast<std::size_t>(n)] != 0; });
  });
  Entries entries;
  Entries of_temperature;
  CutForces cut;
  const auto effects = [&](std::span<const NodeIndex> of_cell, const MatrixXd& forces) {
    return effects_of(mesh, dofs.components, of_cell, in_cut, point, forces);
  };
  for (const auto i : at_cut) {
    const auto of_cell = mesh.nodes_of(bulk.cells[i]);
    if (bulk.is_constant(i)) {
      const auto size = static_cast<Index>(of_cell.size()) * dofs.components;
      MatrixXd stiffness(size, size);
      cell_stiffness(bulk, i, mesh.type_of(bulk.cells[i]), CellPoints(mesh, of_cell), stiffness);
      add_entries(effects(of_cell, stiffness), dofs_of(dofs, of_cell), entries);
    }
    if (heat == nullptr || heat->expansion_of(i) == nullptr || !bulk.is_constant(i))
      continue;
    const auto of_heat = heat->cell_heat(mesh, bulk, i);
    add_entries(effects(of_cell, of_heat.force), heat->nodes_of(i), of_temperature);
    cut.of_reference += effects(of_cell, of_heat.reference_force);
  }
  cut.of_displacement.resize(2 * axes, dofs.dof_count);
  cut.of_displacement.setFromTriplets(entries.begin(), entries.end());
  if (heat != nullptr) {
    cut.of_temperature.resize(2 * axes, static_cast<Index>(dofs.nodes.size()));
    cut.of_temperature.setFromTriplets(of_temperature.begin(), of_temperature.end());
  }
  cut.components = dofs.components;
  cut.nodes = arms_of(mesh, dofs, nodes, point);
  cut.evaluated = evaluated_cells(mesh, bulk, dofs, at_cut);
  return cut;
}

Eigen::Matrix<double, 6, 1> forces_at(const CutForces& cut, const Eigen::VectorXd& u, HeatAt heat,
                                      const QuadratureStates* states) {
  Eigen::Matrix<double, 6, 1> forces = cut.of_displacement * u;
  if (heat.heat != nullptr)
    forces -= cut.of_temperature * heat.heat->temperatures(heat.t) - cut.of_reference;
  for (const auto& evaluated : cut.evaluated)
    forces += evaluated_forces(cut, evaluated, u, heat, *states);
  return forces;
}

} // namespace rubato::domain
