// SPDX-License-Identifier: LGPL-3.0-or-later
/// What making the matrices of a model costs: a box with n cells along each side.
///   Pattern    who shares a cell with whom
///   Stiffness  element stiffnesses, and their sum
///   Mass       likewise
///   StiffnessOfShakenCells  of a box whose cells all have another shape
/// Arguments: n, and the nodes of a cell: 8 (HEXA8) or 27 (HEXA27). Counter: Mel/s, millions of elements a
/// second of processor time.
#include "rubato/domain/assembly.hpp"

#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <benchmark/benchmark.h>

#include <string>

namespace rubato::bench::assembly {
namespace {

model::Model box(const benchmark::State& state) {
  const auto n = std::to_string(state.range(0));
  const auto deck = "mesh: {generate: [{name: box, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [" + n +
                    ", " + n + ", " + n + "], cells: hexa" + std::to_string(state.range(1)) +
                    R"(, sides: {left: held}}]}
physics: solid
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
supports: [{on: held, fix: [x, y, z]}]
time: {scheme: static, step: 1, end: 1}
)";
  return model::build_model(deck::parse_deck(deck, "bench.yaml").runs.front());
}

void count(benchmark::State& state, const model::Model& model) {
  const auto elements = static_cast<double>(model.bulk.cells.size());
  state.counters["Mel/s"] = benchmark::Counter(elements / 1e6, benchmark::Counter::kIsIterationInvariantRate);
}

void Pattern(benchmark::State& state) {
  const auto model = box(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(domain::BlockPattern(model.mesh, model.bulk.cells, model.dofs));
  count(state, model);
}

void Stiffness(benchmark::State& state) {
  const auto model = box(state);
  const domain::BlockPattern pattern(model.mesh, model.bulk.cells, model.dofs);
  for (auto _ : state)
    benchmark::DoNotOptimize(domain::assemble_stiffness(model.mesh, model.bulk, pattern).valuePtr());
  count(state, model);
}

/// Each node moved by up to a tenth of a cell.
void shake(mesh::Mesh& mesh, std::int64_t n) {
  const double most = 0.1 / static_cast<double>(n);
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    for (std::size_t a = 0; a < 3; ++a)
      mesh.points[i][static_cast<Eigen::Index>(a)] +=
          most * (static_cast<double>((i * 7919 + a * 104729) % 201) / 100 - 1);
}

void StiffnessOfShakenCells(benchmark::State& state) {
  auto model = box(state);
  shake(model.mesh, state.range(0));
  const domain::BlockPattern pattern(model.mesh, model.bulk.cells, model.dofs);
  for (auto _ : state)
    benchmark::DoNotOptimize(domain::assemble_stiffness(model.mesh, model.bulk, pattern).valuePtr());
  count(state, model);
}

void Mass(benchmark::State& state) {
  const auto model = box(state);
  const domain::BlockPattern pattern(model.mesh, model.bulk.cells, model.dofs);
  for (auto _ : state)
    benchmark::DoNotOptimize(domain::assemble_mass(model.mesh, model.bulk, pattern).valuePtr());
  count(state, model);
}

BENCHMARK(Pattern)->Args({16, 8})->Args({32, 8})->Args({8, 27})->Unit(benchmark::kMillisecond);
BENCHMARK(Stiffness)->Args({16, 8})->Args({32, 8})->Args({8, 27})->Unit(benchmark::kMillisecond);
BENCHMARK(StiffnessOfShakenCells)->Args({32, 8})->Unit(benchmark::kMillisecond);
BENCHMARK(Mass)->Args({16, 8})->Args({32, 8})->Args({8, 27})->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rubato::bench::assembly
