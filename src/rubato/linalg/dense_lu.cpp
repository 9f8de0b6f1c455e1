// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_lu.hpp"

#include "rubato/linalg/blas.hpp"
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/column_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double singular = 1e-15;
/// Pivots within this factor leave no doubt: the estimate costs more than the factors of a small matrix.
constexpr double doubtful = 1e-6;
constexpr Eigen::Index without_estimate = 48;
/// Rows from which on two threads are done sooner than one.
constexpr int fewest_by_threads = 1000;

bool beyond_doubt(const MatrixXd& factors) {
  double least = std::numeric_limits<double>::infinity();
  double largest = 0;
  for (Index k = 0; k < factors.rows(); ++k) {
    const double pivot = std::abs(factors(k, k));
    least = std::min(least, pivot);
    largest = std::max(largest, pivot);
  }
  return least > doubtful * largest;
}

/// The 1-norm; not finite where a number of the matrix is not.
double largest_column_sum(const MatrixXd& matrix) {
  double largest = 0;
  double all = 0;
  for (Index j = 0; j < matrix.cols(); ++j) {
    double sum = 0;
    for (Index i = 0; i < matrix.rows(); ++i)
      sum += std::abs(matrix(i, j));
    largest = std::max(largest, sum);
    all += sum;
  }
  return std::isfinite(all) ? largest : all;
}

/// Columns whose multiples are subtracted in one pass over a column.
constexpr Index at_once = 4;

/// column = L⁻¹ column with the first `count` columns of L, on all rows.
void eliminate(const MatrixXd& factors, Index count, double* column) {
  for (Index first = 0; first < count; first += at_once) {
    const Index end = std::min(first + at_once, count);
    for (Index k = first; k < end; ++k)
      for (Index i = k + 1; i < end; ++i)
        column[i] -= factors(i, k) * column[k];
    ColumnSum below(column + end, factors.rows() - end);
    for (Index k = first; k < end; ++k)
      below.add(-column[k], &factors(0, k) + end);
    below.add_rest();
  }
}

/// P A = L U in place, column by column. False where a pivot is zero.
bool factor_in_place(MatrixXd& a, std::vector<int>& swapped_with) {
  const Index size = a.rows();
  swapped_with.resize(static_cast<std::size_t>(size));
  for (Index j = 0; j < size; ++j) {
    double* const column = &a(0, j);
    for (Index k = 0; k < j; ++k)
      std::swap(column[k], column[swapped_with[static_cast<std::size_t>(k)]]);
    eliminate(a, j, column);
    Index pivot = j;
    for (Index i = j + 1; i < size; ++i)
      if (std::abs(column[i]) > std::abs(column[pivot]))
        pivot = i;
    swapped_with[static_cast<std::size_t>(j)] = static_cast<int>(pivot);
    if (column[pivot] == 0)
      return false;
    if (pivot != j)
      for (Index k = 0; k <= j; ++k)
        std::swap(a(j, k), a(pivot, k));
    const double divisor = column[j];
    for (Index i = j + 1; i < size; ++i)
      column[i] /= divisor;
  }
  return true;
}

void solve_in_place(const MatrixXd& factors, const std::vector<int>& swapped_with, double* x) {
  const Index size = factors.rows();
  for (Index k = 0; k < size; ++k)
    std::swap(x[k], x[swapped_with[static_cast<std::size_t>(k)]]);
  eliminate(factors, size, x);
  for (Index j = size - 1; j >= 0; --j) {
    const double* const column = &factors(0, j);
    const double value = x[j] /= column[j];
    for (Index i = 0; i < j; ++i)
      x[i] -= value * column[i];
  }
}

/// LAPACK's estimate in the 1-norm.
double reciprocal_condition(const MatrixXd& factors, double matrix_norm) {
  const auto size = static_cast<int>(factors.rows());
  std::vector<double> work(4 * static_cast<std::size_t>(size));
  std::vector<int> integer_work(static_cast<std::size_t>(size));
  double condition = 0;
  int info = 0;
  dgecon_("1", &size, factors.data(), &size, &matrix_norm, &condition, work.data(), integer_work.data(),
          &info);
  return info == 0 ? condition : 0;
}

} // namespace

std::optional<DenseLu> DenseLu::of(MatrixXd matrix, const Threads& threads) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("LU factors of a matrix that is not square");
  if (!std::isfinite(largest_column_sum(matrix)))
    return std::nullopt;
  DenseLu lu;
  lu.factors_ = std::move(matrix);
  const bool sound = lu.factors_.rows() <= without_estimate ? lu.factor_small() : lu.factor_large(threads);
  return sound ? std::optional(std::move(lu)) : std::nullopt;
}

bool DenseLu::factor_small() {
  if (factors_.rows() == 0)
    return true;
  const double norm = largest_column_sum(factors_);
  return factor_in_place(factors_, pivots_) &&
         (beyond_doubt(factors_) || reciprocal_condition(factors_, norm) > singular);
}

bool DenseLu::factor_large(const Threads& threads) {
  use_one_blas_thread_by_default();
  const double norm = largest_column_sum(factors_);
  const auto size = static_cast<int>(factors_.rows());
  pivots_.resize(static_cast<std::size_t>(size));
  std::optional<BlasThreads> side_by_side;
  if (threads.count() > 1 && size >= fewest_by_threads)
    side_by_side.emplace(threads.count());
  int info = 0;
  dgetrf_(&size, &size, factors_.data(), &size, pivots_.data(), &info);
  return info == 0 && (beyond_doubt(factors_) || reciprocal_condition(factors_, norm) > singular);
}

Eigen::VectorXd DenseLu::solve(Eigen::VectorXd right_side) const {
  const auto size = static_cast<int>(factors_.rows());
  if (right_side.size() != size)
    throw std::invalid_argument("a right side of another size than the factored matrix");
  if (size <= without_estimate) {
    solve_in_place(factors_, pivots_, right_side.data());
    return right_side;
  }
  const int one = 1;
  int info = 0;
  if (size > 0)
    dgetrs_("N", &size, &one, factors_.data(), &size, pivots_.data(), right_side.data(), &size, &info);
  return right_side;
}

} // namespace rubato::linalg
