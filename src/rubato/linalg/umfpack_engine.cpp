// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/lu_engine.hpp"
#include "rubato/linalg/pivots.hpp"

#include <array>
#include <new>
#include <stdexcept>
#include <string>
#include <suitesparse/umfpack.h>

namespace rubato::linalg {
namespace {

class UmfpackEngine final : public LuEngine {
public:
  explicit UmfpackEngine(const SparseMatrix& matrix) : matrix_(matrix) {
    use_one_blas_thread_by_default();
    umfpack_di_defaults(control_.data());
    control_[UMFPACK_SCALE] = UMFPACK_SCALE_NONE; // already equilibrated
    control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_METIS;
    control_[UMFPACK_IRSTEP] = 1; // one step of refinement repairs what weak pivoting on the diagonal costs
  }
  ~UmfpackEngine() override {
    umfpack_di_free_symbolic(&symbolic_);
    umfpack_di_free_numeric(&numeric_);
  }

  /// False when the matrix is singular to working precision.
  bool factorise() {
    const auto n = static_cast<int>(matrix_.cols());
    check(umfpack_di_symbolic(n, n, starts(), rows(), values(), &symbolic_, control_.data(), info_.data()));
    check(
        umfpack_di_numeric(starts(), rows(), values(), symbolic_, &numeric_, control_.data(), info_.data()));
    umfpack_di_free_symbolic(&symbolic_);
    return info_[UMFPACK_STATUS] == UMFPACK_OK && info_[UMFPACK_UMIN] > negligible_pivot;
  }

  void solve_in_place(Eigen::VectorXd& right_side) override {
    Eigen::VectorXd solution(right_side.size());
    check(umfpack_di_solve(UMFPACK_A, starts(), rows(), values(), solution.data(), right_side.data(),
                           numeric_, control_.data(), info_.data()));
    right_side.swap(solution);
  }

private:
  const int* starts() const { return matrix_.outerIndexPtr(); }
  const int* rows() const { return matrix_.innerIndexPtr(); }
  const double* values() const { return matrix_.valuePtr(); }

  static void check(int status) {
    if (status == UMFPACK_ERROR_out_of_memory)
      throw std::bad_alloc();
    if (status < 0)
      throw std::logic_error("UMFPACK stopped with status " + std::to_string(status) + ".");
  }

  const SparseMatrix& matrix_;
  std::array<double, UMFPACK_CONTROL> control_{};
  std::array<double, UMFPACK_INFO> info_{};
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
};

} // namespace

std::unique_ptr<LuEngine> umfpack_engine(const SparseMatrix& matrix) {
  auto engine = std::make_unique<UmfpackEngine>(matrix);
  return engine->factorise() ? std::move(engine) : nullptr;
}

} // namespace rubato::linalg
