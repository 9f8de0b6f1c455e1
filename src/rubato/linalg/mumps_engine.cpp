// SPDX-License-Identifier: LGPL-3.0-or-later
// Sequential MUMPS. Its library and the MPI stub it wants are folded into one object whose only visible name
// is rubato_dmumps_c (cmake/FindMUMPS.cmake), because libmedC brings a real MPI into the same process.
#include "rubato/linalg/blas_threads.hpp"
#include "rubato/linalg/lu_engine.hpp"
#include "rubato/linalg/pivots.hpp"

#include <dmumps_c.h>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

extern "C" void rubato_dmumps_c(DMUMPS_STRUC_C* problem);

namespace rubato::linalg {
namespace {

enum Job : int { start = -1, finish = -2, analyse = 1, factorise = 2, solve = 3 };

enum Ordering : int { approximate_minimum_fill = 2, scotch = 3 };
/// From here on Scotch orders better (n = 20,000: factor in 0.9 s against 1.4 s), below it is only slower (n
/// = 3,000: 0.06 s against 0.044 s). PORD does as well, but leaves the process with exit() on systems with
/// dense columns.
constexpr int least_order_for_scotch = 5000;

/// What MUMPS may take for granted, by the manual's numbers.
enum class Symmetry : int { none = 0, indefinite = 2 };

/// The manual's control numbers, which count from 1.
void set_control(DMUMPS_STRUC_C& problem, int number, int value) {
  problem.icntl[number - 1] = value;
}

class MumpsEngine final : public LuEngine {
public:
  MumpsEngine(const SparseMatrix& matrix, Symmetry symmetry) : order_(static_cast<int>(matrix.cols())) {
    use_one_blas_thread_by_default();
    problem_.sym = static_cast<int>(symmetry);
    problem_.par = 1;
    problem_.comm_fortran = -987654; // the manual's "all processes"
    run(Job::start);
    for (int stream = 1; stream <= 3; ++stream)
      set_control(problem_, stream, -1);
    set_control(problem_, 4, 0); // print nothing
    set_control(problem_, 7,
                order_ < least_order_for_scotch ? Ordering::approximate_minimum_fill : Ordering::scotch);
    set_control(problem_, 8, 0);          // no scaling: already equilibrated
    set_control(problem_, 24, 1);         // count negligible pivots…
    problem_.cntl[2] = -negligible_pivot; // …those below this absolute size
    fill_triplets(matrix, symmetry == Symmetry::indefinite);
  }
  ~MumpsEngine() override { run(Job::finish); }

  /// False when the matrix is singular to working precision.
  bool factorise() {
    problem_.n = order_;
    problem_.nnz = static_cast<MUMPS_INT8>(values_.size());
    problem_.irn = rows_.data();
    problem_.jcn = columns_.data();
    problem_.a = values_.data();
    run(Job::analyse);
    if (is_singular())
      return false;
    check();
    factorise_with_enough_memory();
    const bool regular = !is_singular() && negligible_pivot_count() == 0;
    if (regular)
      check();
    release_triplets();
    return regular;
  }

  /// Of a symmetric matrix: as many as it has negative eigenvalues.
  int negative_pivots() const { return problem_.infog[11]; }

  void solve_in_place(Eigen::VectorXd& values) override {
    problem_.rhs = values.data();
    problem_.nrhs = 1;
    problem_.lrhs = order_;
    run(Job::solve);
    check();
  }

private:
  void run(Job job) {
    problem_.job = job;
    rubato_dmumps_c(&problem_);
  }

  void fill_triplets(const SparseMatrix& matrix, bool lower_only) {
    const auto all = static_cast<std::size_t>(matrix.nonZeros());
    const auto count = lower_only ? (all + static_cast<std::size_t>(order_)) / 2 : all;
    rows_.reserve(count);
    columns_.reserve(count);
    values_.reserve(count);
    for (int column = 0; column < matrix.cols(); ++column)
      for (SparseMatrix::InnerIterator entry(matrix, column); entry; ++entry) {
        if (lower_only && entry.row() < column)
          continue;
        rows_.push_back(static_cast<MUMPS_INT>(entry.row()) + 1);
        columns_.push_back(column + 1);
        values_.push_back(entry.value());
      }
  }

  void release_triplets() {
    rows_ = {};
    columns_ = {};
    values_ = {};
    problem_.irn = problem_.jcn = nullptr;
    problem_.a = nullptr;
  }

  /// Pivots delayed for stability need more room than the analysis foresaw; MUMPS says so and is given more.
  void factorise_with_enough_memory() {
    for (int percent_more = 30; percent_more < 2000; percent_more *= 2) {
      set_control(problem_, 14, percent_more);
      run(Job::factorise);
      const auto status = problem_.infog[0];
      if (status != -8 && status != -9)
        return;
    }
  }

  /// Structurally (−6) or numerically (−10).
  bool is_singular() const { return problem_.infog[0] == -6 || problem_.infog[0] == -10; }
  int negligible_pivot_count() const { return problem_.infog[27]; }

  void check() const {
    const auto status = problem_.infog[0];
    if (status == -7 || status == -8 || status == -9 || status == -13 || status == -19)
      throw std::bad_alloc();
    if (status < 0)
      throw std::logic_error("MUMPS stopped with status " + std::to_string(status) + ".");
  }

  DMUMPS_STRUC_C problem_{};
  int order_;
  std::vector<MUMPS_INT> rows_;
  std::vector<MUMPS_INT> columns_;
  std::vector<double> values_;
};

} // namespace

std::unique_ptr<LuEngine> mumps_engine(const SparseMatrix& matrix) {
  auto engine = std::make_unique<MumpsEngine>(matrix, Symmetry::none);
  return engine->factorise() ? std::move(engine) : nullptr;
}

SymmetricEngine symmetric_mumps_engine(const SparseMatrix& matrix) {
  auto engine = std::make_unique<MumpsEngine>(matrix, Symmetry::indefinite);
  if (!engine->factorise())
    return {};
  const int negative = engine->negative_pivots();
  return {std::move(engine), negative};
}

} // namespace rubato::linalg
