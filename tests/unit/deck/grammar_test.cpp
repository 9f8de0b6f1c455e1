// SPDX-License-Identifier: LGPL-3.0-or-later
// The declared forms of a deck's values: the reader is bound to them, and so is what no run reads.
#include "rubato/deck/grammar/parts.hpp"
#include "rubato/deck/schema.hpp"
#include "rubato/deck/values.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sample_deck.hpp"
#include <stdexcept>

namespace rubato::deck::grammar_test {
namespace {

using test::faults_of;
using test::Sentences;
using test::smallest_deck;

TEST(DeckGrammar, HasEveryKeyThatTheReaderLooksFor) {
  Tree tree;
  tree.kind = Tree::Kind::map;
  Faults faults;
  MapReader map(Value(tree, "time", faults, *grammar::forms_of(grammar::deck(), "time")));
  EXPECT_FALSE(map.find("step"));
  EXPECT_THROW(map.find("stride"), std::logic_error);
}

TEST(DeckGrammar, TakesTheWidestBoundsOfANumberThatSeveralRowsHave) {
  const auto* alpha = grammar::forms_of(*grammar::forms_of(grammar::deck(), "time"), "alpha");
  ASSERT_NE(alpha, nullptr);
  EXPECT_TRUE(alpha->front().range.contains(-7)); // modified_average_acceleration
  EXPECT_FALSE(alpha->front().range.contains(0.1));
}

/// Of the smallest deck with these lines, whose one run has those changes.
Sentences faults_of_replaced(const std::string& lines, const std::string& changes) {
  return faults_of(smallest_deck + lines + "runs: {a: {" + changes + "}}\n");
}

TEST(DeckGrammar, JudgesAValueThatEveryRunReplaces) {
  EXPECT_EQ(
      faults_of_replaced("newton: {residual: small}\n", "newton: {residual: 1e-9}"),
      (Sentences{"study.yaml:5:20: newton.residual: found 'small', expected a number between 0 and 1"}));
  EXPECT_EQ(
      faults_of_replaced("solver: fast\n", "solver: full"),
      (Sentences{"study.yaml:5:9: solver: found 'fast', expected one of auto, condensed, full, iterative"}));
  EXPECT_EQ(faults_of_replaced("supports: [{fix: [x]}]\n", "supports: []"),
            (Sentences{"study.yaml:5:12: supports.0: 'on' is missing"}));
  EXPECT_EQ(
      faults_of_replaced("contact: {a: {slave: S, master: M, integration: {gauss: 0}}}\n",
                         "contact: {a: {integration: nodes}}"),
      (Sentences{"study.yaml:5:57: contact.a.integration.gauss: found '0', expected a whole number from 1 "
                 "to 7"}));
}

TEST(DeckGrammar, LeavesToTheRunsWhatIsNotComplete) {
  EXPECT_EQ(faults_of_replaced("contact: {a: {slave: S}}\n", "contact: {a: {master: M}}"), Sentences{});
  EXPECT_EQ(faults_of_replaced("loads: []\nprobes: {}\n", "probes: {tip: {node: N1}}"), Sentences{});
}

TEST(DeckGrammar, TellsAFaultThatTheRunsMeetOnce) {
  EXPECT_EQ(faults_of(smallest_deck + "solver: fast\nruns: {a: {}, b: {}}\n").size(), 1U);
}

TEST(DeckSchema, HasKeysWordsAndBoundsOfTheTables) {
  const auto schema = nlohmann::json::parse(deck::schema());
  const auto& properties = schema["properties"];
  EXPECT_EQ(properties["physics"]["enum"][1], "plane_stress");
  EXPECT_EQ(properties["materials"]["additionalProperties"]["properties"]["poisson"]["anyOf"][0]
                      ["exclusiveMaximum"],
            0.5);
  EXPECT_EQ(properties["newton"]["properties"]["max_iterations"]["type"], "integer");
  EXPECT_EQ(schema["then"]["required"], (std::vector<std::string>{"physics", "mesh", "materials", "time"}));
}

TEST(DeckSchema, LetsRunsRemoveWhateverTheDeckHas) {
  const auto schema = nlohmann::json::parse(deck::schema());
  const auto& run = schema["properties"]["runs"]["additionalProperties"]["anyOf"];
  EXPECT_EQ(run[1]["type"], "null");
  EXPECT_EQ(run[0]["properties"]["thickness"]["anyOf"][1]["type"], "null");
}

} // namespace
} // namespace rubato::deck::grammar_test
