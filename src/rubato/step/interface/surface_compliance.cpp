// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/surface_compliance.hpp"

#include "rubato/linalg/column_sum.hpp"
#include "rubato/linalg/symmetric_product.hpp"
#include "rubato/step/interface/body_threads.hpp"

#include <algorithm>
#include <utility>

namespace rubato::step {
namespace {

using Eigen::Index;

/// Where more of a force than this is not zero, half of the whole matrix is read sooner than its columns.
constexpr double dense = 0.35;
/// Columns of smaller surfaces are near anyway.
constexpr Index smallest_dense = 64;

} // namespace

SurfaceCompliance::SurfaceCompliance(std::unique_ptr<linalg::SurfaceSolver> solver, Index largest_whole)
    : solver_(std::move(solver)), largest_whole_(solver_->has_dear_columns() ? 0 : largest_whole),
      known_(solver_->surface().size(), 0) {
  const auto& starts = solver_->body_starts();
  for (std::size_t b = 0; b + 1 < starts.size(); ++b)
    body_of_.insert(body_of_.end(), static_cast<std::size_t>(starts[b + 1] - starts[b]), static_cast<int>(b));
  s_.resize(starts.size() - 1);
  for (std::size_t b = 0; b < s_.size(); ++b)
    renewals_.push_back(solver_->renewals(b));
  blocks_.resize(starts.size() - 1);
  for (std::size_t b = 0; b + 1 < starts.size(); ++b)
    if (const auto* surface = solver_->surface_within(b); surface && !surface->is_formed_whole()) {
      blocks_[b].emplace(*surface);
      has_blocks_ = true;
    }
}

bool SurfaceCompliance::refactor(const linalg::SparseMatrix& matrix) {
  const bool factored = solver_->refactor(matrix);
  for (std::size_t b = 0; b < s_.size(); ++b)
    if (const auto renewals = solver_->renewals(b); renewals_[b] != renewals) {
      renewals_[b] = renewals;
      forget(b);
    }
  return factored;
}

/// With its memory: what is asked for next need not be the same columns.
void SurfaceCompliance::forget(std::size_t body) {
  const auto& starts = solver_->body_starts();
  std::fill(known_.begin() + starts[body], known_.begin() + starts[body + 1], 0);
  s_[body].resize(0, 0);
  if (blocks_[body])
    blocks_[body]->forget();
}

Eigen::MatrixXd SurfaceCompliance::between(std::span<const int> positions) {
  const auto size = static_cast<Index>(positions.size());
  Eigen::MatrixXd s = Eigen::MatrixXd::Zero(size, size);
  Eigen::MatrixXd s_of_body;
  for (std::size_t b = 0; b < s_.size(); ++b) {
    std::vector<Index> chosen;
    std::vector<int> of_body;
    for (Index i = 0; i < size; ++i)
      if (const int at = positions[static_cast<std::size_t>(i)]; body_of(at) == static_cast<int>(b)) {
        chosen.push_back(i);
        of_body.push_back(at);
      }
    if (of_body.empty())
      continue;
    within_body(of_body, s_of_body);
    s(chosen, chosen) = s_of_body;
  }
  return s;
}

void SurfaceCompliance::within_body(std::span<const int> positions, Eigen::MatrixXd& s) {
  const int body = body_of(positions.front());
  const int first = first_of_body(body);
  if (in_blocks(body)) {
    std::vector<int> within(positions.begin(), positions.end());
    for (int& position : within)
      position -= first;
    blocks_[static_cast<std::size_t>(body)]->between(within, s);
    return;
  }
  const auto size = static_cast<Index>(positions.size());
  s.resize(size, size);
  double* entry = s.data();
  for (const int from : positions) {
    const double* values = column(from);
    for (const int to : positions)
      *entry++ = values[to - first];
  }
}

void SurfaceCompliance::compute_whole(std::span<const int> positions) {
  std::vector<int> bodies;
  for (const int position : positions)
    if (const int body = body_of(position); known_[static_cast<std::size_t>(position)] == 0 &&
                                            is_computed_whole(body) &&
                                            std::ranges::find(bodies, body) == bodies.end())
      bodies.push_back(body);
  solver_->threads().each(static_cast<int>(bodies.size()),
                          [&](int i) { compute(bodies[static_cast<std::size_t>(i)], 0); });
}

bool SurfaceCompliance::is_computed_whole() const {
  for (std::size_t b = 0; b < s_.size(); ++b)
    if (!is_computed_whole(static_cast<int>(b)))
      return false;
  return true;
}

bool SurfaceCompliance::takes_forces_together() const {
  const auto& starts = solver_->body_starts();
  for (std::size_t b = 0; b + 1 < starts.size(); ++b)
    if (starts[b + 1] > starts[b] && !blocks_[b])
      return false;
  return true;
}

Eigen::MatrixXd SurfaceCompliance::between_forces(const linalg::SparseMatrix& forces) const {
  Eigen::MatrixXd s = Eigen::MatrixXd::Zero(forces.cols(), forces.cols());
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    if (blocks_[b])
      s += solver_->surface_within(b)->between(forces, solver_->body_starts()[b]);
  return s;
}

void SurfaceCompliance::add(double factor, const Eigen::VectorXd& force, Eigen::VectorXd& d) {
  for_each_body(solver_->threads(), s_.size(), static_cast<std::size_t>(force.size()),
                [&](std::size_t b) { add_of_body(b, factor, force, d); });
}

void SurfaceCompliance::add_of_body(std::size_t b, double factor, const Eigen::VectorXd& force,
                                    Eigen::VectorXd& d) {
  const auto& starts = solver_->body_starts();
  const Index size = starts[b + 1] - starts[b];
  const auto of_body = force.segment(starts[b], size);
  if (in_blocks(static_cast<int>(b))) {
    blocks_[b]->add(factor, of_body, d.segment(starts[b], size));
    return;
  }
  if (is_solved_with(b, (of_body.array() != 0).count())) {
    d.segment(starts[b], size) += factor * solver_->moved_by(b, of_body);
    return;
  }
  if (size >= smallest_dense &&
      static_cast<double>((of_body.array() != 0).count()) > dense * static_cast<double>(size)) {
    if (is_computed_whole(static_cast<int>(b)))
      linalg::add_symmetric_product(factor, whole(b), of_body.data(), d.data() + starts[b]);
    else
      d.segment(starts[b], size) += factor * solver_->moved_by(b, of_body);
    return;
  }
  linalg::ColumnSum sum(d.data() + starts[b], size);
  for (int i = starts[b]; i < starts[b + 1]; ++i)
    if (force[i] != 0)
      sum.add(factor * force[i], column(i));
  sum.add_rest();
}

/// By the force alone, whatever columns are known: results don't depend on what was asked for before.
bool SurfaceCompliance::is_solved_with(std::size_t body, Index forces) const {
  return solver_->has_dear_columns() && !blocks_[body] && forces > most_dear_columns;
}

/// What a unit force at a position moves of its body, computed when first asked for.
const double* SurfaceCompliance::column(int position) {
  const int body = body_of(position);
  const Index place = position - first_of_body(body);
  if (known_[static_cast<std::size_t>(position)] == 0)
    compute(body, place);
  return s_[static_cast<std::size_t>(body)].col(place).data();
}

/// S of a body that has it computed whole.
const Eigen::MatrixXd& SurfaceCompliance::whole(std::size_t body) {
  column(first_of_body(static_cast<int>(body)));
  return s_[body];
}

/// By the force of all positions: blocks take no single entries, and forces are counted there.
void SurfaceCompliance::add_gathered(double factor, std::span<const ForceAt> force, Eigen::VectorXd& d) {
  Eigen::VectorXd of_all = Eigen::VectorXd::Zero(d.size());
  for (const auto& at : force)
    of_all[at.interface_dof] += at.force;
  add(factor, of_all, d);
}

void SurfaceCompliance::add(double factor, std::span<const ForceAt> force, Eigen::VectorXd& d) {
  if (has_blocks_ || solver_->has_dear_columns())
    return add_gathered(factor, force, d);
  const auto& starts = solver_->body_starts();
  for (std::size_t b = 0; b + 1 < starts.size(); ++b) {
    linalg::ColumnSum sum(d.data() + starts[b], starts[b + 1] - starts[b]);
    for (const auto& at : force)
      if (at.force != 0 && at.interface_dof >= starts[b] && at.interface_dof < starts[b + 1])
        sum.add(factor * at.force, column(at.interface_dof));
    sum.add_rest();
  }
}

/// The column at a place and those that are computed with it.
void SurfaceCompliance::compute(int body, Index place) {
  const auto b = static_cast<std::size_t>(body);
  auto& s = s_[b];
  const auto start = known_.begin() + first_of_body(body);
  const Index size = solver_->body_starts()[b + 1] - first_of_body(body);
  if (is_computed_whole(body)) {
    s = solver_->compliance(b);
    std::fill_n(start, size, 1);
    return;
  }
  if (s.size() == 0)
    s.resize(size, size);
  const Index together = solver_->has_dear_columns() ? 1 : block_size;
  const Index first = place / together * together;
  const Index count = std::min(together, size - first);
  s.middleCols(first, count) = solver_->compliance(b, first, count);
  std::fill_n(start + first, count, 1);
}

} // namespace rubato::step
