// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs that are stopped, fail or come to their end, and go on.
#include <gtest/gtest.h>

#include "cli/program.hpp"
#include "decks.hpp"
#include "same_results.hpp"
#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <chrono>
#include <csignal>
#include <thread>

namespace rubato::resumed_test {
namespace {

using namespace std::chrono_literals;
using test::with;
using Arguments = std::vector<std::string>;

class ResumedRun : public testing::Test {
protected:
  test::Outcome run(const std::string& deck, const std::string& output, Arguments more = {}) const {
    test::write_text(folder_ / "deck.yaml", deck);
    more.insert(more.begin(), {"run", "deck.yaml", "-o", output});
    return test::run_program(more, folder_.path());
  }
  void expect_same(const std::string& a, const std::string& b) const {
    test::expect_same_results(folder_ / a, folder_ / b);
  }

  test::ScratchFolder folder_;
};

const std::string four_steps = test::two_blocks + "fields: {formats: [vtu, med], every: 3, last: false}\n";

TEST_F(ResumedRun, GoesBeyondItsEndAsIfItHadBeenToldBefore) {
  const auto longer = with(four_steps, "end: 4e-4", "end: 1e-3");
  ASSERT_EQ(run(longer, "whole").exit_code, 0);
  ASSERT_EQ(run(four_steps, "out").exit_code, 0);
  const auto outcome = run(four_steps, "out", {"--resume", "--set", "time.end=1e-3"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("run: goes on from t = 0.0004"), std::string::npos) << outcome.err;
  expect_same("whole", "out");
}

/// The copy of fields.med is there only while fields.med has more than the checkpoint.
TEST_F(ResumedRun, NeedsNoSecondCopyOfTheFields) {
  ASSERT_EQ(run(four_steps, "out").exit_code, 0);
  for (const auto& name : test::files_in(folder_ / "out"))
    EXPECT_FALSE(name.find("checkpoint") != std::string::npos && name.ends_with(".med")) << name;
  std::filesystem::remove(folder_ / "out/run/fields.med");
  const auto outcome = run(four_steps, "out", {"--resume", "--set", "time.end=1e-3"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("fields.med: does not exist, but the checkpoint counts on it"),
            std::string::npos)
      << outcome.err;
}

TEST_F(ResumedRun, FindsTheNextInstantWhereTheOldEndDiffersFromOneByRounding) {
  const auto at = [](const std::string& end) {
    return with(test::two_blocks, "step: 1e-4, end: 4e-4", "step: 1e-4, end: " + end);
  };
  ASSERT_EQ(run(at("3e-4"), "out").exit_code, 0); // three steps of 1e-4 are a little more
  ASSERT_EQ(run(at("5e-4"), "out", {"--resume"}).exit_code, 0);
  EXPECT_EQ(test::attempts_in(folder_ / "out/run/steps.jsonl").size(), 5U);
}

/// Obstacles are where the instant says, not where a checkpoint has left them. Records of explicit runs are
/// parts of the whole: only powers of 2 are the same ones whatever the end.
TEST_F(ResumedRun, MeetsMovingObstaclesWhereTheyWouldHaveBeen) {
  auto by_leaps = with(test::rolled_block, "scheme: hht, alpha: -0.1, step: 5e-3, end: 0.15",
                       "scheme: central_difference, record: 0.0009765625, end: 0.125");
  by_leaps = with(by_leaps, "friction: 0.4", "friction: 0.4\n    method: penalty");
  for (const auto& [deck, end] : {std::pair(test::rolled_block, "0.2"), std::pair(by_leaps, "0.1875")}) {
    const auto longer = std::string("time.end=") + end;
    ASSERT_EQ(run(deck, "whole", {"--set", longer}).exit_code, 0);
    ASSERT_EQ(run(deck, "out").exit_code, 0);
    const auto outcome = run(deck, "out", {"--resume", "--set", longer});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_same("whole", "out");
    const auto other = run(deck, "out", {"--resume", "--set", "contact.roller.obstacle.cylinder.radius=2"});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_NE(other.err.find("contact.roller.obstacle.cylinder.radius was 1.0 and is 2.0 now"),
              std::string::npos)
        << other.err;
  }
}

/// It is stored before, at and after the instant.
TEST_F(ResumedRun, GoesOnAcrossTheEndOfASupport) {
  const auto deck = with(four_steps, "  - {on: held, fix: [x, y]}\n",
                         "  - {on: held, fix: [x, y]}\n  - {on: tip, y: {velocity: -1}, until: 2e-4}\n");
  auto by_leaps = with(deck, "scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4",
                       "scheme: central_difference, record: 6.25e-5, end: 5e-4");
  by_leaps = with(with(by_leaps, "until: 2e-4", "until: 1.25e-4"), "friction: 0.2",
                  "friction: 0.2, method: penalty");
  const auto expect_no_seam = [&](const std::string& of, const std::string& end, const std::string& longer) {
    ASSERT_EQ(run(of, "whole", {"--set", "time.end=" + longer}).exit_code, 0);
    ASSERT_EQ(run(of, "out", {"--set", "time.end=" + end}).exit_code, 0);
    const auto outcome = run(of, "out", {"--resume", "--set", "time.end=" + longer});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_same("whole", "out");
  };
  for (const auto* end : {"1e-4", "2e-4", "3e-4"})
    expect_no_seam(deck, end, "6e-4");
  for (const auto* end : {"6.25e-5", "1.25e-4", "2.5e-4"})
    expect_no_seam(by_leaps, end, "5e-4");
}

TEST_F(ResumedRun, GoesOnWithWhatMaterialsRemember) {
  for (const auto& scheme :
       {"{scheme: static, step: 0.1, end: 0.6}", "{scheme: hht, alpha: -0.1, step: 0.1, end: 0.6}"}) {
    const auto deck = with(test::flowing_blocks, "{scheme: static, step: 0.1, end: 0.6}", scheme);
    ASSERT_EQ(run(deck, "whole", {"--set", "time.end=1"}).exit_code, 0);
    for (const auto* end : {"0.1", "0.3", "0.6"}) {
      ASSERT_EQ(run(deck, "out", {"--set", std::string("time.end=") + end}).exit_code, 0);
      const auto outcome = run(deck, "out", {"--resume", "--set", "time.end=1"});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      expect_same("whole", "out");
    }
    const auto other =
        run(deck, "out", {"--resume", "--set", "materials.metal.hardening.linear.yield_stress=11"});
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_NE(other.err.find("materials.metal.hardening"), std::string::npos) << other.err;
  }
}

TEST_F(ResumedRun, KeepsEnergyAcrossTheSeam) {
  ASSERT_EQ(run(test::bouncing_blocks, "whole", {"--set", "time.end=0.4"}).exit_code, 0);
  for (const auto* end : {"0.02", "0.1", "0.3"}) {
    ASSERT_EQ(run(test::bouncing_blocks, "out", {"--set", std::string("time.end=") + end}).exit_code, 0);
    const auto outcome = run(test::bouncing_blocks, "out", {"--resume", "--set", "time.end=0.4"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_same("whole", "out");
  }
}

TEST_F(ResumedRun, KeepsTheLinesOfConnectorsThatRotate) {
  const std::string by_central_difference =
      "time={scheme: central_difference, record: 5e-3, step: auto, end: 0.6}";
  for (const auto& time : {std::string("time.step=5e-3"), by_central_difference}) {
    ASSERT_EQ(run(test::swinging_block, "whole", {"--set", time}).exit_code, 0);
    for (const auto* end : {"0.3", "0.505"}) {
      ASSERT_EQ(run(test::swinging_block, "out", {"--set", time, "--set", std::string("time.end=") + end})
                    .exit_code,
                0);
      const auto outcome = run(test::swinging_block, "out", {"--resume", "--set", time});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      expect_same("whole", "out");
    }
  }
}

TEST_F(ResumedRun, KeepsTheShorteningOfALockedPreload) {
  const std::string deck = R"(mesh:
  generate: [{name: bolt, rectangle: {from: [0, 0], to: [1, 4]}, divisions: [2, 8], sides: {bottom: ground, top: head}}]
physics: plane_stress
materials: {steel: {young: 2e5, poisson: 0.3, density: 1e-3}}
functions: {tighten: {ramp: [0, 1]}}
supports: [{on: ground, fix: [x, y]}]
springs: [{on: head, y: 1e4}]
loads: [{surface_force: {on: head, y: 10, function: tighten}}]
preload: {m1: {cut: {point: [0, 1.7], normal: [0, 1]}, force: 100, function: tighten, lock: 0.2}}
probes: {cut: {section: {point: [0, 1.7], normal: [0, 1]}}}
time: {scheme: hht, alpha: -0.1, step: 0.1, end: 0.6}
)";
  ASSERT_EQ(run(deck, "whole").exit_code, 0);
  for (const auto* end : {"0.1", "0.2", "0.4"}) {
    ASSERT_EQ(run(deck, "out", {"--set", std::string("time.end=") + end}).exit_code, 0);
    const auto outcome = run(deck, "out", {"--resume"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_same("whole", "out");
  }
}

TEST_F(ResumedRun, OfAStoppedRunHasNoSeam) {
  const auto deck = with(test::rubbing_beams, "end: 0.03}", "end: 3}"); // nobody waits for its end
  test::write_text(folder_ / "deck.yaml", deck);
  test::Program program({"run", "deck.yaml", "-o", "out", "-q", "--only", "exact"}, folder_.path());
  const auto steps = folder_ / "out/exact/steps.jsonl";
  while (program.is_running() &&
         !(std::filesystem::exists(steps) && std::filesystem::file_size(steps) > 3000))
    std::this_thread::sleep_for(1ms);
  program.send(SIGINT);
  const auto stopped = program.wait();
  EXPECT_EQ(stopped.exit_code, 4);
  EXPECT_NE(stopped.err.find("--resume goes on from there"), std::string::npos) << stopped.err;

  const auto end =
      "runs.exact.time.end=" +
      std::to_string(test::summary_in(folder_ / "out/exact/run.json").at("steps").get<int>() * 5e-4 + 0.01);
  ASSERT_EQ(run(deck, "out", {"--only", "exact", "--resume", "--set", end}).exit_code, 0);
  ASSERT_EQ(run(deck, "whole", {"--only", "exact", "--set", end}).exit_code, 0);
  expect_same("whole", "out");
}

TEST_F(ResumedRun, OfARunInterruptedTwiceGoesOnFromItsLastCheckpoint) {
  const auto deck = with(with(test::rubbing_beams, "end: 0.03}", "end: 3}"), "at: [0.0115]", "every: 1");
  test::write_text(folder_ / "deck.yaml", deck);
  test::Program program({"run", "deck.yaml", "-o", "out", "-q", "--only", "exact"}, folder_.path());
  const auto checkpoint = folder_ / "out/exact/checkpoint.h5";
  while (program.is_running() && !std::filesystem::exists(checkpoint))
    std::this_thread::sleep_for(1ms);
  program.send(SIGINT);
  program.send(SIGTERM); // at once, wherever it is
  const auto code = program.wait().exit_code;
  EXPECT_TRUE(code == -SIGINT || code == -SIGTERM || code == 4) << code;
  ASSERT_TRUE(std::filesystem::exists(checkpoint));
  ASSERT_EQ(run(deck, "out", {"--only", "exact", "--resume", "--set", "runs.exact.time.end=0.05"}).exit_code,
            0);
  ASSERT_EQ(run(deck, "whole", {"--only", "exact", "--set", "runs.exact.time.end=0.05"}).exit_code, 0);
  expect_same("whole", "out");
}

TEST_F(ResumedRun, OfARunAtItsEndIsNotRunAgain) {
  ASSERT_EQ(run(test::rubbing_beams, "out", {"--only", "exact"}).exit_code, 0);
  const auto before = std::filesystem::last_write_time(folder_ / "out/exact/run.json");
  const auto outcome = run(test::rubbing_beams, "out", {"--resume"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("exact: complete already"), std::string::npos) << outcome.err;
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "out/exact/run.json"), before);
  ASSERT_EQ(run(test::rubbing_beams, "whole").exit_code, 0);
  expect_same("whole", "out");
}

/// With no friction left to raise and no step to cut it fails; resumed with cuts it does what it had done
/// with them from its beginning.
TEST_F(ResumedRun, OfAFailedOneMayUseOtherMeans) {
  const auto deck = with(test::rubbing_beams, "step: 5e-4, end: 0.03}",
                         "step: 5e-4, end: 0.03}\nnewton: {max_iterations: 1}");
  const auto failed = run(deck, "out", {"--only", "exact", "--set", "time.on_failure.levels=0"});
  EXPECT_EQ(failed.exit_code, 3) << failed.err;
  EXPECT_NE(failed.err.find("--resume goes on from there"), std::string::npos) << failed.err;
  const auto again = run(deck, "out", {"--only", "exact", "--resume", "--set", "newton.max_iterations=40"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
}

TEST_F(ResumedRun, StartsAtItsBeginningWhenThereIsNoCheckpoint) {
  const auto outcome = run(four_steps, "out", {"--resume"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("run: no checkpoint in out/run, starts at its beginning"), std::string::npos)
      << outcome.err;
}

TEST_F(ResumedRun, KeepsNothingWhenItShallNot) {
  ASSERT_EQ(run(four_steps + "checkpoint: {last: false}\n", "out").exit_code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/run/checkpoint.h5"));
}

} // namespace
} // namespace rubato::resumed_test
