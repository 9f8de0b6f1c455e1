// SPDX-License-Identifier: LGPL-3.0-or-later
// A run is a simulation that is recorded: both come to the same end.
#include "rubato/run/run_study.hpp"
#include "rubato/simulation/time_integration.hpp"

#include "support/scratch_folder.hpp"
#include "support/simulated_blocks.hpp"

namespace rubato::run::simulated_run_test {
namespace {

class SimulatedRun : public testing::TestWithParam<test::Kind> {};

TEST_P(SimulatedRun, EndsWhereStepAfterStepEnds) {
  const test::ScratchFolder folder;
  const auto run = run_study(GetParam().study, folder / "run", {});
  ASSERT_EQ(run.status, Status::complete) << run.message;
  simulation::Simulation simulation(GetParam().study);
  step::EnergyRecord energy;
  while (!simulation.finished()) {
    ASSERT_TRUE(simulation.advance().accepted());
    energy.note(simulation.state().t, simulation.energy());
  }
  test::expect_same(simulation.state(), run.end);
  EXPECT_EQ(simulation.counters(), (simulation::Counters{run.steps, run.iterations, run.cuts}));
  EXPECT_EQ(energy.largest, run.energy.largest);
  EXPECT_EQ(energy.largest_balance, run.energy.largest_balance);
}

INSTANTIATE_TEST_SUITE_P(Kinds, SimulatedRun, test::both_kinds(), test::name_of_kind);

} // namespace
} // namespace rubato::run::simulated_run_test
