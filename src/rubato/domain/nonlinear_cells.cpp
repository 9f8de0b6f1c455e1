// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/domain/nonlinear_cells.hpp"

#include "rubato/cell/wave_patterns.hpp"
#include "rubato/domain/undeformed.hpp"
#include "rubato/element/energy_momentum.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace rubato::domain {

using Eigen::VectorXd;

NonlinearCells::NonlinearCells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs)
    : components_(dofs.components) {
  add_cells(mesh, bulk, dofs, [&](std::size_t cell) { return !bulk.is_constant(cell); });
}

NonlinearCells::NonlinearCells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                               std::span<const std::size_t> cells)
    : components_(dofs.components) {
  add_cells(mesh, bulk, dofs, [&](std::size_t cell) { return std::ranges::binary_search(cells, cell); });
}

void NonlinearCells::add_cells(const mesh::Mesh& mesh, const Bulk& bulk, const DofMap& dofs,
                               const std::function<bool(std::size_t)>& has) {
  std::size_t state = 0;
  for (std::size_t i = 0; i < bulk.cells.size(); ++i) {
    if (has(i))
      add_cell(mesh, dofs,
               {.index = bulk.cells[i],
                .place = i,
                .group = group_of(bulk, i, mesh.type_of(bulk.cells[i])),
                .first_state = state});
    state += state_size(mesh, bulk, i);
  }
}

namespace {

/// What a law without memory takes is stored. Growth of stiffness needs stresses of logarithmic strain.
bool is_followed(const Behaviour& behaviour) {
  return has_linear_stress(behaviour.law) &&
         (material::state_size(behaviour.law) > 0 || behaviour.strain == element::StrainKind::logarithmic);
}

} // namespace

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
  groups_.push_back(
      {kind, behaviour.law, cell::topology(type).node_count, element::point_count(kind),
       static_cast<std::size_t>(remembered), is_followed(behaviour) || behaviour.expansion.has_value(),
       has_linear_stress(behaviour.law), behaviour.expansion.value_or(material::FullExpansion::Zero()),
       undeformed, first_tangent(behaviour.law), cell::shortest_waves(type)});
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
  cell.first_follow = followed_count_;
  followed_count_ += group.followed ? static_cast<std::size_t>(group.points) : 0;
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

bool NonlinearCells::has_own_scheme() const {
  return has_finite_strain() ||
         std::ranges::any_of(groups_, [](const Group& group) { return group.kind.hourglass.limit > 0; });
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

bool NonlinearCells::has_finite_strain() const {
  return std::ranges::any_of(
      groups_, [](const Group& group) { return group.kind.strain != element::StrainKind::small; });
}

Failed NonlinearCells::add(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                           const Wanted& wanted, const Heat* heat) const {
  if (own_states_ < old.values.size()) // of constant cells they stay
    now.values = old.values;
  else
    now.values.resize(old.values.size());
  now.mode_force = 0;
  if (wanted.records)
    now.records.resize(record_count_);
  else
    now.records.clear();
  if (wanted.path == nullptr)
    return add_each(step, old, now, wanted, heat);
  auto& path = *wanted.path;
  path.points.resize(followed_count_);
  path.forces.setZero(step.u1.size());
  path.taken = {};
  path.stored = 0;
  path.law_work = -std::exchange(path.elsewhere, 0);
  auto by_cells = wanted;
  by_cells.forces = &path.forces;
  const auto failed = add_each(step, old, now, by_cells, heat);
  path.law_work += path.elsewhere;
  if (wanted.forces != nullptr)
    *wanted.forces += path.forces;
  return failed;
}

Failed NonlinearCells::add_each(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                                const Wanted& wanted, const Heat* heat) const {
  Scratch scratch;
  if (heat != nullptr)
    scratch.temperatures = heat->temperatures(step.t1);
  for (const auto& cell : cells_) {
    if (heat != nullptr)
      heat->put_free_strains(cell.place, scratch.temperatures, group_of(cell).expansion, scratch.free);
    const auto result = step.of == ForcesOf::step ? evaluate_between(cell, step, old, now, wanted, scratch)
                                                  : evaluate(cell, step, old, now, wanted, scratch);
    if (!result) {
      if (wanted.forces != nullptr)
        wanted.forces->setConstant(std::numeric_limits<double>::quiet_NaN());
      return CellFailure{result.failure, cell.index, result.point};
    }
    now.mode_force = std::max(now.mode_force, result.mode_force);
    if (wanted.path != nullptr)
      go_along(cell, old, now, result, scratch, *wanted.path);
  }
  return {};
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
  const auto result = element::evaluate(group.kind, element::PointLaws(group.law), input, output);
  if (result)
    add_answers(cell, wanted, scratch);
  return result;
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
  if (result)
    add_answers(cell, wanted, scratch);
  return result.after;
}

void NonlinearCells::add_answers(const Cell& cell, const Wanted& wanted, const Scratch& scratch) const {
  if (wanted.forces != nullptr)
    scatter(cell, scratch.force, *wanted.forces);
  if (wanted.tangent != nullptr)
    add_tangent(cell, scratch.tangent, *wanted.tangent);
}

void NonlinearCells::scatter(const Cell& cell, const std::vector<double>& values, VectorXd& sum) const {
  const auto nodes = static_cast<std::size_t>(group_of(cell).nodes);
  const auto d = static_cast<std::size_t>(components_);
  const int* first = dofs_.data() + cell.first_node;
  for (std::size_t n = 0; n < nodes; ++n)
    for (std::size_t a = 0; a < d; ++a)
      sum[first[n] + static_cast<int>(a)] += values[n * d + a];
}

void NonlinearCells::go_along(const Cell& cell, const QuadratureStates& old, const QuadratureStates& now,
                              const element::CellResult& result, const Scratch& scratch,
                              LawPath& path) const {
  path.stored += result.stored + result.hourglass;
  path.elsewhere += result.hourglass;
  const auto& group = group_of(cell);
  if (!group.followed || !group.stress_is_linear)
    path.elsewhere += result.stored;
  if (!group.followed)
    return;
  const auto points = static_cast<std::size_t>(group.points);
  auto end = end_of(cell, now);
  if (now.records.empty())
    end.records = scratch.records;
  domain::go_along(group.law, end, std::span(old.values).subspan(cell.first_state, group.state_size),
                   std::span(path.points).subspan(cell.first_follow, points), path);
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
  Balance sum;
  for (const auto& cell : cells_) {
    const auto& group = group_of(cell);
    add_balance(group.law, group.kind.strain, end_of(cell, old), end_of(cell, now), sum);
  }
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

void NonlinearCells::add_tangent(const Cell& cell, const std::vector<double>& tangent,
                                 SparseMatrix& matrix) const {
  const auto nodes = static_cast<std::size_t>(group_of(cell).nodes);
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
