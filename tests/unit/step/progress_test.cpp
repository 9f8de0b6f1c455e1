// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps that are asked to end: in every loop they have, and nothing is left of them.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/progress.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <cmath>

namespace rubato::step::progress_test {
namespace {

using test::Walk;

TEST(Progress, GoesOnWithoutAFunction) {
  Progress progress;
  EXPECT_TRUE(progress.report());
  EXPECT_TRUE(progress.report(3, 0.1));
  EXPECT_FALSE(progress.stopped());
}

TEST(Progress, CountsIterationsAndTellsWhatItKnewLast) {
  std::vector<ProgressState> heard;
  Progress progress([&](const ProgressState& state) {
    heard.push_back(state);
    return true;
  });
  progress.report();
  progress.report(3, 0.5);
  progress.report();
  progress.report(4, 0.25);
  ASSERT_EQ(heard.size(), 4U);
  EXPECT_TRUE(std::isnan(heard[0].residual));
  EXPECT_EQ(heard[1].iterations, 0);
  EXPECT_EQ(heard[2].iterations, 1);
  EXPECT_EQ(heard[2].contact_points, 3);
  EXPECT_EQ(heard[3].iterations, 1);
  EXPECT_EQ(heard[3].residual, 0.25);
}

TEST(Progress, OnceStoppedAsksNoMore) {
  int asked = 0;
  Progress progress([&](const ProgressState&) { return ++asked < 2; });
  EXPECT_TRUE(progress.report());
  EXPECT_FALSE(progress.report());
  EXPECT_FALSE(progress.report(1, 1));
  EXPECT_TRUE(progress.stopped());
  EXPECT_EQ(asked, 2);
}

struct Way {
  const char* name;
  std::vector<deck::Setting> settings;
};

class InterruptedStep : public testing::TestWithParam<Way> {
protected:
  InterruptedStep() : walk_(test::two_beams, GetParam().settings) {
    EXPECT_TRUE(walk_.advance()); // the beams touch
    system_.emplace(make_effective_system(walk_.model, walk_.scheme, walk_.length()));
  }

  StepReport step(State& trial, const GoesOn& goes_on = {}) {
    return advance(walk_.model, walk_.scheme, *system_, walk_.state(), walk_.target(), trial, goes_on);
  }

  Walk walk_;
  std::optional<EffectiveSystem> system_;
};

TEST_P(InterruptedStep, LeavesNothingBehindWhereverItIs) {
  const State before = walk_.state();
  State whole;
  int reports = 0;
  const auto report = step(whole, [&](const ProgressState&) { return ++reports > 0; });
  ASSERT_TRUE(report.converged());
  ASSERT_GE(reports, report.iterations) << "a report an iteration at least";
  for (int last = 1; last <= reports; ++last) {
    State trial;
    int asked = 0;
    const auto interrupted = step(trial, [&](const ProgressState&) { return ++asked < last; });
    EXPECT_EQ(interrupted.outcome, Outcome::interrupted) << "at report " << last;
    EXPECT_EQ(asked, last) << "went on after it was to end";
    EXPECT_FALSE(interrupted.failed());
  }
  EXPECT_EQ(walk_.state().motion.u, before.motion.u);
  EXPECT_EQ(walk_.state().zones.front().multipliers, before.zones.front().multipliers);
  EXPECT_EQ(walk_.state().zones.front().status, before.zones.front().status);
  State again;
  ASSERT_TRUE(step(again).converged());
  EXPECT_EQ(again.motion.u, whole.motion.u) << "the step is another one after it was interrupted";
  EXPECT_EQ(again.zones.front().multipliers, whole.zones.front().multipliers);
}

TEST_P(InterruptedStep, TellsOfItsIterations) {
  State trial;
  ProgressState last;
  bool knows_residual = false;
  const auto report = step(trial, [&](const ProgressState& state) {
    EXPECT_GE(state.iterations, last.iterations);
    EXPECT_LE(state.iterations, last.iterations + 1);
    last = state;
    knows_residual = knows_residual || std::isfinite(state.residual);
    return true;
  });
  EXPECT_GE(last.iterations, report.iterations - 1) << "a report is before the last linear solve";
  EXPECT_LE(last.iterations, report.iterations);
  EXPECT_GT(last.contact_points, 0);
  EXPECT_TRUE(knows_residual || !report.rounds.empty()) << "rounds of loops may have one iteration each";
}

INSTANTIATE_TEST_SUITE_P(
    By, InterruptedStep,
    testing::Values(Way{"PointsOnNodes", {}},
                    Way{"GaussPoints", {{"contact.interface.integration", "{gauss: 2}"}}},
                    Way{"WholeSystem", {{"solver", "full"}}},
                    Way{"ProjectedGradients",
                        {{"contact.interface.method", "nodal_pcg"}, {"contact.interface.friction", "0"}}},
                    Way{"Loops",
                        {{"contact.interface.iterate",
                          "{geometry: fixed_point, friction: fixed_point, status: fixed_point}"}}}),
    [](const auto& chosen) { return std::string(chosen.param.name); });

/// Failing attempts are made again in other ways; an interrupted one is not.
TEST(InterruptedAttempt, IsNotRepeated) {
  Walk walk(test::two_beams, {{"newton", "{max_iterations: 1, residual: 1e-300}"}});
  auto system = make_effective_system(walk.model, walk.scheme, walk.length());
  int reports = 0;
  State trial;
  const auto count = [&](const ProgressState&) { return ++reports > 0; };
  EXPECT_TRUE(advance(walk.model, walk.scheme, system, walk.state(), 1e-3, trial, count).failed());
  const int all = reports;
  reports = 0;
  const auto stop = [&](const ProgressState&) { return ++reports < 2; };
  const auto report = advance(walk.model, walk.scheme, system, walk.state(), 1e-3, trial, stop);
  EXPECT_EQ(report.outcome, Outcome::interrupted);
  EXPECT_EQ(reports, 2);
  EXPECT_GT(all, 2);
}

} // namespace
} // namespace rubato::step::progress_test
