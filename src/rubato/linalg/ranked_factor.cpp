// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/ranked_factor.hpp"

#include "rubato/core/error.hpp"
#include "rubato/linalg/dense_cholesky.hpp"
#include "rubato/linalg/dense_products.hpp"
#include "rubato/linalg/fingerprint.hpp"
#include "rubato/linalg/order_of_elimination.hpp"
#include "rubato/linalg/petsc_module.hpp"
#include "rubato/linalg/ranked_matrix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::unique_ptr<FactorOfRanks> make_factor_of_ranks() {
  try {
    std::unique_ptr<FactorOfRanks> made;
    reinterpret_cast<MakeFactorOfRanks*>(petsc_function(make_factor_of_ranks_name))(made);
    return made;
  } catch (const ModuleMissing& error) {
    throw InputError(fmt::format("several ranks cannot factor without PETSc: {}", error.what()));
  }
}

std::span<double> numbers_of(VectorXd& vector) {
  return {vector.data(), static_cast<std::size_t>(vector.size())};
}
std::span<double> numbers_of(MatrixXd& matrix) {
  return {matrix.data(), static_cast<std::size_t>(matrix.size())};
}

/// Calls take(row, column, value) for the lower triangle.
template <class Take> void each_lower_entry(const SparseMatrix& matrix, const Take& take) {
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      if (entry.row() >= column)
        take(static_cast<int>(entry.row()), column, entry.value());
}

} // namespace

RankedFactor::RankedFactor(const SparseMatrix& matrix, std::span<const int> surface, Ranks ranks,
                           const Threads& threads)
    : ranks_(std::move(ranks)), threads_(threads), size_(matrix.cols()), pattern_(pattern_of(matrix)) {
  int bodies = 0;
  const auto body_of = bodies_of(matrix, ranks_, bodies);
  surface_ = surface_of_bodies(surface, body_of, bodies);
}

std::unique_ptr<RankedFactor> RankedFactor::of(const SparseMatrix& matrix, std::span<const int> surface,
                                               Ranks ranks, const Threads& threads,
                                               const std::function<void(std::size_t)>& tell) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("RankedFactor::of wants a square matrix.");
  if (!matrix.isCompressed()) {
    SparseMatrix compressed = matrix;
    compressed.makeCompressed();
    return of(compressed, surface, std::move(ranks), threads, tell);
  }
  std::unique_ptr<RankedFactor> solver(
      new RankedFactor(matrix, surface, std::move(ranks), threads)); // its constructor is private
  solver->analyse(matrix, tell);
  return solver->refactor(matrix) ? std::move(solver) : nullptr;
}

void RankedFactor::analyse(const SparseMatrix& matrix, const std::function<void(std::size_t)>& tell) {
  factor_ = make_factor_of_ranks();
  FactorOfRanks::Entries entries{static_cast<int>(size_),
                                 {},
                                 {},
                                 surface_.unknowns,
                                 order_of_elimination(matrix, surface_.unknowns, ranks_)};
  each_lower_entry(matrix, [&](int row, int column, double) {
    entries.rows.push_back(row);
    entries.columns.push_back(column);
  });
  const auto needs = factor_->analyse(std::move(entries));
  flops_ = needs.flops;
  std::size_t compliance = 0;
  for (std::size_t b = 0; b + 1 < surface_.starts.size(); ++b) {
    const auto unknowns = static_cast<std::size_t>(surface_.starts[b + 1] - surface_.starts[b]);
    compliance += sizeof(double) * unknowns * unknowns;
  }
  const auto all = static_cast<std::size_t>(surface_size());
  tell(needs.bytes + compliance + (ranks_.is_first() ? sizeof(double) * all * all : 0));
}

