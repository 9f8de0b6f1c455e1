// SPDX-License-Identifier: LGPL-3.0-or-later
/// A matrix that is the sum of what ranks have: each has a part of the size of the whole, as the sum over its
/// cells. All ranks make the same calls and get the same answers; one that is alone has the whole.
#pragma once

#include "rubato/core/ranks.hpp"
#include "rubato/linalg/direct_solver.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace rubato::linalg {

/// Σ of what the ranks have.
Eigen::VectorXd summed(Eigen::VectorXd own, const Ranks& ranks);
/// That of the first rank, where each has one of its own of as many values.
Eigen::VectorXd of_first(Eigen::VectorXd own, const Ranks& ranks);

Eigen::VectorXd diagonal_of(const SparseMatrix& part, const Ranks& ranks);
/// A x, x being the same on all ranks.
Eigen::VectorXd product_of(const SparseMatrix& part, const Eigen::VectorXd& x, const Ranks& ranks);
/// Where the parts of all ranks have entries.
class PatternOfParts {
public:
  PatternOfParts(const SparseMatrix& part, const Ranks& ranks);

  std::size_t entries(std::size_t rank) const { return entries_[rank]; }
  /// Of compressed columns: where each begins, and the rows of all.
  const int* starts(std::size_t rank) const { return starts_.data() + rank * columns_; }
  const int* rows(std::size_t rank) const { return rows_.data() + rank * room_; }
  /// The rows of a column.
  std::span<const int> rows(std::size_t rank, std::size_t column) const {
    const int* of_rank = starts(rank);
    return {rows(rank) + of_rank[column], rows(rank) + of_rank[column + 1]};
  }
  std::size_t ranks() const { return entries_.size(); }
  /// Of the part with most entries.
  std::size_t room() const { return room_; }

private:
  std::size_t columns_ = 0; ///< and one more
  std::size_t room_ = 0;
  std::vector<std::size_t> entries_;
  std::vector<int> starts_;
  std::vector<int> rows_;
};

/// A itself, on every rank: for what has no other way.
SparseMatrix whole_of(const SparseMatrix& part, const Ranks& ranks);
/// The same once it is asked for.
class WholeMatrix {
public:
  /// `part` must outlive this.
  WholeMatrix(const SparseMatrix& part, Ranks ranks = {}) : part_(&part), ranks_(std::move(ranks)) {}

  /// By all ranks together.
  const SparseMatrix& get() const {
    if (ranks_.is_alone())
      return *part_;
    if (!whole_)
      whole_ = whole_of(*part_, ranks_);
    return *whole_;
  }

private:
  const SparseMatrix* part_;
  Ranks ranks_;
  mutable std::optional<SparseMatrix> whole_;
};

/// bodies_of (surface_solver.hpp) of A.
std::vector<int> bodies_of(const SparseMatrix& part, const Ranks& ranks, int& count);

} // namespace rubato::linalg
