// SPDX-License-Identifier: LGPL-3.0-or-later
// A run that is asked to end inside a step, and goes on.
#include "rubato/deck/read.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/run/run_study.hpp"

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::run::interrupted_run_test {
namespace {

class InterruptedRun : public testing::Test {
protected:
  explicit InterruptedRun(const std::string& deck = test::two_blocks)
      : study_(deck::parse_deck(deck, "deck.yaml").runs.front()) {}

  RunResult run(const std::string& folder, const Watch& watch = {}, Begin begin = Begin::anew) const {
    return run_study(study_, folder_ / folder, watch, nullptr, begin);
  }

  const study::Study study_;
  test::ScratchFolder folder_;
};

TEST_F(InterruptedRun, EndsInsideTheStepAndGoesOnAsIfNothingHadBeen) {
  const auto whole = run("whole");
  bool stop = false;
  Watch watch;
  watch.stop = [&] { return stop; };
  watch.within = [&](const Progress& progress) { stop = stop || progress.t > 2.5e-4; };
  const auto result = run("out", watch);
  EXPECT_EQ(result.status, Status::interrupted);
  EXPECT_EQ(result.message, "interrupted at t = 0.0002, in the step to t = 0.0003");
  EXPECT_EQ(result.steps, 2);
  EXPECT_EQ(result.cuts, 0);
  EXPECT_EQ(result.end.t, 2e-4);
  EXPECT_TRUE(result.kept);
  EXPECT_EQ(results::read_csv(folder_ / "out/probes.csv").rows.size(), 3U);

  const auto resumed = run("out", {}, Begin::resumed);
  ASSERT_EQ(resumed.status, Status::complete) << resumed.message;
  EXPECT_EQ(resumed.end.motion.u, whole.end.motion.u);
  EXPECT_EQ(resumed.iterations, whole.iterations);
}

TEST_F(InterruptedRun, TellsOfEveryIteration) {
  int within = 0;
  int iterations = 0;
  Watch watch;
  watch.within = [&](const Progress& progress) {
    EXPECT_TRUE(progress.within);
    EXPECT_FALSE(progress.accepted);
    within = std::max(within, progress.iterations + 1);
  };
  watch.progress = [&](const Progress& progress) {
    EXPECT_FALSE(progress.within);
    EXPECT_EQ(within, progress.iterations) << "in the step to " << progress.t;
    iterations += progress.iterations;
    within = 0;
  };
  EXPECT_EQ(run("out", watch).iterations, iterations);
}

/// Two lengths of steps: two factors.
const std::string two_lengths =
    test::with(test::two_blocks, "step: 1e-4, end: 4e-4", "instants: [1e-4, 2e-4, 4e-4, 6e-4]");

class WaitingRun : public InterruptedRun {
protected:
  WaitingRun() : InterruptedRun(two_lengths) {}

  /// Stops the run where it asks for memory for the `last`-th time.
  Watch stopping_at(int last) {
    Watch watch;
    watch.room = [this, last](std::size_t bytes) {
      asked_.push_back(bytes > 0);
      if (std::ranges::count(asked_, true) == last)
        throw StoppedWhileWaiting();
    };
    return watch;
  }

  std::vector<bool> asked_;
};

TEST_F(WaitingRun, AsksForTheMemoryOfEachFactorAndTellsThatStepsBegin) {
  EXPECT_EQ(run("out", stopping_at(-1)).status, Status::complete);
  EXPECT_EQ(asked_, (std::vector{true, false, true}));
}

TEST_F(WaitingRun, StoppedBeforeItsFirstStepHasWrittenNothing) {
  EXPECT_THROW(run("out", stopping_at(1)), StoppedWhileWaiting);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(WaitingRun, StoppedOnItsWayGoesOnAsIfNothingHadBeen) {
  const auto whole = run("whole");
  const auto result = run("out", stopping_at(2));
  EXPECT_EQ(result.status, Status::interrupted);
  EXPECT_EQ(result.message, "interrupted at t = 0.0002");
  EXPECT_TRUE(result.kept);
  const auto resumed = run("out", {}, Begin::resumed);
  ASSERT_EQ(resumed.status, Status::complete) << resumed.message;
  EXPECT_EQ(resumed.end.motion.u, whole.end.motion.u);
}

} // namespace
} // namespace rubato::run::interrupted_run_test
