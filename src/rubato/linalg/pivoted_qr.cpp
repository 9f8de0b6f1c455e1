// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/pivoted_qr.hpp"

#include "rubato/linalg/blas.hpp"
#include "rubato/linalg/blas_threads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Columns that LAPACK works on at once.
constexpr int block = 32;

std::vector<double> workspace(Index columns) {
  return std::vector<double>(static_cast<std::size_t>((columns + 1) * (block + 2)));
}

/// Solves with the upper triangle of the first `count` columns, in the first rows of `values`.
void solve_upper(const MatrixXd& factors, Index count, MatrixXd& values) {
  const auto size = static_cast<int>(count);
  const auto columns = static_cast<int>(values.cols());
  const auto stride = static_cast<int>(factors.rows());
  const auto values_stride = static_cast<int>(values.rows());
  const double one = 1;
  if (size > 0 && columns > 0)
    dtrsm_("L", "U", "N", "N", &size, &columns, &one, factors.data(), &stride, values.data(), &values_stride);
}

} // namespace

PivotedQr::PivotedQr(MatrixXd matrix) : factors_(std::move(matrix)) {
  use_one_blas_thread_by_default();
  const auto rows = static_cast<int>(factors_.rows());
  const auto columns = static_cast<int>(factors_.cols());
  reflection_factors_.resize(static_cast<std::size_t>(std::min(rows, columns)));
  pivots_.resize(static_cast<std::size_t>(columns), 0);
  if (reflection_factors_.empty())
    return;
  auto work = std::vector<double>(static_cast<std::size_t>(2 * columns + (columns + 1) * block));
  const auto work_size = static_cast<int>(work.size());
  int info = 0;
  dgeqp3_(&rows, &columns, factors_.data(), &rows, pivots_.data(), reflection_factors_.data(), work.data(),
          &work_size, &info);
}

Index PivotedQr::rank() const {
  const auto count = static_cast<Index>(reflection_factors_.size());
  double largest = 0;
  for (Index k = 0; k < count; ++k)
    largest = std::max(largest, std::abs(factors_(k, k)));
  Index found = 0;
  for (Index k = 0; k < count; ++k)
    found += std::abs(factors_(k, k)) > largest * epsilon * static_cast<double>(count) ? 1 : 0;
  return found;
}

/// The number of pivots that are not rounding of the largest one.
Index PivotedQr::pivots_beyond_rounding() const {
  const auto count = static_cast<Index>(reflection_factors_.size());
  const auto rows = static_cast<double>(factors_.rows());
  for (Index k = 0; k < count; ++k)
    if (const double left = (rows - static_cast<double>(k)) / rows;
        std::abs(factors_(k, k)) < std::abs(factors_(0, 0)) * epsilon * std::sqrt(left))
      return k;
  return count;
}

MatrixXd PivotedQr::solve(MatrixXd right_sides) const {
  if (right_sides.rows() != factors_.rows())
    throw std::invalid_argument("right sides of another size than the columns of the factored matrix");
  const Index count = pivots_beyond_rounding();
  apply_transposed(count, right_sides);
  solve_upper(factors_, count, right_sides);
  return in_order_of_unknowns(right_sides, count);
}

MatrixXd PivotedQr::least_norm(MatrixXd right_sides) const {
  if (right_sides.rows() != factors_.rows())
    throw std::invalid_argument("right sides of another size than the columns of the factored matrix");
  const Index count = rank();
  const Index unknowns = factors_.cols();
  apply_transposed(static_cast<Index>(reflection_factors_.size()), right_sides);
  if (count == unknowns || count == 0) {
    solve_upper(factors_, count, right_sides);
    return in_order_of_unknowns(right_sides, count);
  }
  // R of the first rows = (T 0) Z with orthogonal Z.
  const auto rows = static_cast<int>(count);
  const auto columns = static_cast<int>(unknowns);
  const int beyond = columns - rows;
  MatrixXd trapezoid(count, unknowns);
  for (Index j = 0; j < unknowns; ++j)
    for (Index i = 0; i < count; ++i)
      trapezoid(i, j) = i <= j ? factors_(i, j) : 0.0;
  std::vector<double> of_trapezoid(static_cast<std::size_t>(rows));
  auto work = workspace(std::max(unknowns, right_sides.cols()));
  const auto work_size = static_cast<int>(work.size());
  int info = 0;
  dtzrzf_(&rows, &columns, trapezoid.data(), &rows, of_trapezoid.data(), work.data(), &work_size, &info);
  solve_upper(trapezoid, count, right_sides);
  MatrixXd solution = MatrixXd::Zero(unknowns, right_sides.cols());
  for (Index j = 0; j < solution.cols(); ++j)
    std::copy_n(&right_sides(0, j), count, &solution(0, j));
  const auto sides = static_cast<int>(solution.cols());
  dormrz_("L", "T", &columns, &sides, &rows, &beyond, trapezoid.data(), &rows, of_trapezoid.data(),
          solution.data(), &columns, work.data(), &work_size, &info);
  return in_order_of_unknowns(solution, unknowns);
}

MatrixXd PivotedQr::basis() const {
  const Index count = rank();
  MatrixXd columns(factors_.rows(), count);
  std::copy_n(factors_.data(), columns.size(), columns.data());
  const auto rows = static_cast<int>(columns.rows());
  const auto vectors = static_cast<int>(count);
  auto work = workspace(count);
  const auto work_size = static_cast<int>(work.size());
  int info = 0;
  if (vectors > 0)
    dorgqr_(&rows, &vectors, &vectors, columns.data(), &rows, reflection_factors_.data(), work.data(),
            &work_size, &info);
  return columns;
}

/// values = Qᵀ values with the first reflections of Q.
void PivotedQr::apply_transposed(Index reflections, MatrixXd& values) const {
  const auto rows = static_cast<int>(values.rows());
  const auto columns = static_cast<int>(values.cols());
  const auto count = static_cast<int>(reflections);
  auto work = workspace(values.cols());
  const auto work_size = static_cast<int>(work.size());
  int info = 0;
  if (count > 0 && columns > 0)
    dormqr_("L", "T", &rows, &columns, &count, factors_.data(), &rows, reflection_factors_.data(),
            values.data(), &rows, work.data(), &work_size, &info);
}

/// The solution in the order of the columns of A. The first `count` rows are given, the others are 0.
MatrixXd PivotedQr::in_order_of_unknowns(const MatrixXd& values, Index count) const {
  MatrixXd ordered = MatrixXd::Zero(factors_.cols(), values.cols());
  for (Index j = 0; j < ordered.cols(); ++j)
    for (Index i = 0; i < count; ++i)
      ordered(pivots_[static_cast<std::size_t>(i)] - 1, j) = values(i, j);
  return ordered;
}

} // namespace rubato::linalg
