// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/cholmod_engine.hpp"

#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/pivots.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>

namespace rubato::linalg {
namespace {

using Index = CholmodEngine::Index;

cholmod_dense view(const double* values, Eigen::Index row_count, Eigen::Index column_count) {
  cholmod_dense dense{};
  dense.nrow = dense.d = static_cast<std::size_t>(row_count);
  dense.ncol = static_cast<std::size_t>(column_count);
  dense.nzmax = dense.nrow * dense.ncol;
  dense.x = const_cast<double*>(values); // CHOLMOD's views know no const; right sides are only read
  dense.xtype = CHOLMOD_REAL;
  dense.dtype = CHOLMOD_DOUBLE;
  return dense;
}

Supernode supernode_of(const cholmod_factor& factor, std::size_t s) {
  const auto* first_column = static_cast<const Index*>(factor.super);
  const auto* row_start = static_cast<const Index*>(factor.pi);
  const auto* value_start = static_cast<const Index*>(factor.px);
  const auto* rows = static_cast<const Index*>(factor.s);
  const auto* values = static_cast<const double*>(factor.x);
  return {first_column[s],
          first_column[s + 1] - first_column[s],
          {rows + row_start[s], static_cast<std::size_t>(row_start[s + 1] - row_start[s])},
          values == nullptr ? nullptr : values + value_start[s]};
}

/// The diagonal of L in the order of elimination.
std::vector<double> factor_diagonal(const cholmod_factor& factor) {
  std::vector<double> diagonal;
  diagonal.reserve(factor.n);
  if (!factor.is_super) {
    const auto* x = static_cast<const double*>(factor.x);
    const std::span starts(static_cast<const Index*>(factor.p), factor.n);
    std::transform(starts.begin(), starts.end(), std::back_inserter(diagonal),
                   [x](Index start) { return x[start]; });
    return diagonal;
  }
  const std::span values(static_cast<const double*>(factor.x), factor.xsize);
  const auto* value_start = static_cast<const Index*>(factor.px);
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const auto node = supernode_of(factor, s);
    const auto row_count = static_cast<Index>(node.rows.size());
    for (Index column = 0; column < node.columns; ++column)
      diagonal.push_back(values[static_cast<std::size_t>(value_start[s] + column * (row_count + 1))]);
  }
  return diagonal;
}

/// The columns from `first` on of a factor without supernodes.
Eigen::MatrixXd trailing_columns(const cholmod_factor& factor, Index first) {
  const auto* starts = static_cast<const Index*>(factor.p);
  const auto* counts = static_cast<const Index*>(factor.nz);
  const auto* rows = static_cast<const Index*>(factor.i);
  const auto* values = static_cast<const double*>(factor.x);
  const auto size = static_cast<Index>(factor.n) - first;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(size, size);
  for (Index column = 0; column < size; ++column)
    for (Index k = 0; k < counts[first + column]; ++k) {
      const Index entry = starts[first + column] + k;
      columns(rows[entry] - first, column) = values[entry];
    }
  return columns;
}

/// Rounding can leave a tiny positive pivot where the exact one is zero or negative. L_ii² / A_ii is the part
/// of the stiffness of unknown i that the unknowns before it leave over; it does not depend on units or
/// scaling.
bool has_negligible_pivot(const cholmod_factor& factor, std::span<const double> matrix_diagonal) {
  const auto diagonal = factor_diagonal(factor);
  const auto* order = static_cast<const Index*>(factor.Perm);
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    const auto left_over = diagonal[i] * diagonal[i];
    // Written so that a NaN counts as negligible.
    if (!(left_over > negligible_pivot * matrix_diagonal[static_cast<std::size_t>(order[i])]))
      return true;
  }
  return false;
}

/// METIS draws from the C library's random numbers, which it seeds: its orderings are those of one caller at
/// a time.
std::mutex& turn_of_metis() {
  static std::mutex turn;
  return turn;
}

[[noreturn]] void refuse_status(int status) {
  if (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE)
    throw std::bad_alloc();
  throw std::logic_error("CHOLMOD stopped with status " + std::to_string(status) + ".");
}

/// The entries of the first `size` rows and columns.
LowerTriangle leading_part(const LowerTriangle& lower, Index size) {
  LowerTriangle part(SparseMatrix(0, 0));
  part.rows.reserve(lower.rows.size());
  part.values.reserve(lower.values.size());
  for (Index column = 0; column < size; ++column) {
    for (auto entry = lower.starts[static_cast<std::size_t>(column)];
         entry < lower.starts[static_cast<std::size_t>(column) + 1]; ++entry)
      if (lower.rows[static_cast<std::size_t>(entry)] < size) {
        part.rows.push_back(lower.rows[static_cast<std::size_t>(entry)]);
        part.values.push_back(lower.values[static_cast<std::size_t>(entry)]);
      }
    part.starts.push_back(static_cast<Index>(part.rows.size()));
  }
  part.sorted = lower.sorted;
  return part;
}

} // namespace

