// SPDX-License-Identifier: LGPL-3.0-or-later
/// What explicit steps of nonlinear bodies cost: a box of HEXA8 (mean dilatation), n cells along each side,
/// that flies against a wall it is fastened to.
///   PlasticStep             J2, linear hardening, small strain
///   PlasticStepOfFullCells  the same with full integration
///   LogarithmicStep         the same with logarithmic strain
///   RubberStep              neo-Hookean
///   …StepOfReducedCells     the same with one point a cell
/// Counter Mel/s: millions of elements a second of processor time, what is done between steps included.
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <string>

namespace rubato::bench::explicit_bulk {
namespace {

model::Model flying_box(std::int64_t n, const std::string& material) {
  const auto divisions = std::to_string(n);
  const auto deck =
      "mesh: {generate: [{name: box, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [" + divisions + ", " +
      divisions + ", " + divisions +
      "], sides: {left: held}}], groups: {moving: {box: {from: [0.001, 0, 0], to: [1, 1, 1]}}}}\n" +
      "materials: {body: {" + material + "}}\n" + R"(
physics: solid
supports: [{on: held, fix: [x, y, z]}]
initial: [{on: moving, velocity: {x: -50}}]
time: {scheme: central_difference, end: 1}
)";
  return model::build_model(deck::parse_deck(deck, "bench.yaml").runs.front());
}

void make_steps(benchmark::State& state, const std::string& material) {
  const auto model = flying_box(state.range(0), material);
  step::ExplicitMotion motion(model);
  constexpr int steps = 20;
  for (auto _ : state)
    for (int left = steps; left > 0;) {
      motion.survey();
      const double h = 0.9 * motion.spectrum().stable_step();
      const int part = std::min(left, motion.steps_between_surveys());
      motion.advance(motion.t() + part * h, part);
      left -= part;
    }
  const auto cells = static_cast<double>(model.bulk.cells.size());
  state.counters["Mel/s"] =
      benchmark::Counter(static_cast<double>(motion.steps()) * cells / 1e6, benchmark::Counter::kIsRate);
}

const std::string steel = "law: plastic, young: 200e9, poisson: 0.3, density: 7800, "
                          "hardening: {linear: {yield_stress: 400e6, modulus: 1e9}}";

void PlasticStep(benchmark::State& state) {
  make_steps(state, steel);
}

void PlasticStepOfFullCells(benchmark::State& state) {
  make_steps(state, steel + ", formulation: full");
}

void LogarithmicStep(benchmark::State& state) {
  make_steps(state, steel + ", strain: logarithmic");
}

const std::string rubber = "law: hyperelastic, c10: 4e8, bulk: 4e9, density: 1100";

void RubberStep(benchmark::State& state) {
  make_steps(state, rubber);
}

const std::string reduced = ", formulation: reduced";

void PlasticStepOfReducedCells(benchmark::State& state) {
  make_steps(state, steel + reduced);
}

void LogarithmicStepOfReducedCells(benchmark::State& state) {
  make_steps(state, steel + ", strain: logarithmic" + reduced);
}

void RubberStepOfReducedCells(benchmark::State& state) {
  make_steps(state, rubber + reduced);
}

BENCHMARK(PlasticStep)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK(PlasticStepOfFullCells)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK(LogarithmicStep)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK(RubberStep)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK(PlasticStepOfReducedCells)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK(LogarithmicStepOfReducedCells)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);
BENCHMARK(RubberStepOfReducedCells)->Arg(16)->Arg(32)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rubato::bench::explicit_bulk
