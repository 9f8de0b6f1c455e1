// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/nonlinear_cells.hpp"

#include "rubato/cell/wave_patterns.hpp"
#include "rubato/domain/behaviour.hpp"
#include "rubato/domain/followed_points.hpp"
#include "rubato/domain/undeformed.hpp"
#include "rubato/element/energy_momentum.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace rubato::domain {

using Eigen::VectorXd;

NonlinearCells::NonlinearCells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                               const Threads& threads)
    : components_(dofs.components) {
  add_cells(mesh, bulk, dofs, [&](std::size_t cell) { return !bulk.is_constant(cell); });
  deal_out(mesh, threads);
}

NonlinearCells::NonlinearCells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                               std::span<const std::size_t> cells, const Threads& threads)
    : components_(dofs.components) {
  add_cells(mesh, bulk, dofs, [&](std::size_t cell) { return std::ranges::binary_search(cells, cell); });
  deal_out(mesh, threads);
}

void NonlinearCells::deal_out(const mesh::Mesh& mesh, const Threads& threads) {
  std::vector<mesh::CellIndex> indices;
  indices.reserve(cells_.size());
  for (const auto& cell : cells_)
    indices.push_back(cell.index);
  shares_ = WorkShares(mesh, indices, threads);
  if (shares_.count() == 1)
    return;
  at_shared_node_.reserve(dofs_.size());
  for (const auto index : indices)
    for (const auto node : mesh.nodes_of(index))
      at_shared_node_.push_back(shares_.is_shared(node) ? 1 : 0);
}

namespace {

/// Whether a path has its points. What a law without memory takes is stored. Growth of stiffness needs
/// stresses of logarithmic strain.
bool is_followed(const Behaviour& behaviour) {
  return (has_linear_stress(behaviour.law) && (material::state_size(behaviour.law) > 0 ||
                                               behaviour.strain == element::StrainKind::logarithmic)) ||
         behaviour.expansion.has_value();
}

} // namespace

std::size_t followed_points(const Bulk& bulk, std::size_t cell, CellType type) {
  const auto* behaviour = bulk.behaviour(cell);
  if (bulk.is_constant(cell) || !is_followed(*behaviour))
    return 0;
  return static_cast<std::size_t>(element::point_count(kind_of(bulk, *behaviour, type)));
}

void NonlinearCells::add_cells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                               const std::function<bool(std::size_t)>& has) {
  std::size_t state = 0;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    if (!bulk.is_constant(i))
      note(kind_of(bulk, *bulk.behaviour(i), mesh.type_of(bulk.cells[i])));
    if (has(i))
      add_cell(mesh, dofs,
               {.index = bulk.cells[i],
                .place = i,
                .group = group_of(bulk, i, mesh.type_of(bulk.cells[i])),
                .first_state = state,
                .first_follow = followed_count_});
    state += state_size(mesh, bulk, i);
    followed_count_ += followed_points(bulk, i, mesh.type_of(bulk.cells[i]));
  }
}

void NonlinearCells::note(const element::CellKind& kind) {
  const bool is_finite = kind.strain != element::StrainKind::small;
  has_finite_strain_ = has_finite_strain_ || is_finite;
  has_own_scheme_ = has_own_scheme_ || is_finite || kind.hourglass.limit > 0;
}

int NonlinearCells::group_of(const Bulk& bulk, std::size_t cell, CellType type) {
  const auto law = bulk.law_of_cell[cell];
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (law_of_group_[g] == law && groups_[g].kind.type == type)
      return static_cast<int>(g);
  const auto& behaviour = *bulk.behaviour(cell);
  const auto kind = kind_of(bulk, behaviour, type);
  const int remembered = element::state_size_of_cell(kind, material::state_size(behaviour.law));
  auto undeformed = kind;
  undeformed.strain = element::StrainKind::small;
  undeformed.hourglass.limit = 0;
  groups_.push_back({kind, behaviour.law, cell::topology(type).node_count, element::point_count(kind),
                     static_cast<std::size_t>(remembered), is_followed(behaviour),
                     has_linear_stress(behaviour.law),
                     behaviour.expansion.value_or(material::FullExpansion::Zero()), undeformed,
                     first_tangent(behaviour.law), cell::shortest_waves(type)});
  law_of_group_.push_back(law);
  return static_cast<int>(groups_.size()) - 1;
}

void NonlinearCells::add_cell(const mesh::Mesh& mesh, const DofMap& dofs, Cell cell) {
  const auto nodes = mesh.nodes_of(cell.index);
  cell.first_node = points_.size();
  cell.first_place = cells_.empty() ? 0 : cells_.back().first_place;
  if (!cells_.empty()) {
    const auto before = static_cast<std::size_t>(group_of(cells_.back()).nodes);
    cell.first_place += before * before;
  }
  const auto& group = group_of(cell);
  cell.first_record = record_count_;
  record_count_ += static_cast<std::size_t>(group.points);
  own_states_ += group.state_size;
  for (const auto node : nodes) {
    points_.push_back(mesh.points[static_cast<std::size_t>(node)]);
    dofs_.push_back(dofs.dof(node, 0));
  }
  cells_.push_back(cell);
}

void NonlinearCells::find_places(const SparseMatrix& pattern) {
  for (const auto& cell : cells_) {
    const auto nodes = static_cast<std::size_t>(group_of(cell).nodes);
    const auto dofs = std::span(dofs_).subspan(cell.first_node, nodes);
    for (const int column : dofs) {
      const int* begin = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column];
      const int* end = pattern.innerIndexPtr() + pattern.outerIndexPtr()[column + 1];
      for (const int row : dofs)
        places_.push_back(static_cast<std::int32_t>(std::lower_bound(begin, end, row) - begin));
    }
  }
}

