// SPDX-License-Identifier: LGPL-3.0-or-later
// Attempts that fail: cut, told of, counted, and given up.
#include "rubato/deck/read.hpp"

#include "support/decks.hpp"
#include "support/simulated_blocks.hpp"
#include <cmath>
#include <stdexcept>
#include <variant>
#include <vector>

namespace rubato::simulation::cuts_test {
namespace {

using test::expect_same;

study::Study beams(const std::vector<deck::Setting>& changes) {
  return deck::parse_deck(test::two_beams, "deck.yaml", changes).runs.front();
}

/// Long steps that two iterations do not always solve.
study::Study cut_beams() {
  return beams({{"time.step", "4e-3"}, {"newton", "{max_iterations: 2, residual: 1e-10}"}});
}

/// One step that no iteration solves.
study::Study failing_beams() {
  return beams({{"newton", "{max_iterations: 1, residual: 1e-300}"}, {"time.on_failure.levels", "2"}});
}

TEST(ACutStep, IsToldOfCountedAndLeavesNothing) {
  Simulation simulation(cut_beams());
  int rejected = 0, iterations = 0, accepted = 0;
  simulation.observe({.accepted =
                          [&](const AcceptedStep& step) {
                            ++accepted;
                            iterations += step.report.iterations;
                          },
                      .rejected =
                          [&](const RejectedStep& step) {
                            ++rejected;
                            iterations += step.report.iterations;
                            EXPECT_FALSE(step.final);
                            EXPECT_FALSE(step.attempt.accepted);
                            EXPECT_EQ(step.attempt.steps, 0);
                            EXPECT_EQ(simulation.next().end, step.attempt.end) << "told before the cut";
                          }});
  int attempts = 0;
  for (; !simulation.finished(); ++attempts) {
    const auto before = simulation.state();
    const auto next = simulation.next();
    const auto result = simulation.attempt();
    if (result.accepted())
      continue;
    ASSERT_EQ(result.verdict, Verdict::cut);
    expect_same(simulation.state(), before);
    EXPECT_EQ(simulation.next().cut_level, next.cut_level + 1);
    EXPECT_LT(simulation.next().end, next.end);
  }
  EXPECT_GT(rejected, 0);
  EXPECT_EQ(simulation.counters(), (Counters{accepted, iterations, rejected}));
  EXPECT_EQ(attempts, accepted + rejected);
}

TEST(ACutStep, IsMadeByOneAdvanceInParts) {
  Simulation by_attempts(cut_beams());
  while (!by_attempts.finished())
    by_attempts.attempt();
  Simulation by_steps(cut_beams());
  int steps = 0;
  while (!by_steps.finished()) {
    ASSERT_TRUE(by_steps.advance().accepted());
    EXPECT_EQ(by_steps.counters().steps, ++steps);
  }
  EXPECT_GT(by_steps.counters().cuts, 0);
  expect_same(by_steps, by_attempts);
}

/// The parts that are left are part of a memento.
TEST(ACutStep, IsGoneOnWithInItsMidst) {
  Simulation whole(cut_beams());
  std::vector<Memento> mementos;
  while (!whole.finished()) {
    whole.attempt();
    mementos.push_back(whole.memento());
  }
  bool in_the_midst = false;
  for (const auto& memento : mementos) {
    Simulation resumed(cut_beams(), {.memento = &memento});
    in_the_midst = in_the_midst || (!resumed.finished() && resumed.next().cut_level > 0);
    test::go_to_end(resumed);
    expect_same(resumed, whole);
  }
  EXPECT_TRUE(in_the_midst);
}

TEST(ACutStep, IsNotCutWhenAnObserverThrows) {
  Simulation undisturbed(cut_beams());
  test::go_to_end(undisturbed);
  Simulation simulation(cut_beams());
  int throws = 0;
  bool thrown = false;
  simulation.observe({.rejected = [&](const RejectedStep&) {
    thrown = !thrown;
    if (thrown) {
      ++throws;
      throw std::runtime_error("the disk is full");
    }
  }});
  while (!simulation.finished()) {
    const auto before = simulation.memento();
    try {
      simulation.attempt();
    } catch (const std::runtime_error&) {
      expect_same(simulation.memento(), before);
    }
  }
  EXPECT_EQ(throws, undisturbed.counters().cuts);
  expect_same(simulation, undisturbed);
}

TEST(AStepThatCannotBeMade, LeavesTheSimulationWhereItWas) {
  Simulation simulation(failing_beams());
  const auto start = simulation.state();
  int final = 0;
  simulation.observe({.rejected = [&](const RejectedStep& step) { final += step.final ? 1 : 0; }});
  const auto result = simulation.advance();
  EXPECT_EQ(result.verdict, Verdict::not_converged);
  EXPECT_TRUE(result.report.failed());
  EXPECT_EQ(result.attempt.cut_level, 2);
  EXPECT_EQ(simulation.counters().cuts, 2);
  EXPECT_EQ(simulation.counters().steps, 0);
  EXPECT_EQ(final, 1);
  expect_same(simulation.state(), start);
  EXPECT_FALSE(simulation.finished());
  EXPECT_EQ(simulation.advance().verdict, Verdict::not_converged) << "tried again";
  EXPECT_EQ(final, 2);
}

TEST(ExplicitMotionBeyondAllBounds, LeavesTheSimulationWhereItWas) {
  Simulation simulation(test::explicit_blocks());
  auto start = simulation.memento();
  auto& velocity = std::get<ExplicitProgress>(start.progress).motion.v;
  for (Eigen::Index i = 0; i < velocity.size(); i += 2)
    velocity[i] = 1e305; // the forces of what it moves in a step are no numbers
  simulation.restore(start);
  bool finite = true;
  simulation.observe({.rejected = [&](const RejectedStep& step) {
    EXPECT_TRUE(step.final);
    finite = step.reached.motion.u.allFinite();
    expect_same(simulation.memento(), start);
  }});
  const auto result = simulation.advance();
  EXPECT_EQ(result.verdict, Verdict::not_converged);
  EXPECT_EQ(result.report.outcome, step::Outcome::not_finite);
  EXPECT_FALSE(finite);
  EXPECT_EQ(simulation.counters().steps, result.attempt.steps) << "made, if in vain";
  auto after = simulation.memento();
  after.counters = start.counters;
  expect_same(after, start);
}

} // namespace
} // namespace rubato::simulation::cuts_test
