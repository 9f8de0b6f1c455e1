// SPDX-License-Identifier: LGPL-3.0-or-later
/// What one implicit step of SDNL140 costs in the midst of contact, after 6 ms of motion.
///   CondensedStep  the step; the columns of compliance it needs are there from former steps
///   MeasurePoints  where all contact points are, as each of its iterations asks
/// Arguments: 0 F, 1 C; how often cells are cut. Counters: points in contact; iterations of the step;
/// iteration, the seconds of processor time of one when a forward and backward solve are taken off.
#include "rubato/core/processor_time.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/simulation/time_integration.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/common/contact_evaluator.hpp"

#include <benchmark/benchmark.h>

#include "sdnl140.hpp"
#include <array>
#include <stdexcept>

namespace rubato::bench::condensed_step {
namespace {

constexpr std::array decks{"f.yaml", "c.yaml"};
constexpr double motion = 6e-3; ///< [s]

step::State in_motion(const model::Model& model) {
  simulation::Simulation beams(model);
  while (beams.state().t < motion)
    if (!beams.advance().accepted())
      throw std::runtime_error("a step did not converge");
  return beams.state();
}

/// A study in motion.
class Beams {
public:
  explicit Beams(const benchmark::State& state)
      : model_(model::build_model(bench::sdnl140(decks.at(static_cast<std::size_t>(state.range(0))),
                                                 static_cast<int>(state.range(1)),
                                                 1e-3 / static_cast<double>(state.range(1)), 1))),
        scheme_(time::make_scheme(model_.study.time)), committed_(in_motion(model_)),
        system_(step::make_effective_system(model_, scheme_, model_.study.time.step)) {
    advance(); // so that all it needs is there
  }

  step::StepReport advance() {
    auto report = step::advance(model_, scheme_, system_, committed_, committed_.t + system_.step, trial_);
    if (!report.converged())
      throw std::runtime_error("a step did not converge");
    return report;
  }

  void measure(step::ContactIterate& points) {
    const step::ContactEvaluator side(model_, scheme_, system_, committed_, {});
    side.measure(trial_, step::Frozen(model_.zones.size()), points);
  }

  /// Of a forward and a backward solve [s].
  double solve_seconds() const {
    constexpr int times = 20;
    const Eigen::VectorXd force = Eigen::VectorXd::Ones(system_.matrix.rows());
    const double start = processor_seconds();
    for (int i = 0; i < times; ++i)
      benchmark::DoNotOptimize(system_.compliance->solve(force).data());
    return (processor_seconds() - start) / times;
  }
  int active() const { return step::points_in_contact(trial_); }

private:
  model::Model model_;
  time::Scheme scheme_;
  step::State committed_;
  step::EffectiveSystem system_;
  step::State trial_;
};

void label(benchmark::State& state) {
  state.SetLabel(std::string(state.range(0) == 0 ? "F" : "C") + " refined " + std::to_string(state.range(1)));
}

void CondensedStep(benchmark::State& state) {
  Beams beams(state);
  const double solve = beams.solve_seconds();
  double iterations = 0;
  const double start = processor_seconds();
  for (auto _ : state)
    iterations += beams.advance().iterations;
  const double rest = processor_seconds() - start - solve * static_cast<double>(state.iterations());
  label(state);
  state.counters["active"] = beams.active();
  state.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
  state.counters["iteration"] = rest / iterations;
}

void MeasurePoints(benchmark::State& state) {
  Beams beams(state);
  step::ContactIterate points;
  for (auto _ : state) {
    beams.measure(points);
    benchmark::DoNotOptimize(points.points.data());
  }
  label(state);
  state.counters["active"] = beams.active();
}

void sizes(benchmark::internal::Benchmark* kernel) {
  kernel->Args({0, 1})->Args({0, 4})->Args({1, 1})->Args({1, 2})->Args({1, 4});
  kernel->Unit(benchmark::kMicrosecond);
}

BENCHMARK(CondensedStep)->Apply(sizes);
BENCHMARK(MeasurePoints)->Apply(sizes);

} // namespace
} // namespace rubato::bench::condensed_step
