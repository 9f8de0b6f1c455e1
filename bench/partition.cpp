// SPDX-License-Identifier: LGPL-3.0-or-later
/// What explicit ranks would send each other, counted from partitions of meshes; nothing is sent or stepped.
/// Arguments: cuts of each cell, ranks. Counters: cells of the largest rank over the mean (imbalance),
/// numbers that all ranks send in a step to single others (halo) and to all (interface), those of the busiest
/// rank (halo_most), and what halo_most is over (unknowns / ranks)^(2/3) (shape).
///   PartitionOfBeams   SDNL140 C
///   PartitionOfCube    a box of 8³ HEXA8
#include "rubato/core/channel.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/rank_parts.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/own_cells.hpp"

#include <benchmark/benchmark.h>

#include "sdnl140.hpp"
#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <string>

namespace rubato::bench::partition {
namespace {

/// One of several ranks that are not there.
class Imagined final : public Channel {
public:
  Imagined(int index, int count) : index_(index), count_(count) {}
  int index() const override { return index_; }
  int count() const override { return count_; }
  int count_here() const override { return 1; }
  std::uint64_t bytes_sent() const override { return 0; }
  void broadcast(std::span<std::byte>) override {}
  void gather(std::span<const std::byte>, std::span<std::byte>) override {}
  void add_up(std::span<double>) override {}
  void exchange(std::span<Parcel>) override {}
  bool all_leave(double) override { return true; }
  void abort(int) override { std::terminate(); }

private:
  int index_;
  int count_;
};

Ranks imagined(int index, int count) {
  return Ranks(std::make_shared<Imagined>(index, count));
}

void count(benchmark::State& state, const study::Study& study) {
  const auto model = model::build_model(study);
  const int ranks = static_cast<int>(state.range(1));
  std::size_t halo = 0, halo_most = 0, cells_most = 0, interface = 0;
  for (auto _ : state) {
    const auto rank_of_cell = domain::partition(model.mesh, model.bulk, imagined(0, ranks));
    for (int index = 0; index < ranks; ++index) {
      const domain::RankParts parts(model.mesh, model.bulk, model.dofs, rank_of_cell,
                                    model::contact_nodes(model), imagined(index, ranks));
      halo += parts.halo_size();
      halo_most = std::max(halo_most, parts.halo_size());
      cells_most = std::max(cells_most, parts.cells().size());
      interface = parts.everywhere_size();
    }
  }
  const double mean = static_cast<double>(model.bulk.cells.size()) / ranks;
  state.counters["unknowns"] = model.dofs.dof_count;
  state.counters["imbalance"] = static_cast<double>(cells_most) / mean;
  state.counters["halo"] = static_cast<double>(halo);
  state.counters["halo_most"] = static_cast<double>(halo_most);
  state.counters["interface"] = static_cast<double>(interface);
  state.counters["shape"] =
      static_cast<double>(halo_most) / std::pow(static_cast<double>(model.dofs.dof_count) / ranks, 2. / 3);
}

void PartitionOfBeams(benchmark::State& state) {
  count(state, bench::sdnl140("c.yaml", static_cast<int>(state.range(0)), 1e-3, 1e-3));
}
BENCHMARK(PartitionOfBeams)
    ->ArgsProduct({{4, 8}, {2, 4, 16, 64}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

void PartitionOfCube(benchmark::State& state) {
  const auto n = std::to_string(8 * state.range(0));
  count(state, deck::parse_deck(
                   "mesh: {generate: [{name: cube, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [" + n +
                       ", " + n + ", " + n +
                       "], sides: {front: top, back: held}}]}\nphysics: solid\n"
                       "materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}\n"
                       "supports: [{on: held, fix: [x, y, z]}]\n"
                       "time: {scheme: central_difference, end: 1e-3, record: 1e-3}\n",
                   "bench.yaml")
                   .runs.front());
}
BENCHMARK(PartitionOfCube)
    ->ArgsProduct({{4, 8}, {2, 4, 16, 64}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace rubato::bench::partition
