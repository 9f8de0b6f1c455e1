// SPDX-License-Identifier: LGPL-3.0-or-later
// What a run says, what it leaves in its folder, and when it is not made again.
#include "rubato/core/processor_time.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/results/checkpoint.hpp"
#include "rubato/results/csv.hpp"
#include "rubato/results/run_folder.hpp"
#include "rubato/results/stored_run.hpp"
#include "rubato/run/run_study.hpp"

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace rubato::run::time_loop_test {
namespace {

using test::two_blocks;
using test::with;
using Lines = std::vector<std::string>;

study::Study study_of(const std::string& deck, const std::vector<deck::Setting>& changes = {}) {
  return deck::parse_deck(deck, "deck.yaml", changes).runs.front();
}

bool has(const Lines& lines, const std::string& part) {
  return std::ranges::any_of(lines, [&](const auto& line) { return line.find(part) != std::string::npos; });
}

/// A run of two blocks, four steps of 1e-4, and all that it tells.
class WatchedRun : public testing::Test {
protected:
  WatchedRun() {
    watch_.say = [this](const std::string& text) { said_.push_back(text); };
    watch_.warn = [this](const std::string& text) { warned_.push_back(text); };
    watch_.progress = [this](const Progress& progress) { told_.push_back(progress); };
  }

  RunResult run(const study::Study& study, Begin begin = Begin::anew) {
    said_.clear();
    warned_.clear();
    told_.clear();
    return run_study(study, folder_ / "out", watch_, nullptr, begin);
  }
  std::string out() const { return (folder_ / "out").string(); }
  std::size_t records() const { return results::read_csv(folder_ / "out/probes.csv").rows.size(); }

  test::ScratchFolder folder_;
  Watch watch_;
  Lines said_, warned_;
  std::vector<Progress> told_;
  const study::Study study_ = study_of(two_blocks);
};

/// 2 × 15 nodes of which 6 are held; 5 slave nodes.
TEST_F(WatchedRun, SaysWhatItRunsAndHow) {
  run(study_);
  EXPECT_EQ(said_.front(), "run: 30 nodes, 48 unknowns, 5 contact points");
  EXPECT_TRUE(has(said_, "run: scheme hht"));
  EXPECT_TRUE(has(said_, "run: solver condensed on contact points"));
  EXPECT_EQ(std::ranges::count_if(said_,
                                  [](const auto& line) {
                                    return line.find("factoring the matrix takes") != std::string::npos;
                                  }),
            1);
  EXPECT_TRUE(warned_.empty()) << warned_.front();
}

TEST_F(WatchedRun, TellsOfEachStepOnce) {
  const auto result = run(study_);
  ASSERT_EQ(result.status, Status::complete) << result.message;
  ASSERT_EQ(told_.size(), 4U);
  int iterations = 0;
  for (std::size_t i = 0; i < told_.size(); ++i) {
    EXPECT_NEAR(told_[i].t, 1e-4 * static_cast<double>(i + 1), 1e-18);
    EXPECT_NEAR(told_[i].step, 1e-4, 1e-18);
    EXPECT_EQ(told_[i].begin, 0);
    EXPECT_EQ(told_[i].end, 4e-4);
    EXPECT_TRUE(told_[i].accepted);
    iterations += told_[i].iterations;
  }
  EXPECT_EQ(told_.back().contact_points, step::points_in_contact(result.end));
  EXPECT_GT(told_.back().contact_points, 0);
  EXPECT_EQ(result.steps, 4);
  EXPECT_EQ(result.iterations, iterations);
  EXPECT_EQ(records(), 5U);
}

TEST_F(WatchedRun, WarnsOfASchemeThatContactFeeds) {
  run(study_of(two_blocks, {{"time.scheme", "newmark"}, {"time.alpha", "~"}}));
  EXPECT_TRUE(has(warned_, "run: newmark without damping gains energy where exact contact opens and closes"));
  run(study_of(two_blocks, {{"time.scheme", "newmark"}, {"time.alpha", "~"}, {"contact", "~"}}));
  EXPECT_TRUE(warned_.empty()) << warned_.front();
}

TEST_F(WatchedRun, WarnsOfTheNotesOnItsModel) {
  run(study_of(with(two_blocks, "{node: tip}", "{point: [1, 0.15]}")));
  EXPECT_TRUE(has(warned_, "run: probe 'end': 2 nodes are equally near to its point")) << warned_.size();
}

TEST_F(WatchedRun, ThatIsStoppedAtOnceKeepsItsBeginning) {
  watch_.stop = [] { return true; };
  const auto result = run(study_);
  EXPECT_EQ(result.status, Status::interrupted);
  EXPECT_EQ(result.message, "interrupted at t = 0");
  EXPECT_EQ(result.steps, 0);
  EXPECT_TRUE(result.kept);
  EXPECT_TRUE(told_.empty());
  EXPECT_EQ(records(), 1U);
  EXPECT_EQ(results::read_stored_run(folder_ / "out").status, Status::interrupted);
}

/// Its first part takes half a second more than its two steps need.
TEST_F(WatchedRun, GoesOnFromItsCheckpointWithTheTimeThatItHasTaken) {
  watch_.stop = [this] {
    for (const double end = processor_seconds() + 0.25; processor_seconds() < end;) {
    }
    return told_.size() == 2;
  };
  const auto first = run(study_);
  EXPECT_EQ(first.steps, 2);
  watch_.stop = [] { return false; };
  const auto second = run(study_, Begin::resumed);
  ASSERT_EQ(second.status, Status::complete) << second.message;
  EXPECT_EQ(said_.front(), "run: goes on from t = 0.0002");
  EXPECT_EQ(told_.size(), 2U);
  EXPECT_EQ(second.steps, 4);
  EXPECT_GT(second.loop_seconds, first.loop_seconds);
  EXPECT_GT(second.setup_seconds, first.setup_seconds);
  EXPECT_EQ(records(), 5U);
}

TEST_F(WatchedRun, ThatIsCompleteIsNotResumed) {
  const auto whole = run(study_);
  const auto again = run(study_, Begin::resumed);
  EXPECT_EQ(said_, (Lines{"run: complete already"}));
  EXPECT_TRUE(told_.empty());
  EXPECT_EQ(again.status, Status::complete);
  EXPECT_TRUE(again.kept);
  EXPECT_EQ(again.steps, whole.steps);
  EXPECT_EQ(again.iterations, whole.iterations);
  EXPECT_EQ(again.end.motion.u, whole.end.motion.u);
}

TEST_F(WatchedRun, WithoutACheckpointStartsAtItsBeginning) {
  const auto result = run(study_, Begin::resumed);
  EXPECT_EQ(said_.front(), "run: no checkpoint in " + out() + ", starts at its beginning");
  EXPECT_EQ(result.steps, 4);
}

TEST_F(WatchedRun, IsMadeAgainOnlyWhereSomethingHasChanged) {
  const auto whole = run(study_, Begin::unless_done);
  EXPECT_EQ(whole.steps, 4);
  const auto again = run(study_, Begin::unless_done);
  EXPECT_EQ(said_, (Lines{"run: complete and unchanged in " + out() + ", not computed again"}));
  EXPECT_EQ(again.end.motion.u, whole.end.motion.u);
  const auto other = run(study_of(two_blocks, {{"loads.0.nodal_force.y", "-2e7"}}), Begin::unless_done);
  EXPECT_EQ(told_.size(), 4U);
  EXPECT_NE(other.end.motion.u, whole.end.motion.u);
}

TEST_F(WatchedRun, PutsFormerResultsAside) {
  run(study_);
  EXPECT_FALSE(has(said_, "the former results"));
  run(study_);
  EXPECT_TRUE(has(said_, "run: the former results in " + out() + " move into " + out() + "/former"));
  EXPECT_TRUE(results::holds_run(folder_ / "out/former"));
  EXPECT_EQ(records(), 5U);
}

/// One iteration is not enough, and no step may be cut: the first step fails.
TEST_F(WatchedRun, ThatDoesNotConvergeKeepsWhatItReached) {
  const auto result = run(study_of(
      two_blocks, {{"solver", "full"}, {"newton.max_iterations", "1"}, {"time.on_failure.levels", "0"}}));
  EXPECT_EQ(result.status, Status::not_converged);
  EXPECT_EQ(result.message.rfind("no convergence from t = 0 to 0.0001 (too many iterations", 0), 0U)
      << result.message;
  EXPECT_EQ(result.steps, 0);
  EXPECT_EQ(result.end.t, 0);
  EXPECT_TRUE(result.kept);
  ASSERT_EQ(told_.size(), 1U);
  EXPECT_FALSE(told_[0].accepted);
  const auto stored = results::read_stored_run(folder_ / "out");
  EXPECT_EQ(stored.status, Status::not_converged);
  EXPECT_EQ(stored.reason, result.message);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / results::checkpoint_file));
}

