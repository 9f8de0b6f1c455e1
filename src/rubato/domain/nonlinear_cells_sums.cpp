// SPDX-License-Identifier: LGPL-3.0-or-later
// Forces and tangents of cells, and what these add to the whole.
#include "rubato/domain/nonlinear_cells.hpp"
#include "rubato/domain/path_part.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace rubato::domain {

using Eigen::VectorXd;

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

/// What one share is busy with, and what it leaves until all are done.
struct NonlinearCells::Share {
  Scratch scratch;
  std::optional<CellFailure> failed;
  std::size_t failed_cell = 0;
  double mode_force = 0;
};

/// What border cells have for nodes of several shares, and every cell for the path: added when all shares are
/// done, in the order of cells.
struct NonlinearCells::Kept {
  std::vector<std::vector<double>> forces, tangents; ///< one a border cell
  std::vector<PathPart> parts;                       ///< one a cell
};

Failed NonlinearCells::add_each(const StepSpan& step, const QuadratureStates& old, QuadratureStates& now,
                                const Wanted& wanted, const Heat* heat) const {
  std::vector<Share> shares(static_cast<std::size_t>(shares_.count()));
  if (heat != nullptr)
    shares.front().scratch.temperatures = heat->temperatures(step.t1);
  for (std::size_t s = 1; s < shares.size(); ++s)
    shares[s].scratch.temperatures = shares.front().scratch.temperatures;
  auto kept = room_for_kept(wanted);
  shares_.each([&](int s, std::size_t i) {
    if (auto& share = shares[static_cast<std::size_t>(s)]; !share.failed)
      add_cell(i, step, old, now, wanted, heat, share, kept);
  });
  if (const auto failed = first_failure(shares)) {
    if (wanted.forces != nullptr)
      wanted.forces->setConstant(std::numeric_limits<double>::quiet_NaN());
    return failed;
  }
  for (const auto& share : shares)
    now.mode_force = std::max(now.mode_force, share.mode_force);
  add_kept(kept, wanted);
  return {};
}

NonlinearCells::Kept NonlinearCells::room_for_kept(const Wanted& wanted) const {
  Kept kept;
  if (shares_.count() == 1)
    return kept;
  if (wanted.forces != nullptr)
    kept.forces.resize(shares_.border().size());
  if (wanted.tangent != nullptr)
    kept.tangents.resize(shares_.border().size());
  if (wanted.path != nullptr)
    kept.parts.resize(cells_.size());
  return kept;
}

Failed NonlinearCells::first_failure(std::span<const Share> shares) {
  const Share* first = nullptr;
  for (const auto& share : shares)
    if (share.failed && (first == nullptr || share.failed_cell < first->failed_cell))
      first = &share;
  return first == nullptr ? Failed() : first->failed;
}

void NonlinearCells::add_cell(std::size_t i, const StepSpan& step, const QuadratureStates& old,
                              QuadratureStates& now, const Wanted& wanted, const Heat* heat, Share& share,
                              Kept& kept) const {
  const auto& cell = cells_[i];
  auto& scratch = share.scratch;
  if (heat != nullptr)
    heat->put_free_strains(cell.place, scratch.temperatures, group_of(cell).expansion, scratch.free);
  const auto result = step.of == ForcesOf::step ? evaluate_between(cell, step, old, now, wanted, scratch)
                                                : evaluate(cell, step, old, now, wanted, scratch);
  if (!result) {
    share.failed = CellFailure{result.failure, cell.index, result.point};
    share.failed_cell = i;
    return;
  }
  share.mode_force = std::max(share.mode_force, result.mode_force);
  add_answers(i, wanted, scratch, kept);
  if (wanted.path == nullptr)
    return;
  const auto part = go_along(cell, old, now, result, scratch, *wanted.path);
  if (kept.parts.empty())
    domain::add(part, *wanted.path);
  else
    kept.parts[i] = part;
}

void NonlinearCells::add_answers(std::size_t i, const Wanted& wanted, const Scratch& scratch,
                                 Kept& kept) const {
  const auto border = shares_.place_in_border(i);
  const auto nodes = border < 0 ? Nodes::all : Nodes::own;
  if (wanted.forces != nullptr)
    scatter(cells_[i], scratch.force, nodes, *wanted.forces);
  if (wanted.tangent != nullptr)
    add_tangent(cells_[i], scratch.tangent, nodes, *wanted.tangent);
  if (border < 0)
    return;
  if (wanted.forces != nullptr)
    kept.forces[static_cast<std::size_t>(border)] = scratch.force;
  if (wanted.tangent != nullptr)
    kept.tangents[static_cast<std::size_t>(border)] = scratch.tangent;
}

