// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/nonlinear_cells.hpp"

#include <algorithm>
#include <limits>

namespace rubato::domain {

using Eigen::VectorXd;

/// Storage of one cell at a time.
struct NonlinearCells::Scratch {
  std::vector<double> displacement, force, tangent;
};

NonlinearCells::NonlinearCells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                               const SparseMatrix& pattern)
    : components_(dofs.components) {
  std::size_t state = 0;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    if (!bulk.is_constant(i))
      add_cell(mesh, dofs,
               {.index = bulk.cells[i],
                .group = group_of(bulk, i, mesh.type_of(bulk.cells[i])),
                .first_state = state});
    state += state_size(mesh, bulk, i);
  }
  find_places(pattern);
}

int NonlinearCells::group_of(const Bulk& bulk, std::size_t cell, CellType type) {
  const auto law = bulk.law_of_cell[cell];
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (law_of_group_[g] == law && groups_[g].kind.type == type)
      return static_cast<int>(g);
  const auto& behaviour = *bulk.behaviour(cell);
  const auto kind = kind_of(bulk, behaviour, type);
  const int remembered = element::state_size_of_cell(kind, material::state_size(behaviour.law));
  groups_.push_back({kind, behaviour.law, cell::topology(type).node_count, element::point_count(type),
                     static_cast<std::size_t>(remembered)});
  law_of_group_.push_back(law);
  return static_cast<int>(groups_.size()) - 1;
}

void NonlinearCells::add_cell(const mesh::Mesh& mesh, const DofMap& dofs, Cell cell) {
  const auto nodes = mesh.nodes_of(cell.index);
  cell.first_node = points_.size();
  cell.first_place = cells_.empty() ? 0 : cells_.back().first_place;
  if (!cells_.empty()) {
    const auto before =
        static_cast<std::size_t>(groups_[static_cast<std::size_t>(cells_.back().group)].nodes);
    cell.first_place += before * before;
  }
  cell.first_record = record_count_;
  record_count_ += static_cast<std::size_t>(groups_[static_cast<std::size_t>(cell.group)].points);
  for (const auto node : nodes) {
    points_.push_back(mesh.points[static_cast<std::size_t>(node)]);
    dofs_.push_back(dofs.dof(node, 0));
  }
  cells_.push_back(cell);
}

void NonlinearCells::find_places(const SparseMatrix& pattern) {
  for (const auto& cell : cells_) {
    const auto nodes = static_cast<std::size_t>(groups_[static_cast<std::size_t>(cell.group)].nodes);
    const auto dofs = std::span(dofs_).subspan(cell.first_node, nodes);
    for (const int column : dofs) {
      const int* begin = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column];
      const int* end = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column + 1];
      for (const int row : dofs)
        places_.push_back(static_cast<std::int32_t>(std::lower_bound(begin, end, row) - begin));
    }
  }
}

Failed NonlinearCells::add(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                           const Wanted& wanted) const {
  now.values = old.values; // of constant cells they stay
  now.mode_force = 0;
  if (wanted.records)
    now.records.resize(record_count_);
  else
    now.records.clear();
  Scratch scratch;
  for (const auto& cell : cells_) {
    const auto result = evaluate(cell, step, old, now, wanted, scratch);
    if (!result) {
      if (wanted.forces != nullptr)
        wanted.forces->setConstant(std::numeric_limits<double>::quiet_NaN());
      return CellFailure{result.failure, cell.index, result.point};
    }
    now.mode_force = std::max(now.mode_force, result.mode_force);
  }
  return {};
}

element::CellResult NonlinearCells::evaluate(const Cell& cell, const StepSpan& step,
                                             const QuadratureStates& old, QuadratureStates& now,
                                             const Wanted& wanted, Scratch& scratch) const {
  const auto& group = groups_[static_cast<std::size_t>(cell.group)];
  const auto nodes = static_cast<std::size_t>(group.nodes);
  const auto size = nodes * static_cast<std::size_t>(components_);
  const auto dofs = std::span(dofs_).subspan(cell.first_node, nodes);
  scratch.displacement.resize(size);
  scratch.force.resize(size);
  scratch.tangent.resize(wanted.tangent != nullptr ? size * size : 0);
  for (std::size_t n = 0; n < nodes; ++n)
    for (int a = 0; a < components_; ++a)
      scratch.displacement[n * static_cast<std::size_t>(components_) + static_cast<std::size_t>(a)] =
          step.u1[dofs[n] + a];
  element::CellOutput output{std::span(now.values).subspan(cell.first_state, group.state_size), scratch.force,
                             scratch.tangent};
  if (wanted.records)
    output.records =
        std::span(now.records).subspan(cell.first_record, static_cast<std::size_t>(group.points));
  const element::CellInput input{std::span(points_).subspan(cell.first_node, nodes),
                                 scratch.displacement,
                                 std::span(old.values).subspan(cell.first_state, group.state_size),
                                 {step.t1 - step.t0},
                                 {.force = old.mode_force}};
  const auto result = element::evaluate(group.kind, element::PointLaws(group.law), input, output);
  if (!result)
    return result;
  if (wanted.forces != nullptr)
    for (std::size_t n = 0; n < nodes; ++n)
      for (int a = 0; a < components_; ++a)
        (*wanted.forces)[dofs[n] + a] +=
            scratch.force[n * static_cast<std::size_t>(components_) + static_cast<std::size_t>(a)];
  if (wanted.tangent != nullptr)
    add_tangent(cell, scratch.tangent, *wanted.tangent);
  return result;
}

PlasticStep NonlinearCells::plastic_step(const QuadratureStates& old, const QuadratureStates& now) const {
  PlasticStep most;
  for (const auto& cell : cells_) {
    const auto& group = groups_[static_cast<std::size_t>(cell.group)];
    const auto size = static_cast<std::size_t>(material::state_size(group.law));
    const auto p = [&](const QuadratureStates& states, int point) {
      const auto first = cell.first_state + static_cast<std::size_t>(point) * size;
      return material::cumulated_plastic_strain(group.law, std::span(states.values).subspan(first, size));
    };
    for (int point = 0; size > 0 && point < group.points; ++point)
      if (const double growth = p(now, point) - p(old, point); growth > most.growth)
        most = {growth, cell.index};
  }
  return most;
}

void NonlinearCells::add_tangent(const Cell& cell, const std::vector<double>& tangent,
                                 SparseMatrix& matrix) const {
  const auto nodes = static_cast<std::size_t>(groups_[static_cast<std::size_t>(cell.group)].nodes);
  const auto d = static_cast<std::size_t>(components_);
  const auto* place = places_.data() + cell.first_place;
  for (std::size_t j = 0; j < nodes; ++j, place += nodes) {
    const int* outer = matrix.outerIndexPtr() + dofs_[cell.first_node + j];
    for (std::size_t b = 0; b < d; ++b) {
      double* const column = matrix.valuePtr() + outer[b];
      const double* source = tangent.data() + (j * d + b) * nodes * d;
      for (std::size_t i = 0; i < nodes; ++i, source += d)
        for (std::size_t a = 0; a < d; ++a)
          column[place[i] + static_cast<std::int32_t>(a)] += source[a];
    }
  }
}

} // namespace rubato::domain
