// SPDX-License-Identifier: LGPL-3.0-or-later
// When a run keeps a checkpoint. Which ones it goes on from: tests/restart.
#include "rubato/run/checkpoints.hpp"

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include "support/simulated_blocks.hpp"
#include <stdexcept>
#include <vector>

namespace rubato::run::checkpoints_test {
namespace {

class Checkpoints : public testing::Test {
protected:
  Checkpoints() {
    watch_.warn = [this](const std::string& text) { warned_.push_back(text); };
  }
  /// Of ten steps of 0.1 from t = 0, those after which a checkpoint is written.
  std::vector<int> kept(std::vector<double> at, int every) {
    study_.checkpoint = {std::move(at), every, true};
    const CheckpointWriter writer(study_, course_, watch_);
    std::vector<int> steps;
    double t = 0;
    for (int count = 1; count <= 10; ++count)
      if (writer.is_due(count, t += 0.1, 0.1))
        steps.push_back(count);
    return steps;
  }

  test::ScratchFolder folder_;
  study::Study study_;
  RunContext course_{
      folder_.path(), 0, 0, {}, std::optional<results::FolderClaim>(std::in_place, folder_.path())};
  Watch watch_;
  std::vector<std::string> warned_;
};

TEST_F(Checkpoints, AreKeptEverySoManySteps) {
  EXPECT_EQ(kept({}, 3), (std::vector<int>{3, 6, 9}));
  EXPECT_EQ(kept({}, 0), std::vector<int>{});
}

/// Sums of 0.1 are beside their instants by rounding.
TEST_F(Checkpoints, AreKeptOnceAtOrAfterEachInstant) {
  EXPECT_EQ(kept({0.3}, 0), std::vector<int>{3});
  EXPECT_EQ(kept({0.25, 0.8}, 0), (std::vector<int>{3, 8}));
  EXPECT_EQ(kept({0.21, 0.29}, 0), std::vector<int>{3});
  EXPECT_EQ(kept({0.1 + 1e-9}, 0), std::vector<int>{1});
  EXPECT_EQ(kept({0.1 + 1e-6}, 0), std::vector<int>{2});
  EXPECT_EQ(kept({0}, 0), std::vector<int>{}) << "before the first step";
  EXPECT_EQ(kept({0.5}, 4), (std::vector<int>{4, 5, 8}));
}

TEST_F(Checkpoints, OfAFailureAreKeptInImplicitRuns) {
  for (const bool last : {true, false}) {
    auto implicit = test::implicit_blocks();
    auto fast = test::explicit_blocks();
    implicit.checkpoint.last = fast.checkpoint.last = last;
    const CheckpointWriter of_implicit(implicit, course_, watch_);
    const CheckpointWriter of_fast(fast, course_, watch_);
    EXPECT_EQ(of_implicit.keeps_end(), last);
    EXPECT_EQ(of_fast.keeps_end(), last);
    EXPECT_EQ(of_implicit.keeps_failure(), last);
    EXPECT_FALSE(of_fast.keeps_failure());
  }
}

TEST_F(Checkpoints, ThatCannotBeWrittenAreWarnedOf) {
  const CheckpointWriter writer(study_, course_, watch_);
  EXPECT_FALSE(writer.keep([]() -> results::Checkpoint { throw std::runtime_error("the disk is full"); }));
  EXPECT_EQ(warned_, std::vector<std::string>{"no checkpoint was written: the disk is full"});
}

TEST_F(Checkpoints, AreNoneInAnEmptyFolder) {
  EXPECT_FALSE(find_checkpoint(study_, course_));
  EXPECT_FALSE(finished_run(study_, course_));
  EXPECT_FALSE(unchanged_run(study_, course_));
}

} // namespace
} // namespace rubato::run::checkpoints_test