LowerTriangle::LowerTriangle(const SparseMatrix& matrix) {
  const auto half = static_cast<std::size_t>((matrix.nonZeros() + matrix.cols()) / 2);
  rows.reserve(half);
  values.reserve(half);
  starts.reserve(static_cast<std::size_t>(matrix.cols()) + 1);
  starts.push_back(0);
  for (int column = 0; column < matrix.cols(); ++column) {
    for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry)
      if (entry.row() >= column) {
        rows.push_back(entry.row());
        values.push_back(entry.value());
        finite = finite && std::isfinite(entry.value());
      }
    starts.push_back(static_cast<Index>(rows.size()));
  }
}

LowerTriangle::LowerTriangle(const SparseMatrix& matrix, std::span<const int> unknowns,
                             std::span<const int> number)
    : sorted(false) {
  Index entries = 0;
  for (const int unknown : unknowns)
    entries += matrix.col(unknown).nonZeros();
  const auto half = static_cast<std::size_t>(entries) / 2 + unknowns.size();
  rows.reserve(half);
  values.reserve(half);
  starts.reserve(unknowns.size() + 1);
  starts.push_back(0);
  for (std::size_t column = 0; column < unknowns.size(); ++column) {
    for (SparseMatrix::InnerIterator entry(matrix, unknowns[column]); entry; ++entry)
      if (const int row = number[static_cast<std::size_t>(entry.row())]; row >= static_cast<int>(column)) {
        rows.push_back(row);
        values.push_back(entry.value());
        finite = finite && std::isfinite(entry.value());
      }
    starts.push_back(static_cast<Index>(rows.size()));
  }
}

cholmod_sparse LowerTriangle::view() {
  cholmod_sparse sparse{};
  sparse.nrow = sparse.ncol = static_cast<std::size_t>(size());
  sparse.nzmax = rows.size();
  sparse.p = starts.data();
  sparse.i = rows.data();
  sparse.x = values.data();
  sparse.stype = -1;
  sparse.itype = CHOLMOD_LONG;
  sparse.xtype = CHOLMOD_REAL;
  sparse.dtype = CHOLMOD_DOUBLE;
  sparse.sorted = sorted ? 1 : 0;
  sparse.packed = 1;
  return sparse;
}

std::vector<double> LowerTriangle::diagonal() const {
  std::vector<double> values_on_it(static_cast<std::size_t>(size()), 0.0);
  for (std::size_t column = 0; column < values_on_it.size(); ++column)
    for (auto entry = starts[column]; entry < starts[column + 1]; ++entry)
      if (rows[static_cast<std::size_t>(entry)] == static_cast<Index>(column))
        values_on_it[column] += values[static_cast<std::size_t>(entry)];
  return values_on_it;
}

CholmodEngine::CholmodEngine() {
  use_one_blas_thread_by_default();
  cholmod_l_start(&common_);
  common_.print = 0;
  common_.nmethods = 1;
  common_.final_ll = 1;
  common_.quick_return_if_not_posdef = 1;
}

CholmodEngine::~CholmodEngine() {
  cholmod_l_free_dense(&solution_, &common_);
  cholmod_l_free_dense(&work_y_, &common_);
  cholmod_l_free_dense(&work_e_, &common_);
  cholmod_l_free_factor(&factor_, &common_);
  cholmod_l_finish(&common_);
}

void CholmodEngine::analyse(LowerTriangle& lower) {
  // Where supernodes do not pay (chains, tiny models), CHOLMOD works column by column; LLᵀ there too.
  analyse(lower, CHOLMOD_AUTO);
}

void CholmodEngine::analyse_supernodes(LowerTriangle& lower) {
  analyse(lower, CHOLMOD_SUPERNODAL);
}

void CholmodEngine::analyse(LowerTriangle& lower, int supernodal) {
  if (lower.size() == 0)
    return;
  common_.method[0].ordering = CHOLMOD_METIS;
  common_.postorder = 1;
  common_.supernodal = supernodal;
  auto matrix = lower.view();
  const std::scoped_lock turn(turn_of_metis());
  take_analysed(cholmod_l_analyze(&matrix, &common_));
}

void CholmodEngine::analyse(LowerTriangle& lower, Index trailing) {
  if (lower.size() == 0)
    return;
  auto order = interior_ordering(lower, trailing);
  common_.method[0].ordering = CHOLMOD_GIVEN;
  common_.postorder = 0; // it would not leave the trailing unknowns where they are
  common_.supernodal = CHOLMOD_AUTO;
  auto matrix = lower.view();
  take_analysed(cholmod_l_analyze_p(&matrix, order.data(), nullptr, 0, &common_));
}

