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

/// Eigen is done with such a matrix before LAPACK has begun.
constexpr int small = 48;

} // namespace

Eigen::VectorXd solve_positive_definite(Eigen::MatrixXd matrix, Eigen::VectorXd right_side) {
  const auto size = static_cast<int>(right_side.size());
  if (matrix.rows() != size || matrix.cols() != size)
    throw std::invalid_argument("a right side of another size than the matrix");
  if (size == 0)
    return right_side;
  if (size <= small) {
    const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
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

std::optional<Eigen::MatrixXd> inverse_of_positive_definite(Eigen::MatrixXd matrix) {
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
  matrix.triangularView<Eigen::StrictlyLower>() = matrix.transpose();
  return matrix;
}

Eigen::VectorXd solve_among(std::span<const Eigen::Index> unknowns, const Eigen::MatrixXd& matrix,
                            const Eigen::VectorXd& values) {
  Eigen::MatrixXd among = matrix(unknowns, unknowns);
  Eigen::VectorXd right_side = -values(unknowns);
  return solve_positive_definite(std::move(among), std::move(right_side));
}

std::vector<int> independent_rows(Eigen::MatrixXd matrix, double tolerance) {
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
