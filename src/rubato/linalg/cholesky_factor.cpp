// SPDX-License-Identifier: LGPL-3.0-or-later
// CHOLMOD with long indices throughout: a factor of more than 2^31 entries then needs no second path.
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/direct_solver.hpp"
#include "rubato/linalg/pivots.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <new>
#include <span>
#include <stdexcept>
#include <suitesparse/cholmod.h>
#include <vector>

namespace rubato::linalg {
namespace {

using Index = SuiteSparse_long;

/// The lower triangle of a matrix, in arrays CHOLMOD can read.
struct LowerTriangle {
  std::vector<Index> starts;
  std::vector<Index> rows;
  std::vector<double> values;
  bool finite = true;

  explicit LowerTriangle(const SparseMatrix& matrix) {
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

  cholmod_sparse view() {
    cholmod_sparse sparse{};
    sparse.nrow = sparse.ncol = starts.size() - 1;
    sparse.nzmax = rows.size();
    sparse.p = starts.data();
    sparse.i = rows.data();
    sparse.x = values.data();
    sparse.stype = -1;
    sparse.itype = CHOLMOD_LONG;
    sparse.xtype = CHOLMOD_REAL;
    sparse.dtype = CHOLMOD_DOUBLE;
    sparse.sorted = 1;
    sparse.packed = 1;
    return sparse;
  }

  /// In the order of the unknowns; zero where the diagonal is not stored.
  std::vector<double> diagonal() const {
    std::vector<double> values_on_it(starts.size() - 1, 0.0);
    for (std::size_t column = 0; column < values_on_it.size(); ++column)
      for (auto entry = starts[column]; entry < starts[column + 1]; ++entry)
        if (rows[static_cast<std::size_t>(entry)] == static_cast<Index>(column))
          values_on_it[column] += values[static_cast<std::size_t>(entry)];
    return values_on_it;
  }
};

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

/// The diagonal of L in the order of elimination.
std::vector<double> factor_diagonal(const cholmod_factor& factor) {
  std::vector<double> diagonal;
  diagonal.reserve(factor.n);
  const auto* x = static_cast<const double*>(factor.x);
  if (!factor.is_super) {
    const std::span starts(static_cast<const Index*>(factor.p), factor.n);
    std::transform(starts.begin(), starts.end(), std::back_inserter(diagonal),
                   [x](Index start) { return x[start]; });
    return diagonal;
  }
  const auto* first_column = static_cast<const Index*>(factor.super);
  const auto* row_start = static_cast<const Index*>(factor.pi);
  const auto* value_start = static_cast<const Index*>(factor.px);
  for (std::size_t s = 0; s < factor.nsuper; ++s) {
    const auto column_count = first_column[s + 1] - first_column[s];
    const auto row_count = row_start[s + 1] - row_start[s];
    for (Index column = 0; column < column_count; ++column)
      diagonal.push_back(x[value_start[s] + column * (row_count + 1)]);
  }
  return diagonal;
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

[[noreturn]] void refuse_status(int status) {
  if (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE)
    throw std::bad_alloc();
  throw std::logic_error("CHOLMOD stopped with status " + std::to_string(status) + ".");
}

} // namespace

/// CHOLMOD's settings, the factor, and the work vectors that repeated solves reuse.
/// An empty matrix has no factor.
struct CholeskyFactor::Engine {
  cholmod_common common{};
  cholmod_factor* factor = nullptr;
  cholmod_dense* solution = nullptr;
  cholmod_dense* work_y = nullptr;
  cholmod_dense* work_e = nullptr;

  Engine() {
    use_one_blas_thread_by_default();
    cholmod_l_start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_METIS;
    common.postorder = 1;
    // Where supernodes do not pay (chains, tiny models), CHOLMOD works column by column; LLᵀ there too.
    common.supernodal = CHOLMOD_AUTO;
    common.final_ll = 1;
    common.quick_return_if_not_posdef = 1;
  }
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;
  ~Engine() {
    cholmod_l_free_dense(&solution, &common);
    cholmod_l_free_dense(&work_y, &common);
    cholmod_l_free_dense(&work_e, &common);
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
  }

  Eigen::Index order() const { return factor == nullptr ? 0 : static_cast<Eigen::Index>(factor->n); }

  /// False when the matrix is not positive definite.
  bool factorise(LowerTriangle& lower) {
    auto matrix = lower.view();
    if (matrix.ncol == 0)
      return true;
    factor = cholmod_l_analyze(&matrix, &common);
    if (factor == nullptr)
      refuse_status(common.status);
    cholmod_l_factorize(&matrix, factor, &common);
    if (common.status < CHOLMOD_OK)
      refuse_status(common.status);
    return common.status != CHOLMOD_NOT_POSDEF && factor->minor == factor->n &&
           !has_negligible_pivot(*factor, lower.diagonal());
  }
};

CholeskyFactor::CholeskyFactor(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}
CholeskyFactor::CholeskyFactor(CholeskyFactor&&) noexcept = default;
CholeskyFactor& CholeskyFactor::operator=(CholeskyFactor&&) noexcept = default;
CholeskyFactor::~CholeskyFactor() = default;

std::optional<CholeskyFactor> CholeskyFactor::of(const SparseMatrix& matrix) {
  if (matrix.rows() != matrix.cols())
    throw std::invalid_argument("CholeskyFactor::of wants a square matrix.");
  LowerTriangle lower(matrix);
  if (!lower.finite)
    return std::nullopt;
  auto engine = std::make_unique<Engine>();
  if (!engine->factorise(lower))
    return std::nullopt;
  return CholeskyFactor(std::move(engine));
}

Eigen::VectorXd CholeskyFactor::solve(const Eigen::VectorXd& right_side) const {
  auto& e = *engine_;
  if (right_side.size() != e.order())
    throw std::invalid_argument("CholeskyFactor::solve wants a right side of the matrix's size.");
  if (e.factor == nullptr)
    return {};
  auto b = view(right_side.data(), right_side.size(), 1);
  if (!cholmod_l_solve2(CHOLMOD_A, e.factor, &b, nullptr, &e.solution, nullptr, &e.work_y, &e.work_e,
                        &e.common))
    refuse_status(e.common.status);
  return Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(e.solution->x), right_side.size());
}

Eigen::MatrixXd CholeskyFactor::solve(const Eigen::MatrixXd& right_sides) const {
  auto& e = *engine_;
  if (right_sides.rows() != e.order())
    throw std::invalid_argument("CholeskyFactor::solve wants right sides of the matrix's size.");
  if (e.factor == nullptr)
    return right_sides;
  auto b = view(right_sides.data(), right_sides.rows(), right_sides.cols());
  auto* x = cholmod_l_solve(CHOLMOD_A, e.factor, &b, &e.common);
  if (x == nullptr)
    refuse_status(e.common.status);
  Eigen::MatrixXd solutions = Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x),
                                                                right_sides.rows(), right_sides.cols());
  cholmod_l_free_dense(&x, &e.common);
  return solutions;
}

std::size_t CholeskyFactor::factor_bytes() const {
  if (engine_->factor == nullptr)
    return 0;
  const auto& factor = *engine_->factor;
  const auto of_columns = 2 * factor.n * sizeof(Index);
  if (factor.is_super)
    return of_columns + factor.xsize * sizeof(double) +
           (factor.ssize + 3 * (factor.nsuper + 1)) * sizeof(Index);
  return of_columns + factor.nzmax * (sizeof(double) + sizeof(Index)) + (4 * factor.n + 5) * sizeof(Index);
}

} // namespace rubato::linalg
