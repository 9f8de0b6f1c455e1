// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/read.hpp"
#include "rubato/report/study_words.hpp"
#include "rubato/study/echo.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>

namespace rubato::report::study_words_test {
namespace {

constexpr auto deck = R"(
title: two blocks
mesh:
  generate:
    - {name: upper, rectangle: {from: [0, 0], to: [1, 0.1]}, divisions: [4, 2], sides: {left: wall, bottom: under}, points: {right_top: tip}}
    - {name: lower, rectangle: {from: [0, -0.1], to: [1, 0]}, divisions: [4, 2], sides: {left: wall, top: over}}
  refine: 3
physics: plane_strain
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: wall, fix: [x, y]}]
loads: [{nodal_force: {on: tip, y: -1e7, function: ramp}}]
contact: {joint: {master: under, slave: over, friction: 0.2, exclude_nodes: [wall]}}
time: {scheme: hht, alpha: -0.1, step: 0.25, end: 1}
)";

std::map<std::string, std::string> words_of(const std::string& text) {
  const auto study = deck::parse_deck(text, "deck.yaml").runs.at(0);
  std::map<std::string, std::string> words;
  for (const auto& topic : study_in_words(nlohmann::ordered_json::parse(study::to_json(study))))
    words[topic.name] = fmt::format("{}", fmt::join(topic.sentences, " | "));
  return words;
}

TEST(AStudyInWords, HasItsPartsWithTheirNumbers) {
  const auto words = words_of(deck);
  EXPECT_EQ(words.at("Physics"), "plane strain, thickness 1 | Units: SI");
  EXPECT_EQ(words.at("Mesh"),
            "Generated: upper, a rectangle from (0, 0) to (1, 0.1), 4 × 2 cells of quad4. | "
            "Generated: lower, a rectangle from (0, -0.1) to (1, 0), 4 × 2 cells of quad4. | "
            "Every edge is cut into 3 parts.");
  EXPECT_EQ(words.at("Materials"), "steel: elastic; young 2e+11, poisson 0.3, density 7800; on all cells");
  EXPECT_EQ(words.at("Supports"), "wall: x = 0, y = 0");
  EXPECT_EQ(words.at("Loads"), "nodal force on tip: y = -1e+07 × ramp(t)");
  EXPECT_EQ(words.at("Time"), "Scheme: hht; alpha -0.1. | From t = 0 to 1, step 0.25.");
  const auto contact = words.at("Contact joint");
  EXPECT_TRUE(contact.starts_with(
      "slave over, master under. | Method: augmented lagrangian. | Coulomb friction, coefficient 0.2"))
      << contact;
  EXPECT_EQ(words.count("Springs"), 0U);
  EXPECT_EQ(words.count("Motion at the start"), 0U);
}

TEST(AStudyInWords, SaysMovingSupportsAndFrictionlessContact) {
  auto text = std::string(deck);
  const auto change = [&](const std::string& word, const std::string& other) {
    text.replace(text.find(word), word.size(), other);
  };
  change("fix: [x, y]", "x: 0, y: {value: -0.5, function: ramp}");
  change("friction: 0.2, ", "");
  const auto words = words_of(text);
  EXPECT_EQ(words.at("Supports"), "wall: x = 0, y = -0.5 × ramp(t)");
  EXPECT_NE(words.at("Contact joint").find("No friction."), std::string::npos);
}

TEST(AStudyInWords, SaysRelationsConnectorsAndMasses) {
  const auto words =
      words_of(std::string(deck) +
               "\nrelations: {hub: {rigid: {on: over}}, l: {equation: {terms: [{on: tip, x: 1, y: -2}], "
               "value: 0.1}}}\nconnectors: [{on: hub, along: [0, 1], stiffness: 5}]\nmasses: [{on: "
               "tip, mass: 2}]\n");
  EXPECT_EQ(words.at("Relations"), "hub, rigid: on over | l, equation: terms (on tip, x 1, y -2), value 0.1");
  EXPECT_EQ(words.at("Connectors"), "hub: along = (0, 1), stiffness = 5, damping = 0");
  EXPECT_EQ(words.at("Masses"), "tip: mass = 2");
}

TEST(AStudyInWords, SaysTheMotionOfTheBaseAndVelocitiesOfSupports) {
  auto text = std::string(deck);
  const std::string fixed = "fix: [x, y]";
  text.replace(text.find(fixed), fixed.size(), "x: 0, y: {velocity: -0.5, function: ramp}, until: 5e-4");
  const auto words = words_of(text + "\nbase_motion: {x: {acceleration: -1, function: ramp}}\n");
  EXPECT_EQ(words.at("Supports"), "wall: x = 0, y = velocity -0.5, function ramp, until = 0.0005");
  EXPECT_EQ(words.at("Base motion"),
            "x = acceleration -1, function ramp; displacements are those relative to the base");
}

} // namespace
} // namespace rubato::report::study_words_test
