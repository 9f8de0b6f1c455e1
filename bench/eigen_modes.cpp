// SPDX-License-Identifier: LGPL-3.0-or-later
/// The 20 lowest modes of SDNL140 C, both beams, cells cut 2, 4, 8 times, beside a factorisation:
///   FactorStiffness  Cholesky of the stiffness of clamped beams
///   Modes            the modes, with that factorisation
///   ModesOfFree      of beams that nothing holds
/// Counter: dofs.
#include "rubato/linalg/eigen_modes.hpp"

#include "rubato/linalg/direct_solver.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <benchmark/benchmark.h>

#include "sdnl140.hpp"

namespace rubato::bench::eigen_modes {
namespace {
using linalg::SparseMatrix;

constexpr int modes = 20;

struct Matrices {
  SparseMatrix stiffness;
  SparseMatrix mass;
};

Matrices matrices_of(benchmark::State& state, bool held) {
  auto study = bench::sdnl140("c.yaml", static_cast<int>(state.range(0)), 1e-3, 1e-3);
  if (!held)
    study.supports.clear();
  const auto model = model::build_model(study);
  Matrices matrices{model.reduction.reduced(model.domain.initial_tangent()),
                    model.reduction.reduced(model.mass)};
  state.counters["dofs"] = static_cast<double>(matrices.mass.rows());
  return matrices;
}

void FactorStiffness(benchmark::State& state) {
  const auto matrices = matrices_of(state, true);
  for (auto _ : state)
    benchmark::DoNotOptimize(linalg::CholeskyFactor::of(matrices.stiffness));
}

void find_modes(benchmark::State& state, bool held) {
  const auto [stiffness, mass] = matrices_of(state, held);
  const auto support = held ? linalg::Support::unknown : linalg::Support::none;
  const SparseMatrix unconstrained(stiffness.rows(), 0);
  for (auto _ : state)
    benchmark::DoNotOptimize(linalg::smallest_modes(stiffness, mass, unconstrained, modes, support));
}

void Modes(benchmark::State& state) {
  find_modes(state, true);
}

void ModesOfFree(benchmark::State& state) {
  find_modes(state, false);
}

BENCHMARK(FactorStiffness)->Arg(2)->Arg(4)->Arg(8)->Unit(benchmark::kMillisecond);
BENCHMARK(Modes)->Arg(2)->Arg(4)->Arg(8)->Unit(benchmark::kMillisecond);
BENCHMARK(ModesOfFree)->Arg(2)->Arg(4)->Arg(8)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rubato::bench::eigen_modes