bool RankedFactor::refactor(const SparseMatrix& matrix) {
  if (matrix.rows() != size_ || pattern_of(matrix) != pattern_)
    throw std::invalid_argument("RankedFactor::refactor wants a matrix of the first one's pattern.");
  if (!matrix.isCompressed()) {
    SparseMatrix compressed = matrix;
    compressed.makeCompressed();
    return refactor(compressed);
  }
  const std::span all(matrix.valuePtr(), static_cast<std::size_t>(matrix.nonZeros()));
  const auto wanted = fingerprint_of(all);
  if (ranks_.all(has_values_ && wanted == values_))
    return true;
  has_values_ = false;
  remembered_ = 0;
  ++renewals_;
  if (!ranks_.all(std::ranges::all_of(all, [](double value) { return std::isfinite(value); })))
    return false;
  std::vector<double> values;
  each_lower_entry(matrix, [&](int, int, double value) { values.push_back(value); });
  const auto on_first = ranks_.is_first() ? surface_size() : 0;
  MatrixXd complement = MatrixXd::Zero(on_first, on_first);
  if (!factor_->factorise(values, numbers_of(complement)) || !share_compliance(complement))
    return false;
  bytes_ = factor_->bytes();
  values_ = wanted;
  has_values_ = true;
  return true;
}

/// Of each body, from the complement that the first rank has. False when that is not positive definite.
bool RankedFactor::share_compliance(const MatrixXd& complement) {
  compliances_.clear();
  for (std::size_t b = 0; b + 1 < surface_.starts.size(); ++b) {
    const Index first = surface_.starts[b], size = surface_.starts[b + 1] - first;
    std::optional<MatrixXd> own = MatrixXd(size, size);
    if (ranks_.is_first())
      own = inverse_of_positive_definite(complement.block(first, first, size, size));
    if (!ranks_.of_first(own.has_value()))
      return false;
    ranks_.share_first(numbers_of(*own));
    compliances_.push_back(std::move(*own));
  }
  return true;
}

void RankedFactor::must_have_values() const {
  if (!has_values_)
    throw std::logic_error("RankedFactor has no values: the last matrix could not be factored.");
}

VectorXd RankedFactor::solve(const VectorXd& right_side) const {
  return backward(forward(right_side));
}

/// On the surface.
VectorXd RankedFactor::condensed(const VectorXd& right_side) const {
  VectorXd given = right_side, on_surface(surface_size());
  factor_->condense(numbers_of(given), numbers_of(on_surface));
  ranks_.share_first(numbers_of(on_surface));
  remembered_ = ++solves_;
  return on_surface;
}

VectorXd RankedFactor::forward(const VectorXd& right_side) const {
  must_have_values();
  if (right_side.size() != size_)
    throw std::invalid_argument("RankedFactor wants a right side of the matrix's size.");
  if (surface_size() == 0) {
    VectorXd solution = right_side;
    factor_->solve(numbers_of(solution));
    ranks_.share_first(numbers_of(solution));
    return solution;
  }
  VectorXd half_way(size_ + surface_size() + 1);
  half_way.head(size_) = right_side;
  half_way.segment(size_, surface_size()) = condensed(right_side);
  half_way[half_way.size() - 1] = static_cast<double>(solves_);
  return half_way;
}

VectorXd RankedFactor::surface_of(const VectorXd& half_way) const {
  must_have_values();
  VectorXd moved(surface_size());
  for (std::size_t b = 0; b < compliances_.size(); ++b) {
    const Index first = surface_.starts[b], size = compliances_[b].rows();
    VectorXd of_body(size);
    std::copy_n(half_way.data() + size_ + first, size, of_body.data());
    of_body = product(compliances_[b], of_body);
    std::copy_n(of_body.data(), size, moved.data() + first);
  }
  return moved;
}

void RankedFactor::load_surface(const VectorXd& force, VectorXd& half_way) const {
  half_way.segment(size_, surface_size()) += force;
}

VectorXd RankedFactor::backward(const VectorXd& half_way) const {
  must_have_values();
  if (surface_size() == 0)
    return half_way;
  VectorXd on_surface = surface_of(half_way), solution = half_way.head(size_);
  if (static_cast<std::int64_t>(half_way[half_way.size() - 1]) != remembered_)
    condensed(solution);
  remembered_ = 0;
  factor_->expand(numbers_of(on_surface), numbers_of(solution));
  ranks_.share_first(numbers_of(solution));
  return solution;
}

MatrixXd RankedFactor::compliance(std::size_t body) const {
  must_have_values();
  return compliances_[body];
}

MatrixXd RankedFactor::compliance(std::size_t body, Index first, Index count) const {
  must_have_values();
  return compliances_[body].middleCols(first, count);
}

VectorXd RankedFactor::moved_by(std::size_t body, const VectorXd& force) const {
  must_have_values();
  return product(compliances_[body], force);
}

} // namespace rubato::linalg
