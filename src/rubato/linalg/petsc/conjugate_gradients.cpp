// SPDX-License-Identifier: LGPL-3.0-or-later
// Smoothed aggregation (GAMG), which knows the rigid motions of bodies (Vaněk, Mandel, Brezina 1996).
#include "rubato/linalg/conjugate_gradients.hpp"

#include "rubato/linalg/petsc/session.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <petscksp.h>
#include <utility>
#include <vector>

namespace rubato::linalg::petsc {
namespace {

/// Neighbours that are coupled by less than this part of their diagonals do not make one aggregate.
constexpr PetscReal weak_coupling = 0.01;

/// An object of PETSc, destroyed when it goes; one that outlives PETSc went with it.
template <class Object, PetscErrorCode (*destroy)(Object*)> class Handle {
public:
  Handle() = default;
  ~Handle() {
    PetscBool ended = PETSC_TRUE;
    PetscFinalized(&ended);
    if (!ended)
      destroy(&object_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  Handle(Handle&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Handle& operator=(Handle&&) = delete;

  Object get() const { return object_; }
  /// Where PETSc puts a new one.
  Object* fresh() {
    check(destroy(&object_));
    return &object_;
  }

private:
  Object object_ = nullptr;
};

using Matrix = Handle<Mat, MatDestroy>;
using Vector = Handle<Vec, VecDestroy>;
using Solver = Handle<KSP, KSPDestroy>;
using Motions = Handle<MatNullSpace, MatNullSpaceDestroy>;

/// The coarsest grid is factored, which fails of no positive definite matrix.
bool is_indefinite(KSPConvergedReason reason) {
  return reason == KSP_DIVERGED_INDEFINITE_MAT || reason == KSP_DIVERGED_INDEFINITE_PC ||
         reason == KSP_DIVERGED_PC_FAILED;
}

ConjugateGradients::Ending ending_of(KSPConvergedReason reason) {
  if (reason > 0)
    return ConjugateGradients::Ending::solved;
  return is_indefinite(reason) ? ConjugateGradients::Ending::indefinite
                               : ConjugateGradients::Ending::unfinished;
}

/// The matrix is dealt out by rows to the processes of a communicator.
class Rows final : public ConjugateGradients {
public:
  explicit Rows(MPI_Comm communicator) : communicator_(communicator) {}

  void set(const MatrixByRows& matrix) override {
    const std::lock_guard lock(in_use());
    solver_.fresh();
    deal_out(matrix);
    create(matrix);
    fill(matrix);
    put_motions(matrix);
    prepare();
  }

  Outcome solve(const Eigen::VectorXd& b, Eigen::VectorXd& x, double tolerance,
                int most_iterations) override {
    const std::lock_guard lock(in_use());
    check(VecPlaceArray(b_.get(), b.data() + starts_[rank_]));
    check(VecPlaceArray(x_.get(), x.data() + starts_[rank_]));
    PetscReal size = 0;
    const auto unmeasured = VecNorm(b_.get(), NORM_2, &size);
    check(KSPSetTolerances(solver_.get(), tolerance, std::numeric_limits<PetscReal>::min(), PETSC_DEFAULT,
                           most_iterations));
    const auto failed = KSPSolve(solver_.get(), b_.get(), x_.get());
    check(VecResetArray(b_.get()));
    check(VecResetArray(x_.get()));
    check(unmeasured);
    check(failed);
    share(x);
    return outcome(size);
  }

private:
  void deal_out(const MatrixByRows& matrix) {
    int ranks = 1, own = 0;
    MPI_Comm_size(communicator_, &ranks);
    MPI_Comm_rank(communicator_, &own);
    rank_ = static_cast<std::size_t>(own);
    const std::int64_t nodes = matrix.size / matrix.block;
    starts_.clear();
    for (int rank = 0; rank <= ranks; ++rank)
      starts_.push_back(static_cast<int>(nodes * rank / ranks) * matrix.block);
    counts_.resize(static_cast<std::size_t>(ranks));
    for (std::size_t rank = 0; rank < counts_.size(); ++rank)
      counts_[rank] = starts_[rank + 1] - starts_[rank];
  }

  /// Every rank gets the rows of all.
  void share(Eigen::VectorXd& x) const {
    if (counts_.size() > 1)
      MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, x.data(), counts_.data(), starts_.data(), MPI_DOUBLE,
                     communicator_);
  }

  void create(const MatrixByRows& matrix) {
    check(MatCreate(communicator_, matrix_.fresh()));
    check(MatSetSizes(matrix_.get(), counts_[rank_], counts_[rank_], matrix.size, matrix.size));
    check(MatSetBlockSize(matrix_.get(), matrix.block));
    check(MatSetType(matrix_.get(), MATAIJ));
    make_room(matrix);
    check(MatSetOption(matrix_.get(), MAT_SPD, PETSC_TRUE));
    check(MatCreateVecs(matrix_.get(), x_.fresh(), b_.fresh()));
  }

  /// Entries in columns of this rank, and in others, are counted apart.
  void make_room(const MatrixByRows& matrix) {
    check(MatSeqAIJSetPreallocation(matrix_.get(), 0, matrix.entries_of_row.data()));
    if (counts_.size() == 1)
      return;
    std::vector<PetscInt> own, others;
    std::vector<int> columns;
    std::vector<double> values;
    for (int row = starts_[rank_]; row < starts_[rank_ + 1]; ++row) {
      matrix.row(row, columns, values);
      own.push_back(static_cast<PetscInt>(std::ranges::count_if(
          columns, [&](int column) { return column >= starts_[rank_] && column < starts_[rank_ + 1]; })));
      others.push_back(static_cast<PetscInt>(columns.size()) - own.back());
    }
    check(MatMPIAIJSetPreallocation(matrix_.get(), 0, own.data(), 0, others.data()));
  }

  void fill(const MatrixByRows& matrix) {
    PetscInt first = 0, end = 0;
    check(MatGetOwnershipRange(matrix_.get(), &first, &end));
    std::vector<int> columns;
    std::vector<double> values;
    for (PetscInt row = first; row < end; ++row) {
      matrix.row(row, columns, values);
      check(MatSetValues(matrix_.get(), 1, &row, static_cast<PetscInt>(columns.size()), columns.data(),
                         values.data(), INSERT_VALUES));
    }
    check(MatAssemblyBegin(matrix_.get(), MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(matrix_.get(), MAT_FINAL_ASSEMBLY));
  }

  void put_motions(const MatrixByRows& matrix) {
    std::vector<Vector> motions(static_cast<std::size_t>(matrix.near_null.cols()));
    std::vector<Vec> of_petsc;
    for (std::size_t k = 0; k < motions.size(); ++k) {
      check(VecDuplicate(x_.get(), motions[k].fresh()));
      PetscScalar* values = nullptr;
      check(VecGetArray(motions[k].get(), &values));
      std::copy_n(matrix.near_null.col(static_cast<Eigen::Index>(k)).data() + starts_[rank_], counts_[rank_],
                  values);
      check(VecRestoreArray(motions[k].get(), &values));
      of_petsc.push_back(motions[k].get());
    }
    check(MatNullSpaceCreate(communicator_, PETSC_FALSE, static_cast<PetscInt>(of_petsc.size()),
                             of_petsc.data(), motions_.fresh()));
    check(MatSetNearNullSpace(matrix_.get(), motions_.get()));
  }

  void prepare() {
    check(KSPCreate(communicator_, solver_.fresh()));
    check(KSPSetType(solver_.get(), KSPCG));
    check(KSPSetNormType(solver_.get(), KSP_NORM_UNPRECONDITIONED));
    check(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()));
    PC preconditioner = nullptr;
    check(KSPGetPC(solver_.get(), &preconditioner));
    check(PCSetType(preconditioner, PCGAMG));
    PetscReal threshold = weak_coupling;
    check(PCGAMGSetThreshold(preconditioner, &threshold, 1));
    check(KSPSetUp(solver_.get()));
  }

  Outcome outcome(double of_right_side) const {
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    PetscReal left = 0;
    check(KSPGetConvergedReason(solver_.get(), &reason));
    check(KSPGetIterationNumber(solver_.get(), &iterations));
    check(KSPGetResidualNorm(solver_.get(), &left));
    return {ending_of(reason), iterations, left / of_right_side};
  }

  MPI_Comm communicator_;
  std::size_t rank_ = 0;
  std::vector<int> starts_; ///< the first row of each rank, and how many there are
  std::vector<int> counts_; ///< rows of each
  Matrix matrix_;
  Motions motions_;
  Vector x_, b_; ///< without values of their own while nothing is solved
  Solver solver_;
};

} // namespace
} // namespace rubato::linalg::petsc

extern "C" __attribute__((visibility("default"))) void
rubato_make_conjugate_gradients_2(std::unique_ptr<rubato::linalg::ConjugateGradients>& made,
                                  bool of_all_ranks) {
  rubato::linalg::petsc::start();
  made = std::make_unique<rubato::linalg::petsc::Rows>(of_all_ranks ? PETSC_COMM_WORLD : PETSC_COMM_SELF);
}
