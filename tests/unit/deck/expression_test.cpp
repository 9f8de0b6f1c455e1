// SPDX-License-Identifier: LGPL-3.0-or-later
// Numbers of a deck that may be expressions of place and time.
#include "rubato/study/echo.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sample_deck.hpp"
#include <string>

namespace rubato::deck::expression_test {
namespace {

using study::Field;
using study::Formula;
using test::faults_of;
using test::parse_one;
using test::place_of;
using test::Sentences;
using test::smallest_deck;

const std::string varied = smallest_deck + R"deck(
functions: {f: {times: [0, 1], values: [0, 1]}}
supports: [{on: A, x: 1e-3*y, y: {value: "x^2", function: f}, z: -1e-3}]
loads:
  - {pressure: {on: B, value: "1e6*(1-z)", function: f}}
  - {surface_force: {on: B, x: 3, y: "t*x"}}
contact: {a: {master: M, slave: S, gap: "1e-4*(x-0.5)^2", interference: {value: "1e-5*t"}}}
)deck";

TEST(Expressions, AreReadWhereNumbersMayVary) {
  const auto study = parse_one(varied);
  const auto& support = study.supports.at(0).components;
  EXPECT_EQ(support[0], Field(Formula{"1e-3*y"}));
  EXPECT_EQ(support[1], Field(Formula{"x^2"}, "f"));
  EXPECT_EQ(support[2], Field(-1e-3));
  EXPECT_EQ(study.loads.at(0).components[0], Formula{"1e6*(1-z)"});
  EXPECT_EQ(study.loads.at(1).components[0], 3.0);
  EXPECT_EQ(study.loads.at(1).components[1], Formula{"t*x"});
  EXPECT_EQ(study.contact.at(0).gap, Field(Formula{"1e-4*(x-0.5)^2"}));
  EXPECT_EQ(study.contact.at(0).interference, Field(Formula{"1e-5*t"}));
}

TEST(Expressions, AreEchoedAsWritten) {
  const auto study = parse_one(varied);
  const auto json = nlohmann::json::parse(study::to_json(study));
  EXPECT_EQ(json["contact"]["a"]["gap"]["value"], "1e-4*(x-0.5)^2");
  EXPECT_EQ(json["supports"][0]["y"]["value"], "x^2");
  EXPECT_EQ(json["supports"][0]["y"]["function"], "f");
  EXPECT_EQ(json["loads"][1]["surface_force"]["y"], "t*x");
  EXPECT_EQ(json["loads"][1]["surface_force"]["x"], 3.0);
  EXPECT_EQ(parse_deck(study::to_json(study), "echo.json").runs.at(0), study);
}

TEST(Expressions, MayBeSetFromTheCommandLine) {
  const auto deck = parse_deck(varied, "a.yaml", std::vector{parse_setting("contact.a.gap=1e-3*x")});
  EXPECT_EQ(deck.runs.at(0).contact.at(0).gap, Field(Formula{"1e-3*x"}));
}

TEST(Expressions, AreRefusedAtTheirPlace) {
  const auto fault = [](const std::string& gap) {
    const auto deck = smallest_deck + "contact: {a: {master: M, slave: S, gap: " + gap + "}}\n";
    const auto faults = faults_of(deck);
    EXPECT_EQ(faults.size(), 1U) << gap;
    const auto at = place_of(deck, gap) + ": contact.a.gap: ";
    EXPECT_TRUE(!faults.empty() && faults[0].starts_with(at)) << gap;
    return faults.empty() ? std::string() : faults[0].substr(at.size());
  };
  const std::string expected = ", expected a number or an expression of x, y, z and t: ";
  EXPECT_EQ(fault("\"x = 3\""),
            "found 'x = 3'" + expected + "'=' at character 3 would assign, expected '==', which compares");
  EXPECT_EQ(fault("\"1/*x\""), "found '1/*x'" + expected + "'*' at character 3 is out of place");
  EXPECT_NE(fault("\"system('x')\"").find("unknown name 'system' at character 1"), std::string::npos);
  EXPECT_EQ(fault("[1, 2]"), "found a list, expected a number or an expression");
}

TEST(Expressions, AreNoNamesOfFunctions) {
  const auto deck = smallest_deck + "contact: {a: {master: M, slave: S, gap: f}}\n"
                                    "functions: {f: {times: [0, 1], values: [0, 1]}}\n";
  EXPECT_EQ(faults_of(deck), Sentences{place_of(deck, "f}}") +
                                       ": contact.a.gap: found 'f', a function of time, expected {value: 1, "
                                       "function: f}"});
}

} // namespace
} // namespace rubato::deck::expression_test
