// SPDX-License-Identifier: LGPL-3.0-or-later
/// How much sooner work is done by several threads than by one, by the clock, both in turn in one process.
/// Argument: threads. Counter: ratio, the time of one thread over that of all.
///   AssemblyByThreads       stiffness and mass of a box of 48³ HEXA8 that all differ, with their pattern
///   TangentByThreads        forces and tangents of 24³ HEXA8 of J2, added to the matrix
///   ExplicitPlasticByThreads  explicit steps of a box of 32³ HEXA8 of J2
///   ReadByThreads           what an explicit step of a linear body is limited by: 1 GB is read
///   ExplicitByThreads       explicit steps of a linear box of 48³ HEXA8
///   FactorByThreads         of C refined 8 (two bodies)
///   FactorOfOneByThreads    of a box of 28³ HEXA8 (one body)
///   SolveByThreads          of C refined 8
#include "rubato/deck/read.hpp"
#include "rubato/domain/assembly.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/step/common/effective_system.hpp"

#include <benchmark/benchmark.h>

#include "sdnl140.hpp"
#include <chrono>
#include <functional>
#include <string>

namespace rubato::bench::threads {
namespace {

study::Study cube(int n, const std::string& law, const std::string& time) {
  const auto divisions = std::to_string(n);
  return deck::parse_deck(
             "mesh: {generate: [{name: cube, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [" +
                 divisions + ", " + divisions + ", " + divisions +
                 "], sides: {front: top, back: held}}]}\nphysics: solid\n"
                 "materials: {steel: {" +
                 law +
                 "young: 200e9, poisson: 0.3, density: 7800}}\n"
                 "functions: {ramp: {times: [0, 1e-3], values: [0, 1]}}\n"
                 "supports: [{on: held, fix: [x, y, z]}, {on: top, x: {value: 5e-3, function: ramp}}]\n"
                 "time: " +
                 time + "\n",
             "bench.yaml")
      .runs.front();
}

const std::string plastic = "law: plastic, hardening: {linear: {yield_stress: 400e6, modulus: 1e9}}, ";
const std::string implicit = "{scheme: newmark, step: 1e-5, end: 1e-3}";
const std::string explicit_ = "{scheme: central_difference, end: 1, record: 1e-5}";

using Work = std::function<void()>;

double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// `one` and `all` in turn.
void compare(benchmark::State& state, const Work& one, const Work& all) {
  one();
  all();
  double by_one = 0, by_all = 0;
  for (auto _ : state) {
    by_one += seconds_of(one);
    const double seconds = seconds_of(all);
    by_all += seconds;
    state.SetIterationTime(seconds);
  }
  state.counters["ratio"] = by_one / by_all;
}

Threads threads_of(const benchmark::State& state) {
  return Threads(static_cast<int>(state.range(0)));
}

/// Each node moved by up to a tenth of a cell.
void shake(mesh::Mesh& mesh, int n) {
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (std::size_t a = 0; a < 3; ++a)
      mesh.points[i][static_cast<Eigen::Index>(a)] +=
          0.1 / n * (static_cast<double>((i * 7919 + a * 104729) % 201) / 100 - 1);
}

void AssemblyByThreads(benchmark::State& state) {
  constexpr int n = 48;
  auto model = model::build_model(cube(n, "", implicit));
  shake(model.mesh, n);
  const auto by = [&](const Threads& threads) {
    return [&model, threads] {
      const domain::BlockPattern pattern(model.mesh, model.bulk.cells, model.dofs, threads);
      benchmark::DoNotOptimize(domain::assemble_stiffness(model.mesh, model.bulk, pattern).valuePtr());
      benchmark::DoNotOptimize(domain::assemble_mass(model.mesh, model.bulk, pattern).valuePtr());
    };
  };
  compare(state, by({}), by(threads_of(state)));
}

void TangentByThreads(benchmark::State& state) {
  const auto study = cube(24, plastic, implicit);
  const auto one = model::build_model(study), all = model::build_model(study, threads_of(state));
  Eigen::VectorXd u = Eigen::VectorXd::Zero(one.dofs.dof_count), forces = u;
  for (Eigen::Index i = 0; i < u.size(); ++i)
    u[i] = 1e-2 / 24 * static_cast<double>((i * 7919) % 101) / 101;
  auto tangent = one.domain.initial_tangent();
  domain::QuadratureStates now;
  const auto by = [&](const model::Model& model) {
    return [&] {
      (void)model.domain.evaluate({u, u, 0, 1e-4}, model.domain.initial_states(), now,
                                  {.forces = &forces, .tangent = &tangent});
    };
  };
  compare(state, by(one), by(all));
}

void ReadByThreads(benchmark::State& state) {
  const std::vector<double> memory(std::size_t{1} << 27, 1.0);
  const auto by = [&](const Threads& threads) {
    return [&memory, threads] {
      const int parts = 2 * threads.count();
      std::vector<double> sums(static_cast<std::size_t>(parts));
      threads.each(parts, [&](int part) {
        const auto size = static_cast<Eigen::Index>(memory.size()) / parts;
        sums[static_cast<std::size_t>(part)] =
            Eigen::Map<const Eigen::ArrayXd>(memory.data() + part * size, size).sum();
      });
      benchmark::DoNotOptimize(sums.data());
    };
  };
  compare(state, by({}), by(threads_of(state)));
}

void steps_by_threads(benchmark::State& state, const study::Study& study) {
  simulation::Start start;
  start.workers = threads_of(state);
  simulation::Simulation one(study), all(study, start);
  compare(
      state, [&] { one.advance(); }, [&] { all.advance(); });
}

void ExplicitByThreads(benchmark::State& state) {
  steps_by_threads(state, cube(48, "", explicit_));
}
void ExplicitPlasticByThreads(benchmark::State& state) {
  steps_by_threads(state, cube(32, plastic, explicit_));
}

struct Systems {
  explicit Systems(const study::Study& study, const Threads& threads)
      : model(model::build_model(study, threads)),
        system(step::make_effective_system(model, time::make_scheme(study.time), study.time.step)) {}
  model::Model model;
  step::EffectiveSystem system;
  double scale = 1;

