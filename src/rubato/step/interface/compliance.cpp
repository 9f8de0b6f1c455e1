// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/compliance.hpp"

#include "rubato/linalg/column_sum.hpp"
#include "rubato/linalg/symmetric_product.hpp"

#include <algorithm>

namespace rubato::step {
namespace {

using Eigen::Index;

/// Where more of a force than this is not zero, half of the whole matrix is read sooner than its columns.
constexpr double dense = 0.35;
/// Columns of smaller surfaces are near anyway.
constexpr Index smallest_dense = 64;

} // namespace

Compliance::Compliance(linalg::SplitFactor factor, std::span<const int> free_dofs, Index dofs,
                       Index largest_whole)
    : factor_(std::move(factor)), largest_whole_(largest_whole),
      interface_dofs_(static_cast<std::size_t>(dofs), -1), interface_dof_of_unknown_(free_dofs.size(), -1),
      known_(factor_.surface().size(), 0) {
  for (const int unknown : factor_.surface()) {
    const int dof = free_dofs[static_cast<std::size_t>(unknown)];
    const auto interface_dof = static_cast<int>(dofs_.size());
    interface_dofs_[static_cast<std::size_t>(dof)] = interface_dof;
    interface_dof_of_unknown_[static_cast<std::size_t>(unknown)] = interface_dof;
    dofs_.push_back(dof);
  }
  const auto& starts = factor_.body_starts();
  for (std::size_t b = 0; b + 1 < starts.size(); ++b)
    body_of_.insert(body_of_.end(), static_cast<std::size_t>(starts[b + 1] - starts[b]), static_cast<int>(b));
  s_.resize(starts.size() - 1);
}

Eigen::MatrixXd Compliance::between_unknowns(std::span<const int> unknowns) {
  std::vector<int> interface_dofs;
  interface_dofs.reserve(unknowns.size());
  for (const int unknown : unknowns)
    interface_dofs.push_back(interface_dof_of_unknown_[static_cast<std::size_t>(unknown)]);
  return between(interface_dofs);
}

Eigen::MatrixXd Compliance::between(std::span<const int> interface_dofs) {
  const auto size = static_cast<Index>(interface_dofs.size());
  Eigen::MatrixXd s(size, size);
  double* entry = s.data();
  for (const int from : interface_dofs) {
    const double* values = column(from);
    for (const int to : interface_dofs)
      *entry++ = body_of(to) == body_of(from) ? values[to - first_of_body(body_of(to))] : 0.0;
  }
  return s;
}

Eigen::MatrixXd Compliance::within_body(std::span<const int> interface_dofs) {
  const auto size = static_cast<Index>(interface_dofs.size());
  Eigen::MatrixXd s(size, size);
  double* entry = s.data();
  for (const int from : interface_dofs) {
    const double* values = column(from);
    const int first = first_of_body(body_of(from));
    for (const int to : interface_dofs)
      *entry++ = values[to - first];
  }
  return s;
}

void Compliance::add(double factor, const Eigen::VectorXd& force, Eigen::VectorXd& d) {
  const auto& starts = factor_.body_starts();
  for (std::size_t b = 0; b + 1 < starts.size(); ++b) {
    const Index size = starts[b + 1] - starts[b];
    const auto of_body = force.segment(starts[b], size);
    const bool may_be_dense = size >= smallest_dense && size <= largest_whole_;
    if (may_be_dense &&
        static_cast<double>((of_body.array() != 0).count()) > dense * static_cast<double>(size)) {
      linalg::add_symmetric_product(factor, whole(b), of_body.data(), d.data() + starts[b]);
      continue;
    }
    linalg::ColumnSum sum(d.data() + starts[b], size);
    for (int i = starts[b]; i < starts[b + 1]; ++i)
      if (force[i] != 0)
        sum.add(factor * force[i], column(i));
    sum.add_rest();
  }
}

const double* Compliance::column(int interface_dof) {
  const int body = body_of(interface_dof);
  const Index place = interface_dof - first_of_body(body);
  if (known_[static_cast<std::size_t>(interface_dof)] == 0)
    compute(body, place);
  return s_[static_cast<std::size_t>(body)].col(place).data();
}

/// S of a body that has it computed whole.
const Eigen::MatrixXd& Compliance::whole(std::size_t body) {
  column(first_of_body(static_cast<int>(body)));
  return s_[body];
}

void Compliance::add(double factor, std::span<const ForceAt> force, Eigen::VectorXd& d) {
  const auto& starts = factor_.body_starts();
  for (std::size_t b = 0; b + 1 < starts.size(); ++b) {
    linalg::ColumnSum sum(d.data() + starts[b], starts[b + 1] - starts[b]);
    for (const auto& at : force)
      if (at.force != 0 && at.interface_dof >= starts[b] && at.interface_dof < starts[b + 1])
        sum.add(factor * at.force, column(at.interface_dof));
    sum.add_rest();
  }
}

/// The column at a place and those that are computed with it.
void Compliance::compute(int body, Index place) {
  const auto b = static_cast<std::size_t>(body);
  auto& s = s_[b];
  const auto start = known_.begin() + first_of_body(body);
  const Index size = factor_.body_starts()[b + 1] - first_of_body(body);
  if (size <= largest_whole_) {
    s = factor_.compliance(b);
    std::fill_n(start, size, 1);
    return;
  }
  if (s.size() == 0)
    s.resize(size, size);
  const Index first = place / block_size * block_size;
  const Index count = std::min(block_size, size - first);
  s.middleCols(first, count) = factor_.compliance(b, first, count);
  std::fill_n(start + first, count, 1);
}

} // namespace rubato::step
