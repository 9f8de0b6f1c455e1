// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_decompositions.hpp"

#include "rubato/linalg/blas.hpp"
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/pivoted_qr.hpp"

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

/// Of LAPACK's divide and conquer, for values and vectors.
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

/// P A Pᵀ = L D Lᵀ, the largest pivot first; L below the diagonal of A, which has D.
class PivotedLdlt {
public:
  explicit PivotedLdlt(MatrixXd matrix) : a_(std::move(matrix)) {
    swapped_with_.resize(static_cast<std::size_t>(size()));
    scaled_.resize(swapped_with_.size());
    for (Index k = 0; k < size(); ++k) {
      bring_largest_to(k);
      eliminate(k);
    }
  }

  void solve(double* x) const {
    for (Index k = 0; k < size(); ++k)
      std::swap(x[k], x[swapped_with_[static_cast<std::size_t>(k)]]);
    for (Index j = 0; j < size(); ++j)
      for (Index i = j + 1; i < size(); ++i)
        x[i] -= a_(i, j) * x[j];
    for (Index i = 0; i < size(); ++i)
      x[i] = std::abs(a_(i, i)) > std::numeric_limits<double>::min() ? x[i] / a_(i, i) : 0.0;
    for (Index i = size() - 1; i >= 0; --i)
      for (Index j = i + 1; j < size(); ++j)
        x[i] -= a_(j, i) * x[j];
    for (Index k = size() - 1; k >= 0; --k)
      std::swap(x[k], x[swapped_with_[static_cast<std::size_t>(k)]]);
  }

private:
  Index size() const { return a_.rows(); }

  void bring_largest_to(Index k) {
    Index p = k;
    for (Index i = k + 1; i < size(); ++i)
      if (std::abs(a_(i, i)) > std::abs(a_(p, p)))
        p = i;
    swapped_with_[static_cast<std::size_t>(k)] = p;
    if (p == k)
      return;
    for (Index j = 0; j < k; ++j)
      std::swap(a_(k, j), a_(p, j));
    for (Index i = p + 1; i < size(); ++i)
      std::swap(a_(i, k), a_(i, p));
    for (Index i = k + 1; i < p; ++i)
      std::swap(a_(i, k), a_(p, i));
    std::swap(a_(k, k), a_(p, p));
  }

  void eliminate(Index k) {
    for (Index j = 0; j < k; ++j)
      scaled_[static_cast<std::size_t>(j)] = a_(j, j) * a_(k, j);
    for (Index j = 0; j < k; ++j)
      for (Index i = k; i < size(); ++i)
        a_(i, k) -= a_(i, j) * scaled_[static_cast<std::size_t>(j)];
    if (a_(k, k) != 0)
      for (Index i = k + 1; i < size(); ++i)
        a_(i, k) /= a_(k, k);
  }

  MatrixXd a_;
  std::vector<Index> swapped_with_;
  std::vector<double> scaled_;
};

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
  const PivotedLdlt factor(a);
  MatrixXd x = b;
  for (Index j = 0; j < x.cols(); ++j)
    factor.solve(&x(0, j));
  return x;
}

VectorXd least_norm_solution(const MatrixXd& a, const VectorXd& b) {
  return PivotedQr(a).least_norm(b);
}

MatrixXd pseudo_inverse(const MatrixXd& a) {
  return PivotedQr(a).least_norm(MatrixXd::Identity(a.rows(), a.rows()));
}

} // namespace rubato::linalg
