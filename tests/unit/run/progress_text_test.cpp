// SPDX-License-Identifier: LGPL-3.0-or-later
// The line that shows how far a run is.
#include "rubato/run/progress_text.hpp"

#include <gtest/gtest.h>

#include <string>

namespace rubato::run {
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
  EXPECT_EQ(line, "evol1 [#....] t = 0.01  h = 1.25e-05  iterations 12  in contact 1234  left 1:00 min");
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
  EXPECT_EQ(line, "evol1 [......] t = 1.25e-05  h = 1.25e-05 (failed, cut)  iterations 12  in contact 1234");
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

} // namespace
} // namespace rubato::run