void NonlinearCells::add_kept(const Kept& kept, const Wanted& wanted) const {
  for (std::size_t b = 0; b < kept.forces.size(); ++b)
    scatter(cells_[shares_.border()[b]], kept.forces[b], Nodes::shared, *wanted.forces);
  for (std::size_t b = 0; b < kept.tangents.size(); ++b)
    add_tangent(cells_[shares_.border()[b]], kept.tangents[b], Nodes::shared, *wanted.tangent);
  for (const auto& part : kept.parts)
    domain::add(part, *wanted.path);
}

void NonlinearCells::add_initial_product(const VectorXd& x, VectorXd& y) const {
  const Wanted wanted{.forces = &y};
  std::vector<Scratch> scratches(static_cast<std::size_t>(shares_.count()));
  auto kept = room_for_kept(wanted);
  shares_.each([&](int s, std::size_t i) {
    auto& scratch = scratches[static_cast<std::size_t>(s)];
    const auto& cell = cells_[i];
    const auto& group = group_of(cell);
    gather(cell, x, scratch.displacement);
    scratch.force.resize(scratch.displacement.size());
    const auto modes = static_cast<std::size_t>(element::mode_count(group.undeformed));
    scratch.states.assign(2 * modes, 0.0);
    const std::span states(scratch.states);
    const element::CellInput input{
        std::span(points_).subspan(cell.first_node, static_cast<std::size_t>(group.nodes)),
        scratch.displacement, states.first(modes)};
    element::evaluate(group.undeformed, element::PointLaws(group.first), input,
                      {states.last(modes), scratch.force, {}});
    add_answers(i, wanted, scratch, kept);
  });
  add_kept(kept, wanted);
}

/// Whether nodes of a cell, counted as those of all cells are, take part.
bool NonlinearCells::takes_part(std::size_t node, Nodes nodes) const {
  return nodes == Nodes::all || (at_shared_node_[node] != 0) == (nodes == Nodes::shared);
}

void NonlinearCells::scatter(const Cell& cell, const std::vector<double>& values, Nodes which,
                             VectorXd& sum) const {
  const auto nodes = static_cast<std::size_t>(group_of(cell).nodes);
  const auto d = static_cast<std::size_t>(components_);
  const int* first = dofs_.data() + cell.first_node;
  for (std::size_t n = 0; n < nodes; ++n) {
    if (!takes_part(cell.first_node + n, which))
      continue;
    for (std::size_t a = 0; a < d; ++a)
      sum[first[n] + static_cast<int>(a)] += values[n * d + a];
  }
}

void NonlinearCells::add_tangent(const Cell& cell, const std::vector<double>& tangent, Nodes which,
                                 SparseMatrix& matrix) const {
  const auto nodes = static_cast<std::size_t>(group_of(cell).nodes);
  const auto d = static_cast<std::size_t>(components_);
  const auto* place = places_.data() + cell.first_place;
  for (std::size_t j = 0; j < nodes; ++j, place += nodes) {
    if (!takes_part(cell.first_node + j, which))
      continue;
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

PathPart NonlinearCells::go_along(const Cell& cell, const QuadratureStates& old, const QuadratureStates& now,
                                  const element::CellResult& result, const Scratch& scratch,
                                  LawPath& path) const {
  const auto& group = group_of(cell);
  PathPart part;
  part.stored = result.stored + result.hourglass;
  part.elsewhere = result.hourglass;
  if (!group.followed || !group.stress_is_linear)
    part.elsewhere += result.stored;
  if (!group.followed)
    return part;
  const auto points = static_cast<std::size_t>(group.points);
  auto end = end_of(cell, now);
  if (now.records.empty())
    end.records = scratch.records;
  domain::go_along(group.law, end, std::span(old.values).subspan(cell.first_state, group.state_size),
                   std::span(path.points).subspan(cell.first_follow, points), part);
  return part;
}

} // namespace rubato::domain
