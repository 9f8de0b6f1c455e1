// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the effective matrix of SDNL140 C costs, cells cut 1, 2, 4 times.
///   Factor, Solve            plain Cholesky: the yardstick of whole steps
///   FactorSplit, SolveSplit  with the contact surfaces last, as condensed steps have it
///   SurfaceCompliance        the columns of a hundred surface unknowns
///   FactorWhole              LU of the same matrix: what an iteration of the full system costs at least
/// Counter: dofs.
#include "rubato/linalg/direct_solver.hpp"

#include "rubato/linalg/memory.hpp"
#include "rubato/linalg/split_factor.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/common/effective_system.hpp"
#include "rubato/step/full/linear_step.hpp"

#include <benchmark/benchmark.h>

#include "sdnl140.hpp"
#include <vector>

namespace rubato::bench::direct_solver {
namespace {
using Eigen::VectorXd;

struct Matrix {
  linalg::SparseMatrix entries;
  std::vector<int> surface;

  linalg::SplitFactor split() const {
    return linalg::SplitFactor::of(entries, surface, linalg::available_memory()).value();
  }
};

Matrix matrix_of(benchmark::State& state) {
  const auto refine = static_cast<int>(state.range(0));
  auto study = bench::sdnl140("c.yaml", refine, 1e-3 / refine, 1e-3);
  study.solver = study::Solver::full; // nothing is factored yet
  const auto model = model::build_model(study);
  const auto system = step::make_effective_system(model, time::make_scheme(study.time), study.time.step);
  state.counters["dofs"] = static_cast<double>(system.matrix.rows());
  return {system.matrix, step::surface_unknowns(model)};
}

void Factor(benchmark::State& state) {
  const auto matrix = matrix_of(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(linalg::CholeskyFactor::of(matrix.entries));
}

void FactorSplit(benchmark::State& state) {
  const auto matrix = matrix_of(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(matrix.split());
}

void FactorWhole(benchmark::State& state) {
  const auto matrix = matrix_of(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(linalg::LuFactor::of(matrix.entries));
}

void Solve(benchmark::State& state) {
  const auto matrix = matrix_of(state);
  const auto factor = linalg::CholeskyFactor::of(matrix.entries).value();
  const VectorXd force = VectorXd::Ones(matrix.entries.rows());
  for (auto _ : state)
    benchmark::DoNotOptimize(factor.solve(force).data());
}

void SolveSplit(benchmark::State& state) {
  const auto matrix = matrix_of(state);
  const auto factor = matrix.split();
  const VectorXd force = VectorXd::Ones(matrix.entries.rows());
  for (auto _ : state)
    benchmark::DoNotOptimize(factor.solve(force).data());
}

void SurfaceCompliance(benchmark::State& state) {
  const auto factor = matrix_of(state).split();
  for (auto _ : state)
    benchmark::DoNotOptimize(factor.compliance(0).data());
}

BENCHMARK(Factor)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(FactorSplit)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(FactorWhole)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);
BENCHMARK(Solve)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMicrosecond);
BENCHMARK(SolveSplit)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMicrosecond);
BENCHMARK(SurfaceCompliance)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rubato::bench::direct_solver
