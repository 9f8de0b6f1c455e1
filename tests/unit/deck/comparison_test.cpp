// SPDX-License-Identifier: LGPL-3.0-or-later
// Checks against another run of the deck.
#include <gtest/gtest.h>

#include "sample_deck.hpp"

namespace rubato::deck::comparison_test {
namespace {

using test::faults_of;
using test::Sentences;
using test::smallest_deck;

/// Two runs; the check stands in the second one.
std::string deck_with(const std::string& check, const std::string& first = "{}",
                      const std::string& second = "") {
  return smallest_deck + "probes: {tip: {node: N1}}\nruns:\n  evol1: " + first + "\n  evol2: {" + second +
         "checks: [" + check + "]}\n";
}

/// The one fault of such a deck, without its place.
std::string fault_of(const std::string& check, const std::string& first = "{}",
                     const std::string& second = "") {
  const auto faults = faults_of(deck_with(check, first, second));
  if (faults.size() != 1)
    return std::to_string(faults.size()) + " faults" + (faults.empty() ? "" : ": " + faults[0] + faults[1]);
  return faults.front().substr(faults.front().find(": ") + 2);
}

const std::string probe = "{probe: tip.y, at: 0.001, tolerance: 0.1";
const std::string field = "{field: displacement.y, at: 0.001, tolerance: 0.1, run: evol1";
const std::string stored = "{fields: {formats: [med], at: [0.001]}}";
const std::string also_stored = "fields: {formats: [vtu, med], every: 1}, ";

TEST(Comparison, WithAnotherRunNeedsNoReference) {
  const auto deck = test::parse(deck_with(probe + ", run: evol1}"));
  const auto& check = deck.runs.at(1).checks.at(0);
  EXPECT_EQ(check.run, "evol1");
  EXPECT_EQ(check.source, study::CheckSource::other_run);
  EXPECT_EQ(check.reference, 0);
  EXPECT_TRUE(check.relative);
  EXPECT_EQ(faults_of(deck_with(probe + ", run: evol1, source: other_run, kind: absolute}")), Sentences{});
  EXPECT_EQ(faults_of(deck_with(field + "}", stored, also_stored)), Sentences{});
}

TEST(Comparison, IsWithOneOfTheEarlierRuns) {
  EXPECT_EQ(fault_of(probe + ", run: evl1}"),
            "checks.0.run: no run is called 'evl1'; did you mean 'evol1'? (run evol2)");
  EXPECT_EQ(fault_of(probe + ", run: evol2}"),
            "checks.0.run: run evol2 cannot be compared with itself (run evol2)");
  const auto later = smallest_deck + "probes: {tip: {node: N1}}\nruns:\n  evol1: {checks: [" + probe +
                     ", run: evol2}]}\n  evol2: {}\n";
  EXPECT_EQ(faults_of(later), (Sentences{test::place_of(later, "evol2}]") +
                                         ": checks.0.run: run evol2 comes later than run evol1, expected an "
                                         "earlier one (run evol1)"}));
}

TEST(Comparison, AndItsSourceMeanEachOther) {
  EXPECT_EQ(fault_of(probe + ", source: other_run}"),
            "checks.0.source: found 'other_run', but 'run', which names it, is missing (run evol2)");
  EXPECT_EQ(fault_of(probe + ", run: evol1, source: analytic}"),
            "checks.0.source: found 'analytic' beside 'run', expected 'other_run' (run evol2)");
  EXPECT_EQ(fault_of(probe + ", run: evol1, reference: 1}"),
            "checks.0.reference: goes without 'run': the difference from another run is held against 0 (run "
            "evol2)");
  EXPECT_EQ(fault_of("{field: displacement, at: 0.001, tolerance: 1}", stored, also_stored),
            "checks.0: 'run' is missing: a field is compared with that of another run (run evol2)");
}

TEST(Comparison, IsOfAProbeOrOfAField) {
  EXPECT_EQ(fault_of("{at: 0.001, tolerance: 1, run: evol1}"),
            "checks.0: 'probe', 'energy', 'resultant' or 'field' is missing (run evol2)");
  EXPECT_EQ(fault_of(field + ", probe: tip.y}", stored, also_stored),
            "checks.0: found several of 'probe', 'energy', 'resultant' and 'field', expected one of them "
            "(run evol2)");
  EXPECT_EQ(fault_of(probe + ", run: evol1, on: N1}"),
            "checks.0.on: goes with 'field' only: a probe has its node already (run evol2)");
}

TEST(Comparison, NamesAFieldAndAComponentThatRunsStore) {
  const auto named = [](const std::string& name) {
    return fault_of("{field: " + name + ", at: 0.001, tolerance: 1, run: evol1}", stored, also_stored);
  };
  EXPECT_EQ(named("displacment.y"),
            "checks.0.field: no field is called 'displacment'; did you mean 'displacement'? (run evol2)");
  EXPECT_EQ(named("stress.yx"),
            "checks.0.field: found the component 'yx' of stress; did you mean 'xx'? (run evol2)");
  EXPECT_EQ(named("von_mises.x"),
            "checks.0.field: found the component 'x', but von_mises has none (run evol2)");
}

TEST(Comparison, OfFieldsNeedsThemAmongThoseThatAreWritten) {
  EXPECT_EQ(fault_of("{field: strain.xy, at: 0.001, tolerance: 1, run: evol1}",
                     "{fields: {formats: [med], at: [0.001], also: [stress_elga]}}",
                     "fields: {formats: [med], at: [0.001], only: [strain]}, "),
            "checks.0.run: run evol1 does not write strain, expected it among the fields of 'only' or 'also' "
            "(run evol2)");
}

TEST(Comparison, OfFieldsNeedsThemStoredInBothRuns) {
  const std::string wanted =
      " stores no fields at 0.001 that can be read back, expected 'fields: {formats: [med], "
      "at: [0.001]}' in both runs (run evol2)";
  EXPECT_EQ(fault_of(field + "}", stored), "checks.0.run: run evol2" + wanted);
  EXPECT_EQ(fault_of(field + "}", "{fields: {at: [0.001]}}", also_stored),
            "checks.0.run: run evol1" + wanted);
  EXPECT_EQ(fault_of(field + "}", "{fields: {formats: [med], at: [0.002]}}", also_stored),
            "checks.0.run: run evol1" + wanted);
  EXPECT_EQ(faults_of(deck_with("{field: velocity, at: 0.012, tolerance: 1, run: evol1}",
                                "{fields: {formats: [med]}}", also_stored)),
            Sentences{})
      << "the last instant is stored anyway";
}

TEST(Comparison, OfFieldsIsOnOneMesh) {
  EXPECT_EQ(fault_of(field + "}", "{mesh: {refine: 2}, fields: {formats: [med], at: [0.001]}}", also_stored),
            "checks.0.run: run evol1 has another mesh or physics than run evol2: fields are compared node by "
            "node, probes of the same name can be (run evol2)");
  EXPECT_EQ(faults_of(deck_with(probe + ", run: evol1}", "{mesh: {refine: 2}}")), Sentences{});
}

TEST(Comparison, OfAProbeNeedsTheSameOneInBothRuns) {
  EXPECT_EQ(fault_of(probe + ", run: evol1}", "{probes: ~}"),
            "checks.0.run: run evol1 has no probe 'tip' (run evol2)");
  EXPECT_EQ(
      fault_of(probe + ", run: evol1}", "{probes: {tip: {field: velocity}}}"),
      "checks.0.run: probe 'tip' is of velocity in run evol1 and of displacement in run evol2 (run evol2)");
  EXPECT_EQ(fault_of(probe + ", run: evol1}", "{time: {step: 1e-4, end: 5e-4}}"),
            "checks.0.run: run evol1 goes from 0 to 0.0005, expected one that comes by 0.001 (run evol2)");
}

} // namespace
} // namespace rubato::deck::comparison_test
