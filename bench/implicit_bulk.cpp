// SPDX-License-Identifier: LGPL-3.0-or-later
/// What implicit steps of nonlinear bodies cost: J2 with linear hardening, a box of HEXA8, n cells along each
/// side.
///   PlasticTangent     forces and tangent of all cells, added to the matrix (mean dilatation, as by default)
///   PlasticTangentFull the same with full integration
///   LogarithmicTangent the same with logarithmic strain (mean dilatation)
///   PlasticBulkStep    a step in which most of the box yields, nothing touches it
///   PlasticBeamsStep   SDNL140's two beams in contact with friction, cells cut n times, after 3 ms
/// Steps that converge at the first attempt: those that do not cost each of their attempts.
/// Counters: Mel/s, millions of elements a second of processor time; factors, bulk and contact, the
/// factorisations, motions and iterations of contact of the step; step/parts, its time over that of its
/// assemblies, factorisations and solves, those for the compliance of the surface with them, each measured by
/// itself in the same process.
#include "rubato/core/processor_time.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/common/effective_system.hpp"

#include <benchmark/benchmark.h>

#include "sdnl140.hpp"
#include <stdexcept>
#include <string>

namespace rubato::bench::implicit_bulk {
namespace {
using Eigen::VectorXd;

const std::string steel = "law: plastic, young: 200e9, poisson: 0.3, density: 7800, "
                          "hardening: {linear: {yield_stress: 400e6, modulus: 1e9}}";

model::Model box(std::int64_t n, const std::string& material, const std::string& rest) {
  const auto divisions = std::to_string(n);
  const auto deck = "mesh: {generate: [{name: box, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [" +
                    divisions + ", " + divisions + ", " + divisions +
                    "], sides: {front: top, back: held}}]}\nphysics: solid\nmaterials: {body: {" + material +
                    "}}\ntime: {scheme: hht, alpha: -0.1, step: 1e-4, end: 1e-2}\n" + rest;
  return model::build_model(deck::parse_deck(deck, "bench.yaml").runs.front());
}

const std::string pulled = R"(
functions: {ramp: {times: [0, 1e-2], values: [0, 1]}}
supports: [{on: held, fix: [x, y, z]}, {on: top, x: {value: 0.2, function: ramp}, z: {value: 0.2, function: ramp}}]
)";
/// SDNL140's beams of steel that yields, the upper one pressed by a fifth of the force.
model::Model plastic_beams(std::int64_t refined) {
  auto study = bench::sdnl140("c.yaml", static_cast<int>(refined), 5e-4, 1);
  for (auto& material : study.materials) {
    material.law = study::LawKind::plastic;
    material.plasticity.yield_stress = 400e6;
    material.plasticity.modulus = 2e9;
  }
  study.loads.front().components[1] = study::FieldValue(-2e6);
  return model::build_model(study);
}

void tangents(benchmark::State& state, const std::string& material) {
  const auto model = box(state.range(0), material, pulled);
  VectorXd u = VectorXd::Zero(model.dofs.dof_count);
  for (Eigen::Index i = 0; i < u.size(); ++i)
    u[i] = 1e-2 * static_cast<double>((i * 7919) % 101) / 101 / static_cast<double>(state.range(0));
  VectorXd forces = VectorXd::Zero(u.size());
  auto tangent = model.domain.initial_tangent();
  domain::QuadratureStates now;
  const auto& old = model.domain.initial_states();
  for (auto _ : state)
    if (model.domain.evaluate({u, u, 0, 1e-4}, old, now, {.forces = &forces, .tangent = &tangent}))
      throw std::runtime_error("a cell has no forces");
  const auto elements = static_cast<double>(model.bulk.cells.size());
  state.counters["Mel/s"] = benchmark::Counter(elements / 1e6, benchmark::Counter::kIsIterationInvariantRate);
}

void PlasticTangent(benchmark::State& state) {
  tangents(state, steel);
}
void PlasticTangentFull(benchmark::State& state) {
  tangents(state, steel + ", formulation: full");
}
void LogarithmicTangent(benchmark::State& state) {
  tangents(state, steel + ", strain: logarithmic");
}

template <class Work> double seconds_of(const Work& work) {
  constexpr int times = 5;
  const double start = processor_seconds();
  for (int i = 0; i < times; ++i)
    work();
  return (processor_seconds() - start) / times;
}

/// The step, again and again from where the simulation is after some steps.
void steps(benchmark::State& state, const model::Model& model, int before) {
  simulation::Simulation simulation(model);
  for (int i = 0; i < before; ++i)
    if (!simulation.advance().accepted())
      throw std::runtime_error("a step did not converge");
  const step::State committed = simulation.state();
  const auto scheme = time::make_scheme(model.study.time);
  auto system = step::make_effective_system(model, scheme, model.study.time.step);
  step::State trial;
  step::StepReport report;
  double in_steps = 0;
  int count = 0;
  for (auto _ : state) {
    if (committed.tangent) // the step before has left its factor
      step::renew(system, model, committed.tangent);
    const double start = processor_seconds();
    report = step::advance(model, scheme, system, committed, committed.t + system.step, trial);
    in_steps += processor_seconds() - start;
    ++count;
    if (!report.converged())
      throw std::runtime_error("a step did not converge");
  }
  const auto& u = trial.motion.u;
  VectorXd forces = VectorXd::Zero(u.size());
  auto tangent = model.domain.initial_tangent();
  domain::QuadratureStates now;
  const domain::StepSpan span{committed.motion.u, u, committed.t, trial.t};
  const double assembly = seconds_of([&] {
    (void)model.domain.evaluate(span, committed.bulk_points, now, {.forces = &forces, .tangent = &tangent});
  });
  const double evaluation =
      seconds_of([&] { (void)model.domain.evaluate(span, committed.bulk_points, now, {.forces = &forces}); });
  double scale = 1;
  const auto refactor = [&] {
    scale *= 1.0001; // other values
    const model::SparseMatrix matrix = scale * system.matrix;
    if (!system.compliance->refactor(matrix))
      throw std::runtime_error("the matrix is not positive definite");
  };
  const double factor = seconds_of(refactor);
  const double with_columns = seconds_of([&] {
    refactor();
    for (int dof = 0; dof < system.compliance->size(); ++dof)
      benchmark::DoNotOptimize(system.compliance->own(dof));
  });
  const VectorXd right = VectorXd::Ones(system.matrix.rows());
  const double solve = seconds_of([&] { benchmark::DoNotOptimize(system.compliance->solve(right).data()); });
  const double parts = (report.factorisations + 1) * assembly + (report.bulk_iterations + 1) * evaluation +
                       report.factorisations * (model.zones.empty() ? factor : with_columns) +
                       (report.bulk_iterations + 1) * solve;
  const auto add = [&](const char* name, double share) { state.counters[name] = share * count / in_steps; };
  add("assembly", (report.factorisations + 1) * assembly + (report.bulk_iterations + 1) * evaluation);
  add("factor", report.factorisations * factor);
  add("columns", report.factorisations * (with_columns - factor));
  state.counters["factors"] = report.factorisations;
  state.counters["bulk"] = report.bulk_iterations;
  state.counters["contact"] = report.iterations;
  state.counters["step/parts"] = in_steps / count / parts;
}

void PlasticBulkStep(benchmark::State& state) {
  steps(state, box(state.range(0), steel, pulled), 3);
}
void PlasticBeamsStep(benchmark::State& state) {
  steps(state, plastic_beams(state.range(0)), 6);
}

BENCHMARK(PlasticTangent)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(PlasticTangentFull)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(LogarithmicTangent)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(PlasticBulkStep)->Arg(8)->Arg(16)->Unit(benchmark::kMillisecond);
BENCHMARK(PlasticBeamsStep)->Arg(1)->Arg(2)->Arg(4)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rubato::bench::implicit_bulk
