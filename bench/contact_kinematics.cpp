// SPDX-License-Identifier: LGPL-3.0-or-later
/// What measuring the points of a contact zone costs at an iterate: pairs, projections, gaps, slips and all
/// their derivatives, of two beams that bend together and so slide along each other.
///   Evaluate       every iterate from nothing
///   EvaluateAgain  iterate after iterate in the same storage, as Newton's method does
///   UpdateNeighbours, FindPairs   the pairs alone, with and without what the last iterate knew
/// Arguments: 0 SEG2 (SDNL140 F), 1 QUAD4 (C), 2 QUAD4, C refined by 8, 3 QUAD9.
/// Counter: seconds of processor time for one point.
#include "rubato/contact/discretisation.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <benchmark/benchmark.h>

#include <array>
#include <string>
#include <vector>

namespace rubato::bench::contact_kinematics {
namespace {
using Eigen::VectorXd;

constexpr std::array zone_names{"SEG2 of F", "QUAD4 of C", "QUAD4 of C refined by 8", "QUAD9"};

/// A pair of beams as in SDNL140, one cell high: only their faces count here.
model::Model two_beams(std::int64_t which) {
  const bool plane = which == 0;
  const std::string cells = plane ? "quad4" : which == 3 ? "hexa27" : "hexa8";
  const std::string divisions = plane ? "[20, 1]" : which == 2 ? "[160, 1, 8]" : "[20, 1, 1]";
  const auto beam = [&](const std::string& name, const std::string& low, const std::string& high,
                        const std::string& sides) {
    const auto corner = [&](const std::string& x, const std::string& y, const std::string& z) {
      return "[" + x + ", " + y + (plane ? "]" : ", " + z + "]");
    };
    return "{name: " + name + (plane ? ", rectangle" : ", box") + ": {from: " + corner("0", low, "0") +
           ", to: " + corner("1", high, "0.1") + "}, divisions: " + divisions + ", cells: " + cells +
           ", sides: {left: held, " + sides + "}}";
  };
  const auto deck = "mesh: {generate: [" + beam("upper", "0", "0.1", "bottom: master") + ", " +
                    beam("lower", "-0.1", "0", "top: slave") +
                    "]}\nphysics: " + (plane ? "plane_stress" : "solid") + R"(
materials: {steel: {young: 200e9, poisson: 0, density: 7800}}
supports: [{on: held, fix: )" +
                    (plane ? "[x, y]" : "[x, y, z]") + R"(}]
contact: {interface: {master: master, slave: slave, integration: nodes, friction: 0.2}}
time: {scheme: static, step: 1, end: 1}
)";
  return model::build_model(deck::parse_deck(deck, "bench.yaml").runs.front());
}

/// The faces of both beams bent to a parabola of that height; sections turn with it, so that the faces slide
/// along each other.
VectorXd bent(const model::Model& model, double height) {
  constexpr double half_thickness = 0.05;
  VectorXd u = VectorXd::Zero(model.dofs.dof_count);
  const auto& zone = model.zones.front();
  for (const auto& [surface, lever] :
       {std::pair(&zone.master, half_thickness), {&zone.slave, -half_thickness}})
    for (const auto node : surface->nodes) {
      const double x = model.mesh.points[static_cast<std::size_t>(node)][0];
      u[model.dofs.dof(node, 0)] = 2 * height * x * lever;
      u[model.dofs.dof(node, 1)] = height * x * x;
    }
  return u;
}

/// The zone at the iterates of a few steps, over and over.
class Iterates {
public:
  explicit Iterates(std::int64_t which) : model_(two_beams(which)), start_(bent(model_, 0.1)) {
    for (const double height : {0.11, 0.1102, 0.110201, 0.12, 0.1203, 0.120301})
      iterates_.push_back(bent(model_, height));
  }
  const contact::Zone& zone() const { return model_.zones.front(); }
  contact::Configuration next() {
    at_ = (at_ + 1) % iterates_.size();
    return {&model_.mesh, &model_.dofs, &iterates_[at_], &start_};
  }
  VectorXd multipliers() const { return VectorXd::Zero(zone().multiplier_count()); }

private:
  model::Model model_;
  VectorXd start_;
  std::vector<VectorXd> iterates_;
  std::size_t at_ = 0;
};

void count(benchmark::State& state, const contact::Zone& zone) {
  const auto points = static_cast<double>(zone.points.size());
  state.SetLabel(zone_names[static_cast<std::size_t>(state.range(0))]);
  state.counters["point"] =
      benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void Evaluate(benchmark::State& state) {
  Iterates iterates(state.range(0));
  const auto multipliers = iterates.multipliers();
  for (auto _ : state)
    benchmark::DoNotOptimize(contact::evaluate(iterates.zone(), multipliers, iterates.next()).data());
  count(state, iterates.zone());
}

void EvaluateAgain(benchmark::State& state) {
  Iterates iterates(state.range(0));
  const auto multipliers = iterates.multipliers();
  contact::NeighbourList neighbours(iterates.zone());
  std::vector<contact::PointEvaluation> points;
  for (auto _ : state) {
    contact::evaluate(neighbours, multipliers, iterates.next(), points);
    benchmark::DoNotOptimize(points.data());
  }
  count(state, iterates.zone());
}

void UpdateNeighbours(benchmark::State& state) {
  Iterates iterates(state.range(0));
  contact::NeighbourList neighbours(iterates.zone());
  for (auto _ : state) {
    neighbours.update(iterates.next());
    benchmark::DoNotOptimize(neighbours.pairs().data());
  }
  count(state, iterates.zone());
}

void FindPairs(benchmark::State& state) {
  Iterates iterates(state.range(0));
  for (auto _ : state)
    benchmark::DoNotOptimize(contact::find_pairs(iterates.zone(), iterates.next()).data());
  count(state, iterates.zone());
}

BENCHMARK(Evaluate)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);
BENCHMARK(EvaluateAgain)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);
BENCHMARK(UpdateNeighbours)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);
BENCHMARK(FindPairs)->DenseRange(0, 3)->Unit(benchmark::kMicrosecond);

} // namespace
} // namespace rubato::bench::contact_kinematics