void CholmodEngine::take_analysed(cholmod_factor* factor) {
  factor_ = factor;
  if (factor_ == nullptr)
    refuse_status(common_.status);
  entries_ = common_.lnz;
  flops_ = common_.fl;
}

/// METIS knows only the unknowns before the trailing ones: these are eliminated last whatever it does.
std::vector<Index> CholmodEngine::interior_ordering(LowerTriangle& lower, Index trailing) {
  std::vector<Index> order(static_cast<std::size_t>(lower.size()));
  std::iota(order.begin(), order.end(), Index{0});
  const Index interior = lower.size() - trailing;
  if (interior == 0)
    return order;
  auto part = leading_part(lower, interior);
  auto matrix = part.view();
  const std::scoped_lock turn(turn_of_metis());
  // METIS says no more than that it failed, which on a graph it only does for want of memory.
  if (!cholmod_l_metis(&matrix, nullptr, 0, 1, order.data(), &common_))
    throw std::bad_alloc();
  return order;
}

std::size_t CholmodEngine::bytes() const {
  if (factor_ == nullptr)
    return 0;
  const auto of_columns = 2 * factor_->n * sizeof(Index);
  if (factor_->is_super)
    return of_columns + factor_->xsize * sizeof(double) +
           (factor_->ssize + 3 * (factor_->nsuper + 1)) * sizeof(Index);
  return of_columns + factor_->nzmax * (sizeof(double) + sizeof(Index)) +
         (4 * factor_->n + 5) * sizeof(Index);
}

bool CholmodEngine::factorise(LowerTriangle& lower) {
  if (factor_ == nullptr)
    return true;
  auto matrix = lower.view();
  const OneOpenMpThread one_thread;
  cholmod_l_factorize(&matrix, factor_, &common_);
  if (common_.status < CHOLMOD_OK)
    refuse_status(common_.status);
  return common_.status != CHOLMOD_NOT_POSDEF && factor_->minor == factor_->n &&
         !has_negligible_pivot(*factor_, lower.diagonal());
}

std::span<const Index> CholmodEngine::permutation() const {
  if (factor_ == nullptr)
    return {};
  return {static_cast<const Index*>(factor_->Perm), factor_->n};
}

std::size_t CholmodEngine::supernode_count() const {
  return factor_ != nullptr && factor_->is_super ? factor_->nsuper : 0;
}

Supernode CholmodEngine::supernode(std::size_t s) const {
  return supernode_of(*factor_, s);
}

TrailingTriangle CholmodEngine::trailing(Index size) const {
  TrailingTriangle triangle;
  triangle.size = size;
  if (size == 0)
    return triangle;
  const auto first = static_cast<Index>(factor_->n) - size;
  if (!factor_->is_super) {
    triangle.copy = trailing_columns(*factor_, first);
    triangle.values = triangle.copy.data();
    triangle.stride = size;
    return triangle;
  }
  const auto last_node = supernode_of(*factor_, factor_->nsuper - 1);
  if (last_node.first <= first) {
    triangle.stride = last_node.columns;
    triangle.values = last_node.values + (first - last_node.first) * (triangle.stride + 1);
    return triangle;
  }
  triangle.copy = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t s = 0; s < factor_->nsuper; ++s) {
    const auto node = supernode_of(*factor_, s);
    const auto row_count = static_cast<Index>(node.rows.size());
    for (Index column = std::max<Index>(0, first - node.first); column < node.columns; ++column)
      for (Index row = column; row < row_count; ++row)
        triangle.copy(node.rows[static_cast<std::size_t>(row)] - first, node.first + column - first) =
            node.values[column * row_count + row];
  }
  triangle.values = triangle.copy.data();
  triangle.stride = size;
  return triangle;
}

Eigen::Map<const Eigen::VectorXd> CholmodEngine::solve(int system,
                                                       const Eigen::Ref<const Eigen::VectorXd>& right_side) {
  if (factor_ == nullptr)
    return {nullptr, 0};
  auto b = view(right_side.data(), right_side.size(), 1);
  const OneOpenMpThread one_thread;
  if (!cholmod_l_solve2(system, factor_, &b, nullptr, &solution_, nullptr, &work_y_, &work_e_, &common_))
    refuse_status(common_.status);
  return {static_cast<const double*>(solution_->x), right_side.size()};
}

Eigen::MatrixXd CholmodEngine::solve_many(const Eigen::MatrixXd& right_sides) {
  if (factor_ == nullptr)
    return right_sides;
  auto b = view(right_sides.data(), right_sides.rows(), right_sides.cols());
  const OneOpenMpThread one_thread;
  auto* x = cholmod_l_solve(CHOLMOD_A, factor_, &b, &common_);
  if (x == nullptr)
    refuse_status(common_.status);
  Eigen::MatrixXd solutions = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x),
                                                                right_sides.rows(), right_sides.cols());
  cholmod_l_free_dense(&x, &common_);
  return solutions;
}

} // namespace rubato::linalg
