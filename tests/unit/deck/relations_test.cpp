// SPDX-License-Identifier: LGPL-3.0-or-later
// What relations, oblique supports, connectors and masses are refused for, whatever the mesh.
#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

namespace rubato::deck::relations_test {
namespace {

struct BadPart {
  std::string part; ///< of the deck
  std::string told; ///< part of the sentence
};

std::ostream& operator<<(std::ostream& out, const BadPart& bad) {
  return out << bad.part;
}

std::string told_by(const std::string& more, const std::string& physics = "plane_strain",
                    const std::string& time = "{scheme: hht, alpha: -0.1, step: 1, end: 2}") {
  const auto deck = "mesh: {file: any.med}\nphysics: " + physics +
                    "\nmaterials: {any: {young: 1, poisson: 0, density: 1}}\ntime: " + time + "\n" + more;
  try {
    parse_deck(deck, "deck.yaml");
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

class BadRelation : public testing::TestWithParam<BadPart> {};

TEST_P(BadRelation, IsToldInOneSentence) {
  const auto told = told_by(GetParam().part);
  EXPECT_NE(told.find(GetParam().told), std::string::npos) << told;
  EXPECT_EQ(told.find('\n'), std::string::npos) << told;
}

INSTANTIATE_TEST_SUITE_P(
    Of, BadRelation,
    testing::Values(
        BadPart{"relations: {a: {equation: {terms: []}}}", "relations.a.equation.terms"},
        BadPart{"relations: {a: {equation: {terms: [{on: N1}]}}}",
                "has no coefficient, expected at least one of x, y, z"},
        BadPart{"relations: {a: {equation: {terms: [{on: N1, z: 1}]}}}", "plane_strain has no z"},
        BadPart{"relations: {a: {equal: {on: g, in: []}}}", "relations.a.equal.in"},
        BadPart{"relations: {a: {equal: {on: g, in: [x, x]}}}", "x is given a second time"},
        BadPart{"relations: {a: {pairs: {on: g, with: g}}}", "found 'g' on both sides, expected two groups"},
        BadPart{"relations: {a: {pairs: {on: g, with: h, in: x, difference: {y: 1}}}}",
                "found a difference along y, which 'in' leaves free"},
        BadPart{"relations: {a: {rigid: {on: g}, equal: {on: g}}}",
                "found 2 kinds of relation in one entry, expected one"},
        BadPart{"relations: {a: {rigd: {on: g}}}", "did you mean 'rigid'?"},
        BadPart{"supports: [{on: g, along: [0, 0]}]", "found a direction without length"},
        BadPart{"supports: [{on: g, value: 1, x: 0}]", "goes with 'along' only"},
        BadPart{"supports: [{on: g, along: norml}]", "did you mean 'normal'?"},
        BadPart{"supports: [{on: g, turn: {z: 0}}]", "expected a reference"},
        BadPart{"relations: {a: {rigid: {on: g}}}\nsupports: [{on: a, turn: {x: 0}}]",
                "plane_strain turns about z only"},
        BadPart{"loads: [{moment: {on: g, z: 1}}]", "expected a reference"},
        BadPart{"connectors: [{on: g, stiffness: 1}]", "'along' is missing"},
        BadPart{"connectors: [{on: g, along: [1, 0]}]",
                "has no force, expected a 'stiffness' or 'damping' above 0"},
        BadPart{"connectors: [{on: g, to: g, stiffness: 1}]", "found 'g' at both ends, expected two places"},
        BadPart{"connectors: [{on: g, along: [1, 0], stiffness: -1}]", "connectors.0.stiffness"},
        BadPart{"masses: [{on: g, mass: 0}]", "masses.0.mass"}));

TEST(Relations, AreForEverySchemeAndBodiesThatMayTurn) {
  const std::string explicitly = "{scheme: central_difference, end: 1, record: 0.1}";
  EXPECT_EQ(told_by("relations: {a: {equal: {on: g}}}", "plane_strain", explicitly), "nothing");
  EXPECT_EQ(told_by("supports: [{on: g, along: [1, 1]}]", "plane_strain", explicitly), "nothing");
  EXPECT_NE(told_by("relations: {a: {rigid: {on: g}}}", "axisymmetric").find("along its axis only"),
            std::string::npos);
  EXPECT_EQ(told_by("relations: {a: {equal: {on: g, in: y}}}", "axisymmetric"), "nothing");
}

} // namespace
} // namespace rubato::deck::relations_test
