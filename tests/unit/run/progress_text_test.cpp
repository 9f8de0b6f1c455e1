// SPDX-License-Identifier: LGPL-3.0-or-later
// The line that shows how far a run is.
#include "rubato/run/progress_text.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <string>
#include <vector>

namespace rubato::run::progress_text_test {
namespace {

constexpr std::size_t usual = 80;

/// A quarter of a run from 0 to 0.04 is done.
Progress quarter(std::string_view name) {
  Progress progress;
  progress.run = name;
  progress.end = 0.04;
  progress.t = 0.01;
  progress.step = 1.25e-5;
  progress.iterations = 12;
  progress.contact_points = 1234;
  return progress;
}

TEST(TerminalLine, ShowsTheTimeLeftAtEightyColumns) {
  const auto line = terminal_line(quarter("evol1"), 20, usual);
  EXPECT_EQ(line, "evol1 [###............] t = 0.01  iterations 12  in contact 1234  left 1:00 min");
}

TEST(TerminalLine, IsWideWhereThereIsRoom) {
  const auto line = terminal_line(quarter("evol1"), 20, 120);
  EXPECT_EQ(line, "evol1 [######..................] t = 0.01  h = 1.25e-05  iterations 12  in contact 1234  "
                  "left 1:00 min");
}

TEST(TerminalLine, NeverWrapsAndKeepsTheTimeLeft) {
  for (const auto* name :
       {"a", "evol1", "sliding_with_a_much_smaller_step_and_a_name_that_nobody_can_pronounce"})
    for (std::size_t columns = 30; columns <= 130; ++columns)
      for (const bool accepted : {true, false}) {
        auto progress = quarter(name);
        progress.accepted = accepted;
        const auto line = terminal_line(progress, 20, columns);
        EXPECT_LT(line.size(), columns) << line;
        EXPECT_TRUE(line.ends_with("min")) << line;
        EXPECT_NE(line.find(" t = 0.01"), std::string::npos) << line;
      }
}

TEST(TerminalLine, KeepsWithinTheNarrowestTerminal) {
  for (std::size_t columns = 0; columns < 30; ++columns)
    EXPECT_LE(terminal_line(quarter("evol1"), 20, columns).size(), columns == 0 ? 0 : columns - 1);
}

TEST(TerminalLine, OfAFailedStepCountsFromItsBegin) {
  auto progress = quarter("evol1");
  progress.accepted = false;
  progress.t = progress.step; // the first step: nothing is done, nothing is known of the time left
  const auto line = terminal_line(progress, 20, usual);
  EXPECT_EQ(line, "evol1 [............] t = 1.25e-05 (failed, cut)  iterations 12  in contact 1234");
}

Progress within(double t = 0.01) {
  auto progress = quarter("evol1");
  progress.t = t;
  progress.accepted = false;
  progress.within = true;
  progress.residual = 2.3e-5;
  return progress;
}

TEST(TerminalLine, OfTheInsideOfAStepShowsItsResidual) {
  const auto line = terminal_line(within(), 20, 120);
  EXPECT_NE(line.find("iterations 12  in contact 1234  residual 2.3e-05  left "), std::string::npos) << line;
  EXPECT_EQ(line.find("failed"), std::string::npos) << line;
  auto unknown = within();
  unknown.residual = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(terminal_line(unknown, 20, 120).find("residual"), std::string::npos);
}

TEST(TerminalLine, OfTheInsideOfAStepFitsEightyColumns) {
  const auto line = terminal_line(within(), 20, usual);
  EXPECT_LT(line.size(), usual);
  EXPECT_NE(line.find("iterations 12"), std::string::npos) << line;
  EXPECT_TRUE(line.ends_with("min")) << line;
}

class PaceOfAFile : public testing::Test {
protected:
  static constexpr std::chrono::milliseconds second{1000};
  PaceOfAFile() { pace_.begin(begin_); }

  const Pace::Clock::time_point begin_{std::chrono::hours(1)};
  Pace pace_{false};
};

TEST_F(PaceOfAFile, IsASecondBetweenSteps) {
  EXPECT_TRUE(pace_.is_due(quarter("a"), begin_ + second / 10)) << "the first one";
  EXPECT_FALSE(pace_.is_due(quarter("a"), begin_ + second));
  EXPECT_TRUE(pace_.is_due(quarter("a"), begin_ + 2 * second));
  EXPECT_FALSE(pace_.is_due(quarter("a"), begin_ + 5 * second / 2));
}

TEST_F(PaceOfAFile, IsAtMostFiveSecondsInsideAStepHoweverLongItsIterations) {
  for (const int iteration : {10, 100, 900, 2000, 2400, 3000, 4900}) {
    auto shown = begin_;
    Pace pace(false);
    pace.begin(begin_);
    for (auto now = begin_; now < begin_ + 60 * second; now += std::chrono::milliseconds(iteration)) {
      EXPECT_LE(now - shown, 5 * second) << iteration;
      if (now > begin_ && pace.is_due(within(), now))
        shown = now;
    }
  }
}

TEST_F(PaceOfAFile, ShowsNoInsideOfShortSteps) {
  for (int i = 1; i <= 45; ++i)
    EXPECT_FALSE(pace_.is_due(within(), begin_ + i * second / 10)) << i;
}

TEST_F(PaceOfAFile, ShowsEveryFailureAndTheEnd) {
  auto failed = within();
  failed.within = false;
  EXPECT_TRUE(pace_.is_due(failed, begin_));
  EXPECT_TRUE(pace_.is_due(failed, begin_ + second / 10));
  auto end = quarter("a");
  end.t = end.end;
  EXPECT_TRUE(pace_.is_due(end, begin_ + second / 5));
}

TEST(PlainLine, SaysEverythingWhateverItsLength) {
  EXPECT_EQ(plain_line(quarter("evol1"), 20),
            "evol1  25 % t = 0.01  h = 1.25e-05  iterations 12  in contact 1234  left 1:00 min");
}

TEST(DurationText, IsInSecondsMinutesAndHours) {
  EXPECT_EQ(duration_text(42.9), "42 s");
  EXPECT_EQ(duration_text(187), "3:07 min");
  EXPECT_EQ(duration_text(3723), "1:02:03 h");
}

TEST(LineOfRunsAtOnce, ShowsThePartsDoneTheTimesLeftAndHowManyAreToCome) {
  const std::vector<RunPart> runs{{"evol1", true, 0.25, 20}, {"evol2", false, 0, 0}};
  EXPECT_EQ(terminal_line(runs, 3, usual), "evol1 25 %  left 1:00 min | evol2 set-up | 3 to come");
  EXPECT_EQ(terminal_line(runs, 0, usual), "evol1 25 %  left 1:00 min | evol2 set-up");
}

TEST(LineOfRunsAtOnce, LosesTheTimesBeforeTheNamesAreCut) {
  const std::vector<RunPart> runs{{"evol1", true, 0.25, 20}, {"evolution", true, 0.5, 20}};
  EXPECT_EQ(terminal_line(runs, 0, 40), "evol1 25 % | evolution 50 %");
  EXPECT_EQ(terminal_line(runs, 0, 25), "evol1 25 % | evolut 50 %");
}

TEST(LineOfRunsAtOnce, NeverWraps) {
  const std::vector<RunPart> many(12, {"evolution", true, 0.5, 20});
  for (std::size_t columns = 0; columns < 200; ++columns)
    EXPECT_LE(terminal_line(many, 7, columns).size(), columns == 0 ? 0 : columns - 1);
}

} // namespace
} // namespace rubato::run::progress_text_test
