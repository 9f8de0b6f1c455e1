// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/compliance.hpp"

#include "rubato/linalg/column_sum.hpp"

#include <algorithm>
#include <numeric>

namespace rubato::step {
namespace {

using Eigen::Index;

/// Neighbouring columns that are always computed together: enough for matrix–matrix products, few that are
/// never asked for. The last digits of a column depend on its company there; as that is always the same, they
/// don't depend on what was asked for before, and a resumed run has the same ones.
constexpr int block_size = 32;
/// Surfaces up to this size get all their columns at once.
constexpr int small_surface = 256;

} // namespace

Compliance::Compliance(linalg::SplitFactor factor, std::span<const int> free_dofs, Index dofs)
    : factor_(std::move(factor)), positions_(static_cast<std::size_t>(dofs), -1),
      position_of_unknown_(free_dofs.size(), -1), columns_(factor_.surface().size()) {
  for (const int unknown : factor_.surface()) {
    const int dof = free_dofs[static_cast<std::size_t>(unknown)];
    const auto position = static_cast<int>(dofs_.size());
    positions_[static_cast<std::size_t>(dof)] = position;
    position_of_unknown_[static_cast<std::size_t>(unknown)] = position;
    dofs_.push_back(dof);
  }
  const auto& starts = factor_.body_starts();
  for (std::size_t b = 0; b + 1 < starts.size(); ++b) {
    bodies_.push_back({starts[b], starts[b + 1] - starts[b]});
    body_of_.insert(body_of_.end(), static_cast<std::size_t>(bodies_.back().size), static_cast<int>(b));
  }
}

Eigen::MatrixXd Compliance::between_unknowns(std::span<const int> unknowns) {
  std::vector<int> positions;
  positions.reserve(unknowns.size());
  for (const int unknown : unknowns)
    positions.push_back(position_of_unknown_[static_cast<std::size_t>(unknown)]);
  return between(positions);
}

Eigen::MatrixXd Compliance::between(std::span<const int> positions) {
  prepare(positions);
  const auto size = static_cast<Index>(positions.size());
  Eigen::MatrixXd s(size, size);
  for (Index j = 0; j < size; ++j) {
    const auto from = static_cast<std::size_t>(positions[static_cast<std::size_t>(j)]);
    const auto& column = columns_[from];
    const auto& body = bodies_[static_cast<std::size_t>(body_of_[from])];
    for (Index i = 0; i < size; ++i) {
      const int place = positions[static_cast<std::size_t>(i)] - body.first;
      s(i, j) = place >= 0 && place < body.size ? column[place] : 0.0;
    }
  }
  return s;
}

Eigen::MatrixXd Compliance::within_body(std::span<const int> positions) {
  const auto size = static_cast<Index>(positions.size());
  Eigen::MatrixXd s(size, size);
  double* entry = s.data();
  for (const int from : positions) {
    const double* values = column(from);
    const int first = bodies_[static_cast<std::size_t>(body_of_[static_cast<std::size_t>(from)])].first;
    for (const int to : positions)
      *entry++ = values[to - first];
  }
  return s;
}

void Compliance::add(double factor, const Eigen::VectorXd& force, Eigen::VectorXd& d) {
  for (const auto& body : bodies_) {
    linalg::ColumnSum sum(d.data() + body.first, body.size);
    for (int i = body.first; i < body.first + body.size; ++i)
      if (force[i] != 0)
        sum.add(factor * force[i], column(i));
    sum.add_rest();
  }
}

/// Of its body.
const double* Compliance::column(int position) {
  const auto& known = columns_[static_cast<std::size_t>(position)];
  if (known.size() == 0)
    prepare({&position, 1});
  return known.data();
}

void Compliance::prepare(std::span<const int> positions) {
  for (const int position : positions) {
    if (columns_[static_cast<std::size_t>(position)].size() != 0)
      continue;
    const auto body = static_cast<std::size_t>(body_of_[static_cast<std::size_t>(position)]);
    const int size = bodies_[body].size;
    const int together = size <= small_surface ? size : block_size;
    const int first = (position - bodies_[body].first) / together * together;
    compute(body, first, std::min(together, size - first));
  }
}

void Compliance::compute(std::size_t body, int first, int count) {
  std::vector<int> places(static_cast<std::size_t>(count));
  std::iota(places.begin(), places.end(), first);
  const Eigen::MatrixXd moved = factor_.compliance(body, places);
  for (int j = 0; j < count; ++j)
    columns_[static_cast<std::size_t>(bodies_[body].first + first + j)] = moved.col(j);
}

} // namespace rubato::step