TEST_F(WatchedRun, KeepsACheckpointEverySoManySteps) {
  const auto result = run(study_of(two_blocks + "checkpoint: {every: 2, last: false}\n"));
  EXPECT_EQ(result.steps, 4);
  EXPECT_EQ(results::read_checkpoint(folder_ / "out" / results::checkpoint_file).memento.state.t, 2e-4);
}

TEST_F(WatchedRun, KeepsNoCheckpointThatIsNotWanted) {
  const auto result = run(study_of(two_blocks + "checkpoint: {last: false}\n"));
  EXPECT_FALSE(result.kept);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / results::checkpoint_file));
}

TEST_F(WatchedRun, HoldsItsChecksOnlyWhenAllHold) {
  EXPECT_TRUE(RunResult{}.checks_hold());
  const auto checked = [&](const std::string& second) {
    return run(study_of(two_blocks +
                        "checks:\n  - {probe: end.x, at: 0, reference: 0, tolerance: 1e-9, kind: absolute}\n"
                        "  - {probe: end.y, at: 0, reference: " +
                        second + ", tolerance: 1e-9, kind: absolute}\n"));
  };
  EXPECT_TRUE(checked("0").checks_hold());
  const auto failed = checked("1");
  EXPECT_EQ(failed.status, Status::complete);
  EXPECT_EQ(failed.checks.size(), 2U);
  EXPECT_FALSE(failed.checks_hold());
}

} // namespace
} // namespace rubato::run::time_loop_test
