// SPDX-License-Identifier: LGPL-3.0-or-later
// What a study asks of a mesh that does not have it; the sentences are held in tests/cli.
#include "rubato/mesh/builder.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <gtest/gtest.h>

#include "studies.hpp"
#include "support/faults.hpp"

namespace rubato::model::faults_test {
namespace {

using test::fault_of;
using test::located_model;
using test::study_of;
using test::two_blocks;
using test::with;

std::vector<Fault> faults_of(const std::string& deck) {
  try {
    located_model(deck);
  } catch (const InputError& error) {
    return error.faults();
  }
  return {};
}

TEST(BadModel, IsToldEverythingAtOnceAndWhere) {
  auto deck = with(two_blocks, "cells: all", "cells: [upper, lowre]");
  deck = with(deck, "on: held,", "on: hold,");
  deck = with(deck, "{on: tip, y", "{on: top, y");
  deck = with(deck, "slave: lower_face", "slave: lower_fase");
  deck = with(deck, "node: tip", "node: held");
  const auto faults = faults_of(deck);
  std::vector<int> lines;
  for (const auto& fault : faults)
    lines.push_back(fault.at.line);
  EXPECT_EQ(lines, (std::vector<int>{16, 18, 20, 22, 25}));
}

const std::string& weightless_lower() {
  static const std::string deck =
      with(with(two_blocks, "density: 7800, cells: all", "density: 7800, cells: upper"),
           "supports:", "  die: {young: 200e9, poisson: 0.3, density: 0, cells: lower}\nsupports:");
  return deck;
}

TEST(Weightless, BodiesMustBeHeldWhole) {
  const auto fault = fault_of([] { located_model(weightless_lower()); });
  EXPECT_NE(fault.find("materials.die.density: found 0, but node N"), std::string::npos) << fault;
  EXPECT_NE(
      fault.find(" can move in x; expected more than 0, or supports that hold every node of its cells in "
                 "all components"),
      std::string::npos)
      << fault;
  const auto half = with(weightless_lower(), "  - {on: held, fix: [x, y]}",
                         "  - {on: held, fix: [x, y]}\n  - {on: lower, fix: x}");
  EXPECT_NE(fault_of([&] { located_model(half); }).find(" can move in y; "), std::string::npos);
}

TEST(BadProbe, OnManyNodesIsToldOfTake) {
  for (const auto* place : {"{node: roof}", "{on: roof}"}) {
    const auto fault = fault_of([&] { located_model(with(two_blocks, "{node: tip}", place)); });
    EXPECT_NE(
        fault.find("probe 'end': group 'roof' has 5 nodes, expected one, or what is taken of them: {on: "
                   "roof, take: sum}, mean, min or max"),
        std::string::npos)
        << fault;
  }
}

TEST(BadModel, NamesNoMoreThanTheFirstFewBadCells) {
  mesh::MeshBuilder builder(2);
  for (int i = 0; i < 4; ++i)
    builder.add_node(Eigen::Vector3d(i % 2, i / 2, 0));
  for (int i = 0; i < 15; ++i)
    builder.add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  try {
    build_model(study_of(with(two_blocks, "cells: all", "cells: all")), std::move(builder).build());
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().size(), 11U);
    EXPECT_EQ(error.faults().back().text, "and 5 more cells like these");
  }
}

TEST(BadModel, IsToldWhenSupportsContradictEachOther) {
  const auto faults = faults_of(with(two_blocks, "fix: [x, y]}", "fix: [x, y]}\n  - {on: held, x: 0.1}"));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].at.line, 19);
  EXPECT_NE(faults[0].text.find("two different displacements prescribed in x"), std::string::npos);
  EXPECT_TRUE(faults_of(with(two_blocks, "fix: [x, y]}", "fix: [x, y]}\n  - {on: held, x: 0}")).empty());
}

std::vector<Fault> faults_of_start(const std::string& entries) {
  return faults_of(with(two_blocks, "contact:\n", "initial:\n" + entries + "contact:\n"));
}

TEST(BadModel, IsToldWhenItBeginsOtherwiseThanItsSupports) {
  const auto faults = faults_of_start("  - {on: all, velocity: {x: 1, y: 0}}\n"
                                      "  - {on: held, displacement: {y: 0.5}}\n");
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].at.line, 22);
  EXPECT_EQ(faults[0].text, "node N1 (0, 0) begins with the velocity 1 in x, but its support moves at 0");
  EXPECT_EQ(faults[1].at.line, 23);
  EXPECT_NE(faults[1].text.find("begins with the displacement 0.5 in y, but its support puts it at 0"),
            std::string::npos);
}

TEST(BadModel, MayBeginWithTheVelocityOfASupportThatMoves) {
  auto deck = with(two_blocks, "  - {on: held, fix: [x, y]}",
                   "  - {on: held, fix: y, x: {value: 0.1, function: ramp}}");
  deck = with(deck, "contact:\n",
              "functions: {ramp: {times: [0, 1], values: [2, 3]}}\n"
              "initial: [{on: all, displacement: {x: 0.2}, velocity: {x: 0.1}}]\ncontact:\n");
  EXPECT_TRUE(faults_of(deck).empty());
  EXPECT_EQ(faults_of(with(deck, "velocity: {x: 0.1}", "velocity: {x: 0.2}")).size(), 1U);
}

TEST(BadModel, IsToldWhenTwoEntriesBeginDifferently) {
  EXPECT_TRUE(faults_of_start("  - {on: tip, velocity: {x: 1}}\n  - {on: tip, velocity: {x: 1}}\n").empty());
  const auto faults = faults_of_start("  - {on: tip, velocity: {x: 1}}\n  - {on: tip, velocity: {x: 2}}\n");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].text.find("begins with the velocity 2 in x, but another entry has 1"),
            std::string::npos);
}

TEST(BadModel, IsToldWhenSpringsOrMotionsAreOnNothing) {
  EXPECT_NE(faults_of_start("  - {on: tipp, velocity: {x: 1}}\n").at(0).text.find("did you mean 'tip'?"),
            std::string::npos);
  EXPECT_EQ(faults_of(with(two_blocks, "contact:\n", "springs: [{on: rof, x: 1}]\ncontact:\n")).size(), 1U);
}

TEST(BadModel, IsToldWhenGaussPointsAreTooFewForTheMultipliers) {
  const auto faults = faults_of(with(two_blocks, "integration: nodes", "integration: {gauss: 1}"));
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].text.find("found {gauss: 1}, expected at least 2"), std::string::npos);
}

TEST(BadModel, OfSeveralStudiesTellsCommonFaultsOnce) {
  const auto deck = deck::parse_deck(with(two_blocks, "on: held,", "on: hold,") +
                                         "runs:\n  a: {}\n  b: {probes: {end: {node: nowhere}}}\n",
                                     "deck.yaml");
  try {
    deck::throw_if_any(model::faults_of(deck.runs), deck.places);
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    ASSERT_EQ(error.faults().size(), 2U);
    EXPECT_EQ(error.faults()[0].at.line, 18);
    EXPECT_EQ(error.faults()[1].at.line, 28);
  }
}

TEST(BadModel, OfAMeshFileIsToldAtItsName) {
  const auto deck = "mesh: {file: /nowhere/none.med}\n" + two_blocks.substr(two_blocks.find("physics"));
  EXPECT_EQ(fault_of([&] { located_model(deck); }),
            "deck.yaml:1:14: mesh file '/nowhere/none.med' does not exist");
}

} // namespace
} // namespace rubato::model::faults_test