  void refactor() {
    scale *= 1.0001; // other values
    const model::SparseMatrix matrix = scale * system.matrix;
    if (!system.compliance->refactor(matrix))
      throw std::runtime_error("the matrix is not positive definite");
  }
};

void factor_by_threads(benchmark::State& state, const study::Study& study) {
  Systems one(study, {}), all(study, threads_of(state));
  compare(
      state, [&] { one.refactor(); }, [&] { all.refactor(); });
}

void FactorByThreads(benchmark::State& state) {
  factor_by_threads(state, bench::sdnl140("c.yaml", 8, 1e-3 / 8, 1));
}
void FactorOfOneByThreads(benchmark::State& state) {
  factor_by_threads(state, cube(28, "", implicit));
}

void SolveByThreads(benchmark::State& state) {
  const auto study = bench::sdnl140("c.yaml", 8, 1e-3 / 8, 1);
  const Systems one(study, {}), all(study, threads_of(state));
  const Eigen::VectorXd right = Eigen::VectorXd::Ones(one.system.matrix.rows());
  const auto by = [&](const Systems& of) {
    return [&] { benchmark::DoNotOptimize(of.system.compliance->solve(right).data()); };
  };
  compare(state, by(one), by(all));
}

BENCHMARK(AssemblyByThreads)->Arg(2)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(TangentByThreads)->Arg(2)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(ReadByThreads)->Arg(2)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(ExplicitByThreads)->Arg(2)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(ExplicitPlasticByThreads)->Arg(2)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(FactorByThreads)->Arg(2)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(FactorOfOneByThreads)->Arg(2)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(SolveByThreads)->Arg(2)->UseManualTime()->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rubato::bench::threads