double NonlinearCells::hourglass_energy(const VectorXd& u) const {
  std::vector<double> displacement;
  double sum = 0;
  for (const auto& cell : cells_) {
    const auto& group = group_of(cell);
    if (group.kind.formulation != element::Formulation::reduced)
      continue;
    gather(cell, u, displacement);
    sum += element::hourglass_energy(
        group.kind, std::span(points_).subspan(cell.first_node, static_cast<std::size_t>(group.nodes)),
        displacement);
  }
  return sum;
}

void NonlinearCells::gather(const Cell& cell, const VectorXd& u, std::vector<double>& values) const {
  const auto nodes = static_cast<std::size_t>(group_of(cell).nodes);
  const auto d = static_cast<std::size_t>(components_);
  values.resize(nodes * d);
  const int* first = dofs_.data() + cell.first_node;
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t a = 0; a < d; ++a)
      values[n * d + a] = u[first[n] + static_cast<int>(a)];
}

element::CellResult NonlinearCells::evaluate(const Cell& cell, const StepSpan& step,
                                             const QuadratureStates& old, QuadratureStates& now,
                                             const Wanted& wanted, Scratch& scratch) const {
  const auto& group = group_of(cell);
  const auto nodes = static_cast<std::size_t>(group.nodes);
  const auto points = static_cast<std::size_t>(group.points);
  gather(cell, step.u1, scratch.displacement);
  const auto size = scratch.displacement.size();
  scratch.force.resize(size);
  scratch.tangent.resize(wanted.tangent != nullptr ? size * size : 0);
  element::CellOutput output{std::span(now.values).subspan(cell.first_state, group.state_size), scratch.force,
                             scratch.tangent};
  scratch.records.resize(points);
  if (wanted.records)
    output.records = std::span(now.records).subspan(cell.first_record, points);
  else if (wanted.path != nullptr && group.followed)
    output.records = scratch.records;
  const element::CellInput input{std::span(points_).subspan(cell.first_node, nodes),
                                 scratch.displacement,
                                 std::span(old.values).subspan(cell.first_state, group.state_size),
                                 {step.t1 - step.t0},
                                 {.force = old.mode_force},
                                 scratch.free};
  return element::evaluate(group.kind, element::PointLaws(group.law), input, output);
}

element::CellResult NonlinearCells::evaluate_between(const Cell& cell, const StepSpan& step,
                                                     const QuadratureStates& old, QuadratureStates& now,
                                                     const Wanted& wanted, Scratch& scratch) const {
  const auto& group = group_of(cell);
  gather(cell, step.u0, scratch.before);
  gather(cell, step.u1, scratch.displacement);
  const auto size = scratch.displacement.size();
  scratch.force.resize(size);
  scratch.tangent.resize(wanted.tangent != nullptr ? size * size : 0);
  element::BetweenOutput output{std::span(now.values).subspan(cell.first_state, group.state_size),
                                scratch.force};
  (wanted.tangent_of == TangentOf::exact ? output.exact_tangent : output.tangent) = scratch.tangent;
  if (wanted.records)
    output.records =
        std::span(now.records).subspan(cell.first_record, static_cast<std::size_t>(group.points));
  constexpr double exact = 1e-13; // what is left of forces on the modes works, and is stored nowhere
  const element::BetweenInput input{
      std::span(points_).subspan(cell.first_node, static_cast<std::size_t>(group.nodes)),
      scratch.before,
      scratch.displacement,
      std::span(old.values).subspan(cell.first_state, group.state_size),
      {step.t1 - step.t0},
      {.relative = exact, .force = old.mode_force}};
  const auto result = element::evaluate_between(group.kind, element::PointLaws(group.law), input, output);
  for (double& entry : scratch.tangent)
    entry *= 2;
  return result.after;
}

PlasticStep NonlinearCells::plastic_step(const QuadratureStates& old, const QuadratureStates& now) const {
  PlasticStep most;
  for (const auto& cell : cells_) {
    const auto& group = group_of(cell);
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

Balance NonlinearCells::balance(const QuadratureStates& old, const QuadratureStates& now) const {
  require_records(old);
  require_records(now);
  std::vector<Balance> parts(cells_.size());
  shares_.each([&](int, std::size_t i) {
    const auto& cell = cells_[i];
    const auto& group = group_of(cell);
    add_balance(group.law, group.kind.strain, end_of(cell, old), end_of(cell, now), parts[i]);
  });
  Balance sum;
  for (const auto& part : parts)
    domain::add(part, sum);
  return sum;
}

double NonlinearCells::back_stress_energy(const QuadratureStates& states) const {
  require_records(states);
  double sum = 0;
  for (const auto& cell : cells_)
    sum += domain::back_stress_energy(group_of(cell).law, end_of(cell, states));
  return sum;
}

CellEnd NonlinearCells::end_of(const Cell& cell, const QuadratureStates& states) const {
  const auto& group = group_of(cell);
  const auto states_of_cell = std::span(states.values).subspan(cell.first_state, group.state_size);
  if (states.records.empty())
    return {{}, states_of_cell};
  return {std::span(states.records).subspan(cell.first_record, static_cast<std::size_t>(group.points)),
          states_of_cell};
}

void NonlinearCells::require_records(const QuadratureStates& states) const {
  if (states.records.size() != record_count_)
    throw std::invalid_argument("the balance of energy needs the records of both ends of a step");
}

} // namespace rubato::domain
