// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/dense_lu.hpp"

#include "rubato/linalg/blas.hpp"
#include "rubato/linalg/blas_threads.hpp"

#include <Eigen/LU>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace rubato::linalg {
namespace {

using Eigen::MatrixXd;

constexpr double singular = 1e-15;
/// Pivots within this factor leave no doubt: the estimate costs more than the factors of a small matrix.
constexpr double doubtful = 1e-6;
constexpr Eigen::Index without_estimate = 48;
/// Rows from which on two threads are done sooner than one.
constexpr int fewest_by_threads = 1000;

bool beyond_doubt(const MatrixXd& factors) {
  const auto pivots = factors.diagonal().cwiseAbs();
  return pivots.minCoeff() > doubtful * pivots.maxCoeff();
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

struct DenseLu::Small {
  explicit Small(MatrixXd& matrix) : lu(matrix) {}

  Eigen::PartialPivLU<Eigen::Ref<MatrixXd>> lu;
};

DenseLu::DenseLu() = default;
DenseLu::DenseLu(DenseLu&&) noexcept = default;
DenseLu& DenseLu::operator=(DenseLu&&) noexcept = default;
DenseLu::~DenseLu() = default;

std::optional<DenseLu> DenseLu::of(MatrixXd matrix, const Threads& threads) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("LU factors of a matrix that is not square");
  if (!std::isfinite(matrix.cwiseAbs().sum()))
    return std::nullopt;
  DenseLu lu;
  lu.factors_ = std::move(matrix);
  const bool sound = lu.factors_.rows() <= without_estimate ? lu.factor_small() : lu.factor_large(threads);
  return sound ? std::optional(std::move(lu)) : std::nullopt;
}

bool DenseLu::factor_small() {
  if (factors_.rows() == 0)
    return true;
  small_ = std::make_unique<Small>(factors_);
  return beyond_doubt(factors_) || small_->lu.rcond() > singular;
}

bool DenseLu::factor_large(const Threads& threads) {
  use_one_blas_thread_by_default();
  const double norm = factors_.cwiseAbs().colwise().sum().maxCoeff();
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
  if (small_)
    return small_->lu.solve(right_side);
  const int one = 1;
  int info = 0;
  if (size > 0)
    dgetrs_("N", &size, &one, factors_.data(), &size, pivots_.data(), right_side.data(), &size, &info);
  return right_side;
}

} // namespace rubato::linalg
