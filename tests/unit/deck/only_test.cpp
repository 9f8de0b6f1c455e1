// SPDX-License-Identifier: LGPL-3.0-or-later
// Some runs of a deck: what is read of it, and what settings change.
#include <gtest/gtest.h>

#include "sample_deck.hpp"
#include "support/two_blocks.hpp"
#include <string>
#include <vector>

namespace rubato::deck::only_test {
namespace {

using Words = std::vector<std::string>;

const std::string chain = test::two_blocks + R"(runs:
  preload: {time: {scheme: static, alpha: ~, step: 0.5, end: 1}}
  after: {time: {start: {from: preload}}}
  later: {time: {start: {from: after}, begin: 4e-4, end: 8e-4}}
  broken: {time: {stop: 3}, contact: ~}
)";

Deck only(const Words& names, const std::vector<Setting>& settings = {}) {
  return parse_deck(chain, "study.yaml", settings, names);
}

Words names_of(const Deck& deck) {
  Words names;
  for (const auto& study : deck.runs)
    names.push_back(study.name);
  return names;
}

std::string fault_of(const Words& names, const std::vector<Setting>& settings = {}) {
  try {
    only(names, settings);
  } catch (const InputError& error) {
    std::string all;
    for (const auto& fault : error.faults())
      all += to_string(fault.at) + ": " + fault.text + "\n";
    return all;
  }
  return "nothing thrown";
}

TEST(OnlySomeRuns, BringWhatTheyStartFromAndNothingElse) {
  EXPECT_EQ(names_of(only({"after"})), (Words{"preload", "after"}));
  EXPECT_EQ(names_of(only({"later"})), (Words{"preload", "after", "later"}));
  EXPECT_EQ(names_of(only({"preload"})), (Words{"preload"}));
  EXPECT_NE(fault_of({"broken"}).find("unknown"), std::string::npos) << fault_of({"broken"});
  EXPECT_EQ(fault_of({"rest"}), "--only: found 'rest', expected one of preload, after, later, broken\n");
}

TEST(OnlySomeRuns, AloneAreChangedBySettings) {
  const auto deck = only({"after"}, {{"time.step", "2e-4"}});
  EXPECT_EQ(deck.runs.at(0).time.step, 0.5);
  EXPECT_EQ(deck.runs.at(1).time.step, 2e-4);
  EXPECT_EQ(deck.notes, (Words{"preload: left as in the deck, as --set changes the runs of --only; '--only "
                               "preload,after' would change it, too"}));
  EXPECT_EQ(only({"later"}, {{"time.step", "2e-4"}}).notes.size(), 2U);
}

TEST(OnlySomeRuns, AreChangedWithWhatTheyStartFromWhenThatIsAskedForToo) {
  const auto deck = only({"after", "preload"}, {{"time.step", "2e-4"}});
  EXPECT_EQ(deck.runs.at(0).time.step, 2e-4);
  EXPECT_EQ(deck.runs.at(1).time.step, 2e-4);
  EXPECT_EQ(deck.notes, Words{});
}

TEST(OnlySomeRuns, HaveNoNotesWhereASettingWouldChangeNothing) {
  EXPECT_EQ(only({"after"}, {{"time.step", "0.5"}, {"time.end", "1"}}).notes, Words{});
  EXPECT_EQ(only({"after"}, {{"checks", "~"}}).notes, Words{});
  EXPECT_EQ(only({"after"}, {{"runs.after.time.step", "2e-4"}}).notes, Words{});
}

TEST(OnlySomeRuns, TakeSettingsOfOneRunWhereverItIs) {
  const auto deck = only({"after"}, {{"runs.preload.time.step", "0.25"}});
  EXPECT_EQ(deck.runs.at(0).time.step, 0.25);
  EXPECT_EQ(deck.notes, Words{});
}

TEST(OnlySomeRuns, ThatNoLongerFitWhatTheyStartFromAreRefusedWithTheWayOut) {
  const auto fault = fault_of({"after"}, {{"mesh.refine", "2"}});
  EXPECT_NE(
      fault.find("time.start.from: run preload has another mesh or physics than run after (run after)\n"),
      std::string::npos)
      << fault;
  EXPECT_NE(
      fault.find("--set: run after starts from run preload, which --only does not name and which so was "
                 "left as in the deck; expected '--only preload,after' to change both (run after)\n"),
      std::string::npos)
      << fault;
}

TEST(OnlySomeRuns, MayBeHeldAgainstOneThatIsNotRead) {
  const auto compared = test::two_blocks + R"(runs:
  rough: {}
  smooth: {checks: [{probe: end.y, at: 2e-4, run: rough, tolerance: 1}]}
  early: {checks: [{probe: end.y, at: 2e-4, run: late, tolerance: 1}]}
  late: {}
)";
  const std::vector<std::string> smooth{"smooth"};
  EXPECT_EQ(names_of(parse_deck(compared.substr(0, compared.find("  early")), "d.yaml", {}, smooth)), smooth);
  const std::vector<std::string> early{"early"};
  EXPECT_THROW(parse_deck(compared, "d.yaml", {}, early), InputError) << "the other one comes later";
}

} // namespace
} // namespace rubato::deck::only_test
