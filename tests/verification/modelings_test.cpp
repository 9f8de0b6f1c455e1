// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the table of docs/verification is made of.
#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include "verification/modelings.hpp"

namespace rubato::verification::modelings_test {
namespace {

TEST(Modeling, RunsWhateverItsDeckHasAndItsChecksHold) {
  const test::ScratchFolder folder;
  const auto runs = run_modeling('f', folder.path());
  ASSERT_FALSE(runs.empty());
  EXPECT_EQ(runs.front().name, "evol1");
  for (const auto& run : runs) {
    ASSERT_TRUE(run.started()) << run.name << ": " << run.failure;
    EXPECT_EQ(run.result.status, run::Status::complete) << run.name << ": " << run.result.message;
    EXPECT_TRUE(run.result.checks_hold()) << run.name << "\n" << results::to_text(run.result.checks);
    EXPECT_TRUE(std::filesystem::exists(folder / "f" / run.name / "probes.csv"));
  }
  EXPECT_NEAR(runs.front().deflection(0.012).value(), published('f', "evol1", 0.012).value(), 1e-8);
}

TEST(Modeling, HasPublishedValuesOnlyWhereSomeWerePrinted) {
  EXPECT_EQ(published('a', "evol3", 0.001), -0.0181102921763);
  EXPECT_FALSE(published('b', "evol2", 0.001).has_value());
}

TEST(History, HasWholeStepsUpToItsFirstCut) {
  const auto until = [](std::vector<std::vector<double>> rows) {
    return last_whole_step({{"t"}, std::move(rows)}, 1e-3);
  };
  EXPECT_EQ(until({{0}, {0.001}, {0.0015}, {0.002}}), 0.001);
  EXPECT_EQ(until({{0}, {0.001}, {0.0020000000001}}), 0.0020000000001);
  EXPECT_EQ(until({{0}, {0.0005}}), 0);
}

} // namespace
} // namespace rubato::verification::modelings_test
