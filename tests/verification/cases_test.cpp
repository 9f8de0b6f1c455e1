// SPDX-License-Identifier: LGPL-3.0-or-later
/// The decks of cases/ run to their ends, from preloads where they ask for it, and their checks hold.
#include "rubato/deck/read.hpp"
#include "rubato/run/run_study.hpp"

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include <map>

namespace rubato::verification::cases_test {
namespace {

class Case : public testing::TestWithParam<const char*> {};

TEST_P(Case, RunsAndItsChecksHold) {
  const auto deck = deck::read_deck(std::string(RUBATO_SOURCE_DIR "/cases/") + GetParam());
  const test::ScratchFolder folder;
  std::map<std::string, run::RunResult> results;
  std::size_t checks = 0;
  for (const auto& study : deck.runs) {
    const auto from = results.find(study.time.start_run);
    const auto* previous = from == results.end() ? nullptr : &from->second.end;
    const auto& result = results[study.name] = run::run_study(study, folder / study.name, {}, previous);
    EXPECT_EQ(result.status, run::Status::complete) << study.name << ": " << result.message;
    EXPECT_LE(result.energy.largest_balance, 1e-10 * result.energy.largest) << study.name;
    EXPECT_TRUE(result.checks_hold()) << study.name << "\n" << results::to_text(result.checks);
    checks += result.checks.size();
  }
  EXPECT_GT(checks, 0u);
}

INSTANTIATE_TEST_SUITE_P(Verification, Case,
                         testing::Values("v1_bar_on_wall/bar.yaml", "v2_dropped_bar/bar.yaml",
                                         "v3_contact_patch/blocks.yaml", "v7_friction_slider/slider.yaml",
                                         "v8_hertz_impact/sphere.yaml", "v10_rod_on_rod/rods.yaml",
                                         "v11_free_beam/beam.yaml"),
                         [](const auto& instance) {
                           const std::string file = instance.param;
                           return file.substr(0, file.find('_'));
                         });

} // namespace
} // namespace rubato::verification::cases_test
