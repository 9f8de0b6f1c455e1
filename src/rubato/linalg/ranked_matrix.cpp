// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/ranked_matrix.hpp"

#include "rubato/core/disjoint_sets.hpp"
#include "rubato/core/index.hpp"
#include "rubato/linalg/surface_solver.hpp"

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// With as many behind them as make `count`.
template <class Number> std::vector<Number> filled_up(const Number* numbers, Index size, std::size_t count) {
  std::vector<Number> filled(count, 0);
  std::copy_n(numbers, size, filled.begin());
  return filled;
}

/// The bodies of this rank's part, −1 for unknowns that it has no entries of.
std::vector<int> own_bodies(const SparseMatrix& part, int& count) {
  int all = 0;
  auto body_of = bodies_of(part, all);
  std::vector<int> number(at(all), -1);
  count = 0;
  for (Index unknown = 0; unknown < part.cols(); ++unknown) {
    auto& body = body_of[at(unknown)];
    const bool has_entries = part.outerIndexPtr()[unknown + 1] > part.outerIndexPtr()[unknown];
    if (has_entries && number[at(body)] < 0)
      number[at(body)] = count++;
    body = number[at(body)];
  }
  return body_of;
}

/// The bodies of all ranks' parts, numbered through, that each unknown is in.
class BodiesOfParts {
public:
  BodiesOfParts(std::vector<int> own, int own_count, const Ranks& ranks)
      : own_(std::move(own)), ranks_(ranks), first_(1, 0) {
    for (const int count : ranks.each(own_count))
      first_.push_back(first_.back() + at(count));
  }

  std::size_t count() const { return first_.back(); }

  /// Calls take(unknown, bodies) for every unknown in turn.
  template <class Take> void each(const Take& take) const {
    constexpr std::size_t together = 1U << 16U; // unknowns that all ranks tell one another of at once
    std::vector<std::size_t> bodies;
    for (std::size_t first = 0; first < own_.size(); first += together) {
      const auto some = std::span(own_).subspan(first, std::min(together, own_.size() - first));
      const auto of_all = ranks_.each_of(std::span<const int>(some));
      for (std::size_t i = 0; i < some.size(); ++i) {
        bodies.clear();
        for (std::size_t rank = 0; rank < at(ranks_.count()); ++rank)
          if (const int body = of_all[rank * some.size() + i]; body >= 0)
            bodies.push_back(first_[rank] + at(body));
        take(first + i, std::span<const std::size_t>(bodies));
      }
    }
  }

private:
  std::vector<int> own_;
  const Ranks& ranks_;
  std::vector<std::size_t> first_; ///< of each rank
};

} // namespace

VectorXd summed(VectorXd own, const Ranks& ranks) {
  ranks.sum({own.data(), static_cast<std::size_t>(own.size())});
  return own;
}

VectorXd of_first(VectorXd own, const Ranks& ranks) {
  ranks.share_first({own.data(), static_cast<std::size_t>(own.size())});
  return own;
}

VectorXd diagonal_of(const SparseMatrix& part, const Ranks& ranks) {
  return summed(part.diagonal(), ranks);
}

VectorXd product_of(const SparseMatrix& part, const VectorXd& x, const Ranks& ranks) {
  return summed(part * x, ranks);
}

PatternOfParts::PatternOfParts(const SparseMatrix& part, const Ranks& ranks) {
  if (!part.isCompressed())
    throw std::invalid_argument("PatternOfParts wants a compressed matrix.");
  columns_ = at(part.cols()) + 1;
  entries_ = ranks.each(at(part.nonZeros()));
  room_ = std::ranges::max(entries_);
  starts_ = ranks.each_of(std::span<const int>(part.outerIndexPtr(), columns_));
  rows_ = ranks.each_of(std::span<const int>(filled_up(part.innerIndexPtr(), part.nonZeros(), room_)));
}

SparseMatrix whole_of(const SparseMatrix& part, const Ranks& ranks) {
  if (ranks.is_alone())
    return part;
  SparseMatrix own = part;
  own.makeCompressed();
  const PatternOfParts pattern(own, ranks);
  const auto values =
      ranks.each_of(std::span<const double>(filled_up(own.valuePtr(), own.nonZeros(), pattern.room())));
  SparseMatrix whole(own.rows(), own.cols());
  for (std::size_t rank = 0; rank < pattern.ranks(); ++rank)
    whole += Eigen::Map<const SparseMatrix>(own.rows(), own.cols(), static_cast<Index>(pattern.entries(rank)),
                                            pattern.starts(rank), pattern.rows(rank),
                                            values.data() + rank * pattern.room());
  return whole;
}

std::vector<int> bodies_of(const SparseMatrix& part, const Ranks& ranks, int& count) {
  if (ranks.is_alone())
    return bodies_of(part, count);
  int own_count = 0;
  auto own = own_bodies(part, own_count);
  const BodiesOfParts parts(std::move(own), own_count, ranks);
  DisjointSets joined(parts.count());
  parts.each([&](std::size_t, std::span<const std::size_t> bodies) {
    for (const auto body : bodies)
      joined.join(bodies.front(), body);
  });
  std::vector<int> number(parts.count(), -1), body_of(at(part.cols()));
  count = 0;
  parts.each([&](std::size_t unknown, std::span<const std::size_t> bodies) {
    if (bodies.empty()) {
      body_of[unknown] = count++;
      return;
    }
    auto& body = number[joined.root(bodies.front())];
    if (body < 0)
      body = count++;
    body_of[unknown] = body;
  });
  return body_of;
}

} // namespace rubato::linalg
