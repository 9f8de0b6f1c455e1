// SPDX-License-Identifier: LGPL-3.0-or-later
// MUMPS over all ranks (Amestoy, Duff, L'Excellent, Koster 2001), entries where they are.
#include "rubato/linalg/factor_of_ranks.hpp"

#include "rubato/linalg/petsc/session.hpp"

#include <algorithm>
#include <dmumps_c.h>
#include <exception>
#include <limits>
#include <mpi.h>
#include <new>
#include <stdexcept>
#include <string>

namespace rubato::linalg::petsc {
namespace {

enum Job : int { start_job = -1, end_job = -2, analysis = 1, factorisation = 2, solution = 3 };
enum Symmetric : int { positive_definite = 1 };
/// The manual's numbers of controls, which count from 1.
enum Control : int {
  print_level = 4,
  ordering = 7,
  scaling = 8,
  more_room = 14, ///< than estimated [%]
  entries_from = 18,
  complement_wanted = 19,
  step_of_solution = 26,
  kind_of_analysis = 28
};
enum Step : int { whole = 0, down_to_surface = 1, up_from_surface = 2 };

class MumpsOfRanks final : public FactorOfRanks {
public:
  MumpsOfRanks() {
    problem_.sym = Symmetric::positive_definite;
    problem_.par = 1;
    problem_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(MPI_COMM_WORLD));
    run(Job::start_job);
    constexpr int streams = 3, none = -1;
    for (int stream = 1; stream <= streams; ++stream)
      control(stream) = none;
    control(Control::print_level) = 0;
    control(Control::scaling) = 0;
    control(Control::entries_from) = 3;     // all ranks
    control(Control::kind_of_analysis) = 1; // by one rank, as complements want
    control(Control::ordering) = 1;         // given
  }
  /// A rank that fails alone must not wait here for the others: what is held goes with the process.
  ~MumpsOfRanks() override {
    int ended = 0;
    MPI_Finalized(&ended);
    if (ended != 0 || std::uncaught_exceptions() > 0)
      return;
    problem_.job = Job::end_job;
    dmumps_c(&problem_);
  }

  Needs analyse(Entries entries) override {
    const std::lock_guard lock(in_use());
    entries_ = std::move(entries);
    for (auto* list : {&entries_.rows, &entries_.columns, &entries_.surface, &entries_.order})
      for (auto& unknown : *list)
        ++unknown;            // MUMPS counts from 1
    entries_.rows.reserve(1); // MUMPS wants places even where there are no entries
    entries_.columns.reserve(1);
    problem_.n = entries_.size;
    problem_.nnz_loc = static_cast<MUMPS_INT8>(entries_.rows.size());
    problem_.irn_loc = entries_.rows.data();
    problem_.jcn_loc = entries_.columns.data();
    problem_.perm_in = entries_.order.data();
    problem_.size_schur = static_cast<MUMPS_INT>(entries_.surface.size());
    problem_.listvar_schur = entries_.surface.data();
    control(Control::complement_wanted) = entries_.surface.empty() ? 0 : 1; // on the first rank
    must_succeed(run(Job::analysis));
    constexpr std::size_t mebibyte = std::size_t{1} << 20U;
    return {mebibyte * static_cast<std::size_t>(problem_.info[14]), problem_.rinfog[0]};
  }

  bool factorise(std::span<const double> values, std::span<double> complement) override {
    const std::lock_guard lock(in_use());
    values_.assign(values.begin(), values.end());
    values_.reserve(1);
    problem_.a_loc = values_.data();
    problem_.schur = complement.data();
    problem_.lredrhs = problem_.schur_lld = std::max(1, problem_.size_schur);
    auto error = run(Job::factorisation);
    for (int tries = 0; is_short_of_room(error) && tries < most_tries; ++tries) {
      control(Control::more_room) *= 2;
      error = run(Job::factorisation);
    }
    constexpr int singular = -10, not_positive = -40;
    if (error == singular || error == not_positive)
      return false;
    must_succeed(error);
    const int negative_pivots = problem_.infog[11];
    return negative_pivots == 0;
  }

  void condense(std::span<double> right_side, std::span<double> on_surface) override {
    solve_by(Step::down_to_surface, right_side, on_surface);
  }
  void expand(std::span<double> on_surface, std::span<double> solution) override {
    solve_by(Step::up_from_surface, solution, on_surface);
  }
  void solve(std::span<double> right_side) override { solve_by(Step::whole, right_side, {}); }

  std::size_t bytes() const override {
    constexpr double million = 1e6;
    const auto entries = static_cast<double>(problem_.infog[8]);
    return sizeof(double) * static_cast<std::size_t>(entries < 0 ? -million * entries : entries);
  }

private:
  static constexpr int most_tries = 6;

  MUMPS_INT& control(int number) { return problem_.icntl[number - 1]; }

  /// The manual's number of an error, 0 for none.
  int run(Job job) {
    problem_.job = job;
    dmumps_c(&problem_);
    return std::min(0, problem_.infog[0]);
  }

  static bool is_short_of_room(int error) {
    constexpr int integers = -8, numbers = -9, for_sending = -17, for_receiving = -20;
    return error == integers || error == numbers || error == for_sending || error == for_receiving;
  }

  static void must_succeed(int error) {
    constexpr int no_memory = -13;
    if (error == no_memory)
      throw std::bad_alloc();
    if (error < 0)
      throw std::runtime_error("MUMPS: error " + std::to_string(error));
  }

  void solve_by(Step step, std::span<double> whole, std::span<double> on_surface) {
    const std::lock_guard lock(in_use());
    problem_.nrhs = 1;
    problem_.lrhs = problem_.n;
    problem_.rhs = whole.data();
    problem_.redrhs = on_surface.data();
    problem_.lredrhs = std::max(1, problem_.size_schur);
    control(Control::step_of_solution) = step;
    must_succeed(run(Job::solution));
  }

  DMUMPS_STRUC_C problem_{};
  Entries entries_;
  std::vector<double> values_;
};

} // namespace
} // namespace rubato::linalg::petsc

extern "C" __attribute__((visibility("default"))) void
rubato_make_factor_of_ranks_2(std::unique_ptr<rubato::linalg::FactorOfRanks>& made) {
  rubato::linalg::petsc::start();
  made = std::make_unique<rubato::linalg::petsc::MumpsOfRanks>();
}
