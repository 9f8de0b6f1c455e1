// SPDX-License-Identifier: LGPL-3.0-or-later
/// What explicit steps cost: a box of distorted HEXA8, n cells along each side.
///   ReadMemory       a long vector added up: what one core reads at all
///   CsrProduct       K u by Eigen's compressed rows: limited by memory, and reading twice as much as it
///   needs BlockProduct     K u as explicit steps do it PlainProduct     the same with what every processor
///   of the architecture has ShuffledProduct  the same with the nodes in an order without any locality
///   ExplicitStep     whole steps, loads and supports included
/// Counters: Mel/s, millions of elements a second of processor time; GB/s, vector or matrix bytes read.
#include "rubato/deck/read.hpp"
#include "rubato/linalg/block_matrix.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace rubato::bench::explicit_product {
namespace {

/// Inner nodes are moved by up to a fifth of a cell: no element is like another.
void distort(mesh::Mesh& mesh, int n) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shift(-0.2 / n, 0.2 / n);
  for (auto& x : mesh.points) {
    const Eigen::Vector3d by(shift(random), shift(random), shift(random));
    if ((x.array() > 1e-9).all() && (x.array() < 1 - 1e-9).all())
      x += by;
  }
}

model::Model distorted_box(int n) {
  const auto divisions = std::to_string(n);
  const auto deck = "mesh: {generate: [{name: box, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [" +
                    divisions + ", " + divisions + ", " + divisions +
                    "], sides: {left: held, right: end}}]}\n" + R"(
physics: solid
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
supports: [{on: held, fix: [x, y, z]}]
loads: [{surface_force: {on: end, y: -1e6}}]
time: {scheme: central_difference, end: 1}
)";
  const auto study = deck::parse_deck(deck, "bench.yaml").runs.front();
  auto mesh = model::load_mesh(study.mesh);
  distort(mesh, n);
  return model::build_model(study, std::move(mesh));
}

void count_elements(benchmark::State& state, double products) {
  const double elements = static_cast<double>(state.range(0) * state.range(0) * state.range(0));
  state.counters["Mel/s"] = benchmark::Counter(products * elements / 1e6, benchmark::Counter::kIsRate);
}

void count_bytes(benchmark::State& state, double bytes) {
  state.counters["GB/s"] =
      benchmark::Counter(static_cast<double>(state.iterations()) * bytes / 1e9, benchmark::Counter::kIsRate);
}

void ReadMemory(benchmark::State& state) {
  constexpr int lanes = 16; // sums of their own, so that none waits for the one before
  const Eigen::VectorXd numbers = Eigen::VectorXd::Ones(state.range(0));
  for (auto _ : state) {
    Eigen::Vector<double, lanes> sum = Eigen::Vector<double, lanes>::Zero();
    for (Eigen::Index i = 0; i < numbers.size(); i += lanes)
      sum += numbers.segment<lanes>(i);
    benchmark::DoNotOptimize(sum.data());
  }
  count_bytes(state, static_cast<double>(sizeof(double)) * static_cast<double>(numbers.size()));
}

void CsrProduct(benchmark::State& state) {
  const auto model = distorted_box(static_cast<int>(state.range(0)));
  const Eigen::SparseMatrix<double, Eigen::RowMajor, int> matrix = model.domain.initial_tangent();
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(matrix.rows());
  Eigen::VectorXd y(matrix.rows());
  for (auto _ : state) {
    y.noalias() = matrix * x;
    benchmark::DoNotOptimize(y.data());
  }
  count_elements(state, static_cast<double>(state.iterations()));
  count_bytes(state, 12.0 * static_cast<double>(matrix.nonZeros()));
}

void multiply_blocks(benchmark::State& state, const model::SparseMatrix& entries,
                     linalg::Instructions instructions) {
  const linalg::SymmetricBlockMatrix matrix(entries, 3);
  const Eigen::VectorXd x = Eigen::VectorXd::Ones(matrix.rows());
  Eigen::VectorXd y(matrix.rows());
  for (auto _ : state) {
    matrix.multiply(x, y, instructions);
    benchmark::DoNotOptimize(y.data());
  }
  count_elements(state, static_cast<double>(state.iterations()));
  count_bytes(state, static_cast<double>(matrix.bytes()));
}

void BlockProduct(benchmark::State& state) {
  const auto model = distorted_box(static_cast<int>(state.range(0)));
  multiply_blocks(state, model.domain.initial_tangent(), linalg::best_instructions());
}

void PlainProduct(benchmark::State& state) {
  const auto model = distorted_box(static_cast<int>(state.range(0)));
  multiply_blocks(state, model.domain.initial_tangent(), linalg::Instructions::plain);
}

void ShuffledProduct(benchmark::State& state) {
  const auto model = distorted_box(static_cast<int>(state.range(0)));
  std::vector<int> nodes(static_cast<std::size_t>(model.domain.initial_tangent().rows() / 3));
  std::iota(nodes.begin(), nodes.end(), 0);
  std::ranges::shuffle(nodes, std::mt19937(3));
  Eigen::PermutationMatrix<Eigen::Dynamic> shuffle(model.domain.initial_tangent().rows());
  for (int dof = 0; dof < shuffle.size(); ++dof)
    shuffle.indices()[dof] = 3 * nodes[static_cast<std::size_t>(dof / 3)] + dof % 3;
  model::SparseMatrix shuffled;
  shuffled = model.domain.initial_tangent().twistedBy(shuffle);
  multiply_blocks(state, shuffled, linalg::best_instructions());
}

void ExplicitStep(benchmark::State& state) {
  const auto model = distorted_box(static_cast<int>(state.range(0)));
  step::ExplicitMotion motion(model);
  constexpr int steps = 10;
  const double h = 0.9 * motion.spectrum().stable_step();
  int done = 0;
  for (auto _ : state) {
    done += steps;
    motion.advance(done * h, steps);
  }
  count_elements(state, static_cast<double>(done));
}

BENCHMARK(ReadMemory)->Arg(1 << 25)->Unit(benchmark::kMillisecond);
BENCHMARK(CsrProduct)->Arg(16)->Arg(32)->Arg(48)->Unit(benchmark::kMillisecond);
BENCHMARK(BlockProduct)->Arg(16)->Arg(32)->Arg(48)->Unit(benchmark::kMillisecond);
BENCHMARK(PlainProduct)->Arg(16)->Arg(32)->Arg(48)->Unit(benchmark::kMillisecond);
BENCHMARK(ShuffledProduct)->Arg(16)->Arg(32)->Arg(48)->Unit(benchmark::kMillisecond);
BENCHMARK(ExplicitStep)->Arg(16)->Arg(32)->Arg(48)->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rubato::bench::explicit_product
