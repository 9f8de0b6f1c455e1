// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_cholesky.hpp"

#include "rubato/linalg/blas.hpp"
#include "rubato/linalg/blas_threads.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Eigen is done with such a matrix before LAPACK has begun.
constexpr int small = 48;

} // namespace

DenseCholesky::DenseCholesky(MatrixXd matrix) : factor_(std::move(matrix)) {
  const auto size = static_cast<int>(factor_.rows());
  if (factor_.cols() != size)
    throw std::invalid_argument("Cholesky factors of a matrix that is not square");
  use_one_blas_thread_by_default();
  int info = 0;
  if (size > 0)
    dpotrf_("L", &size, factor_.data(), &size, &info);
  if (info != 0)
    factor_.setConstant(std::numeric_limits<double>::quiet_NaN());
}

VectorXd DenseCholesky::solve(VectorXd right_side) const {
  solve_in_place(right_side.data(), 1);
  return right_side;
}

MatrixXd DenseCholesky::solve(MatrixXd right_sides) const {
  solve_in_place(right_sides.data(), right_sides.cols());
  return right_sides;
}

void DenseCholesky::solve_in_place(double* values, Index columns) const {
  const auto size = static_cast<int>(factor_.rows());
  const auto count = static_cast<int>(columns);
  const double one = 1;
  if (size == 0 || count == 0)
    return;
  for (const char* transposed : {"N", "T"})
    dtrsm_("L", "L", transposed, "N", &size, &count, &one, factor_.data(), &size, values, &size);
}

VectorXd solve_positive_definite(MatrixXd matrix, VectorXd right_side) {
  const auto size = static_cast<int>(right_side.size());
  if (matrix.rows() != size || matrix.cols() != size)
    throw std::invalid_argument("a right side of another size than the matrix");
  if (size == 0)
    return right_side;
  if (size <= small) {
    const Eigen::LLT<MatrixXd> factor(matrix);
    if (factor.info() == Eigen::Success)
      return factor.solve(right_side);
    right_side.setConstant(std::numeric_limits<double>::quiet_NaN());
    return right_side;
  }
  use_one_blas_thread_by_default();
  const int one = 1;
  int info = 0;
  dposv_("L", &size, &one, matrix.data(), &size, right_side.data(), &size, &info);
  if (info != 0)
    right_side.setConstant(std::numeric_limits<double>::quiet_NaN());
  return right_side;
}

std::optional<MatrixXd> inverse_of_positive_definite(MatrixXd matrix) {
  const auto size = static_cast<int>(matrix.rows());
  if (matrix.cols() != size)
    throw std::invalid_argument("the inverse of a matrix that is not square");
  if (size == 0)
    return matrix;
  use_one_blas_thread_by_default();
  int info = 0;
  dpotrf_("U", &size, matrix.data(), &size, &info);
  if (info == 0)
    dpotri_("U", &size, matrix.data(), &size, &info);
  if (info != 0)
    return std::nullopt;
  for (Index j = 0; j < size; ++j)
    for (Index i = j + 1; i < size; ++i)
      matrix(i, j) = matrix(j, i);
  return matrix;
}

VectorXd solve_among(std::span<const Index> unknowns, const MatrixXd& matrix, const VectorXd& values) {
  const auto count = static_cast<Index>(unknowns.size());
  MatrixXd among(count, count);
  VectorXd right_side(count);
  for (Index j = 0; j < count; ++j) {
    const Index unknown = unknowns[static_cast<std::size_t>(j)];
    right_side[j] = -values[unknown];
    for (Index i = 0; i < count; ++i)
      among(i, j) = matrix(unknowns[static_cast<std::size_t>(i)], unknown);
  }
  return solve_positive_definite(std::move(among), std::move(right_side));
}

std::vector<int> independent_rows(MatrixXd matrix, double tolerance) {
  const auto size = static_cast<int>(matrix.rows());
  if (size == 0)
    return {};
  use_one_blas_thread_by_default();
  std::vector<int> pivots(static_cast<std::size_t>(size));
  std::vector<double> work(2 * pivots.size());
  int rank = 0;
  int info = 0;
  dpstrf_("L", &size, matrix.data(), &size, pivots.data(), &rank, &tolerance, work.data(), &info);
  pivots.resize(static_cast<std::size_t>(rank));
  for (auto& pivot : pivots)
    --pivot; // LAPACK counts from 1
  std::ranges::sort(pivots);
  return pivots;
}

} // namespace rubato::linalg
