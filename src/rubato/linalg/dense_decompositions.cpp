// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_decompositions.hpp"

#include "rubato/linalg/blas.hpp"
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/pivoted_qr.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace rubato::linalg {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double not_found = std::numeric_limits<double>::quiet_NaN();

/// The storage of LAPACK's divide and conquer, for values and vectors.
struct EigenStorage {
  explicit EigenStorage(int size)
      : work(static_cast<std::size_t>(1 + 6 * size + 2 * size * size)),
        integer_work(static_cast<std::size_t>(3 + 5 * size)) {}
  std::vector<double> work;
  std::vector<int> integer_work;
};

SymmetricEigen found_eigen(MatrixXd vectors, VectorXd values, int info) {
  if (info != 0) {
    vectors.setConstant(not_found);
    values.setConstant(not_found);
  }
  return {std::move(values), std::move(vectors)};
}

} // namespace

SymmetricEigen symmetric_eigen(const MatrixXd& a) {
  use_one_blas_thread_by_default();
  const auto size = static_cast<int>(a.rows());
  MatrixXd vectors = a;
  VectorXd values(size);
  EigenStorage storage(size);
  const auto work_size = static_cast<int>(storage.work.size());
  const auto integer_size = static_cast<int>(storage.integer_work.size());
  int info = 0;
  if (size > 0)
    dsyevd_("V", "L", &size, vectors.data(), &size, values.data(), storage.work.data(), &work_size,
            storage.integer_work.data(), &integer_size, &info);
  return found_eigen(std::move(vectors), std::move(values), info);
}

VectorXd symmetric_eigenvalues(const MatrixXd& a) {
  use_one_blas_thread_by_default();
  const auto size = static_cast<int>(a.rows());
  MatrixXd matrix = a;
  VectorXd values(size);
  std::vector<double> work(static_cast<std::size_t>(2 * size + 1));
  const auto work_size = static_cast<int>(work.size());
  int integer_work = 0;
  const int one = 1;
  int info = 0;
  if (size > 0)
    dsyevd_("N", "L", &size, matrix.data(), &size, values.data(), work.data(), &work_size, &integer_work,
            &one, &info);
  if (info != 0)
    values.setConstant(not_found);
  return values;
}

double largest_of_tridiagonal(VectorXd diagonal, VectorXd beside) {
  const auto size = static_cast<int>(diagonal.size());
  int info = 0;
  if (size > 0)
    dsterf_(&size, diagonal.data(), beside.data(), &info);
  return size > 0 && info == 0 ? diagonal[size - 1] : not_found;
}

SymmetricEigen generalized_eigen(const MatrixXd& a, const MatrixXd& b) {
  use_one_blas_thread_by_default();
  const auto size = static_cast<int>(a.rows());
  MatrixXd vectors = a;
  MatrixXd factor = b;
  VectorXd values(size);
  EigenStorage storage(size);
  const auto work_size = static_cast<int>(storage.work.size());
  const auto integer_size = static_cast<int>(storage.integer_work.size());
  const int kind = 1; // A v = λ B v
  int info = 0;
  if (size > 0)
    dsygvd_(&kind, "V", "L", &size, vectors.data(), &size, factor.data(), &size, values.data(),
            storage.work.data(), &work_size, storage.integer_work.data(), &integer_size, &info);
  return found_eigen(std::move(vectors), std::move(values), info);
}

MatrixXd orthogonal_factor(const MatrixXd& a) {
  use_one_blas_thread_by_default();
  const auto rows = static_cast<int>(a.rows());
  const auto count = static_cast<int>(std::min(a.rows(), a.cols()));
  MatrixXd q = MatrixXd::Identity(rows, rows);
  if (count == 0)
    return q;
  std::copy_n(a.data(), static_cast<Index>(rows) * count, q.data());
  constexpr int block = 32;
  std::vector<double> factors(static_cast<std::size_t>(count));
  std::vector<double> work(static_cast<std::size_t>(rows) * block);
  const auto work_size = static_cast<int>(work.size());
  int info = 0;
  dgeqrf_(&rows, &count, q.data(), &rows, factors.data(), work.data(), &work_size, &info);
  dorgqr_(&rows, &rows, &count, q.data(), &rows, factors.data(), work.data(), &work_size, &info);
  return q;
}

MatrixXd solve_symmetric(const MatrixXd& a, const MatrixXd& b) {
  return PivotedQr(a).solve(b);
}

VectorXd least_norm_solution(const MatrixXd& a, const VectorXd& b) {
  return PivotedQr(a).least_norm(b);
}

MatrixXd pseudo_inverse(const MatrixXd& a) {
  return PivotedQr(a).least_norm(MatrixXd::Identity(a.rows(), a.rows()));
}

// Eigen's factors: among columns of equal length, as of nodes of a regular mesh, LAPACK's choose others by
// rounding.
std::vector<std::size_t> independent_columns(const MatrixXd& a, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(a);
  qr.setThreshold(threshold);
  const auto& order = qr.colsPermutation().indices();
  std::vector<std::size_t> columns;
  for (Index k = 0; k < qr.rank(); ++k)
    columns.push_back(static_cast<std::size_t>(order[k]));
  return columns;
}

} // namespace rubato::linalg
