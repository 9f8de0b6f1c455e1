// SPDX-License-Identifier: LGPL-3.0-or-later
// What is refused of surfaces, interferences, gaps, ties and points that are held.
#include <gtest/gtest.h>

#include "sample_deck.hpp"
#include <string>

namespace rubato::deck::contact_zone_test {
namespace {

using test::faults_of;
using test::faults_of_explicit;
using test::faults_of_zone;
using test::place_of;
using test::replaced;
using test::Sentences;
using test::smallest_deck;

Sentences faults_of_surfaces(const std::string& settings) {
  Sentences sentences;
  for (const auto& sentence : faults_of(smallest_deck + "contact: {a: {" + settings + "}}\n"))
    sentences.push_back(sentence.substr(sentence.find("contact")));
  return sentences;
}

TEST(ContactZoneFaults, MortarHasTheNormalsOfTheSlaveAndClampsNoProjection) {
  EXPECT_EQ(
      faults_of_surfaces("master: M, slave: S, integration: mortar, clamped_normal: code_aster"),
      Sentences{"contact.a.clamped_normal: found code_aster with the integration mortar, which clamps no "
                "projection, expected no 'clamped_normal'"});
}

TEST(ContactZoneFaults, ZonesHaveMasterAndSlaveOrOneKeyForBoth) {
  EXPECT_EQ(faults_of_surfaces("between: [M, S]"), Sentences());
  EXPECT_EQ(faults_of_surfaces("self: skin"), Sentences());
  EXPECT_EQ(faults_of_surfaces("all: true"), Sentences());
  EXPECT_EQ(faults_of_surfaces("self: skin, method: penalty, integration: nodes"), Sentences());
  EXPECT_EQ(faults_of_surfaces("between: [M]"),
            Sentences{"contact.a.between: found 1 name, expected two surfaces"});
  EXPECT_EQ(faults_of_surfaces("between: [M, S, T]"),
            Sentences{"contact.a.between: found 3 names, expected two surfaces"});
  EXPECT_EQ(faults_of_surfaces("between: [M, M]"), Sentences{"contact.a.between.1: found 'M' a second time"});
  EXPECT_EQ(faults_of_surfaces("self: skin, master: M"),
            Sentences{"contact.a.master: found 'master' beside 'self', which stands for both sides, expected "
                      "one of them"});
  EXPECT_EQ(
      faults_of_surfaces("all: true, slave: S"),
      Sentences{"contact.a.slave: found 'slave' beside 'all', which stands for both sides, expected one "
                "of them"});
  EXPECT_EQ(faults_of_surfaces("between: [M, S], obstacle: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}"),
            Sentences{"contact.a.obstacle: found 'obstacle' beside 'between', which stands for both sides, "
                      "expected one of them"});
  EXPECT_EQ(faults_of_surfaces("between: [M, S], self: skin"),
            Sentences{"contact.a.self: found both 'between' and 'self', expected one of them"});
  EXPECT_EQ(
      faults_of_surfaces("self: skin, tie: true"),
      Sentences{"contact.a.tie: found 'tie' with 'self': a surface is one with itself already, expected "
                "two surfaces, or no 'tie'"});
  EXPECT_EQ(faults_of_surfaces("self: skin, freeze: true"),
            Sentences{"contact.a.freeze: found 'freeze' with 'self', whose faces have to move to meet, "
                      "expected no 'freeze'"});
  EXPECT_EQ(faults_of_surfaces("self: skin, integration: nodes, normal: slave"),
            Sentences{"contact.a.normal: found slave with 'self', where the other side gives the normal, "
                      "expected no 'normal'"});
  EXPECT_EQ(faults_of_surfaces("all: false"),
            (Sentences{"contact.a: 'master' or 'obstacle' is missing", "contact.a: 'slave' is missing"}));
}

TEST(ContactZoneFaults, InterferencesAreOverlaps) {
  EXPECT_EQ(faults_of_zone("interference: 0.05, gap: -0.01"), Sentences{});
  EXPECT_EQ(
      faults_of_zone("interference: -0.05"),
      Sentences{"contact.a.interference: found -0.05, an interference is a positive overlap, expected gap: "
                "0.05, which sets surfaces apart"});
  EXPECT_EQ(faults_of_zone("gap: {value: 1, function: rampe}"),
            Sentences{"contact.a.gap.function: no function is called 'rampe'"});
  EXPECT_EQ(
      faults_of_zone(
          "interference: {value: 1, function: f}}}\nfunctions: {f: {times: [0, 1], values: [0, -1]"),
      Sentences{"contact.a.interference.function: found the function 'f', which becomes negative, expected "
                "one that is >= 0; 'gap' sets surfaces apart"});
  for (const std::string scheme : {"moreau_jean", "energy_momentum"}) {
    const auto jumping = replaced(smallest_deck, "newmark", scheme) +
                         "contact: {a: {master: M, slave: S, interference: 0.05}}\n";
    EXPECT_EQ(faults_of(jumping),
              Sentences{place_of(jumping, "0.05}}") +
                        ": contact.a.interference: found 0.05 at the first instant, but the scheme " +
                        scheme +
                        " leaves overlaps of the start as they are, expected a function that begins with 0"});
  }
  const auto fault = [](const std::string& words) {
    return faults_of_explicit("end: 1", "contact: {a: {master: M, slave: S, method: penalty, " + words +
                                            "}}\nfunctions: {f: {times: [0, 1], values: [0, 1]}}\n");
  };
  EXPECT_EQ(fault("gap: 0.1"), Sentences{});
  EXPECT_EQ(
      fault("interference: 0.1"),
      Sentences{"contact.a.interference: found an interference, which the scheme central_difference does "
                "not follow, expected an implicit scheme"});
  EXPECT_EQ(fault("gap: {value: 0.1, function: f}"),
            Sentences{"contact.a.gap: found a gap that changes, which the scheme central_difference does not "
                      "follow, expected an implicit scheme or a number or an expression without t"});
}

TEST(ContactZoneFaults, TiesHaveNothingOfSurfacesThatTouch) {
  EXPECT_EQ(faults_of_zone("tie: true"), Sentences{});
  EXPECT_EQ(faults_of_zone("tie: true, integration: nodes, exclude_nodes: N1"), Sentences{});
  EXPECT_EQ(
      faults_of_zone("tie: true, friction: 0.2"),
      Sentences{"contact.a.friction: found friction in a tie, expected none: surfaces that are tied do not "
                "slide"});
  EXPECT_EQ(
      faults_of_zone("tie: true, bilateral: true"),
      Sentences{"contact.a.bilateral: surfaces that are tied (tie: true) neither touch nor part nor slide"});
  EXPECT_EQ(faults_of_zone("tie: true, gap: 0.1"),
            Sentences{"contact.a.gap: surfaces that are tied (tie: true) neither touch nor part nor slide"});
  EXPECT_EQ(faults_of_zone("tie: true, method: penalty").size(), 1U);
  EXPECT_EQ(faults_of_zone("tie: true, integration: {gauss: 2}"),
            Sentences{"contact.a.integration: found gauss in a tie, expected mortar or nodes"});
  const auto glued = smallest_deck + "contact: {a: {master: S, slave: S, tie: true}}\n";
  EXPECT_EQ(faults_of(glued),
            Sentences{place_of(glued, "S, tie") +
                      ": contact.a.slave: found 'S' as slave and as master, expected two surfaces"});
  EXPECT_EQ(faults_of(smallest_deck +
                      "contact: {a: {slave: S, tie: true, obstacle: {sphere: {point: [0, 0, 0], "
                      "radius: 1}}}}\n")
                .size(),
            1U);
}

TEST(ContactZoneFaults, WhatHoldsPointsHasToGoTogether) {
  EXPECT_EQ(faults_of_zone("bilateral: true, freeze: true"), Sentences{});
  EXPECT_EQ(faults_of_zone("method: nodal_lagrange, freeze: true"), Sentences{});
  EXPECT_EQ(faults_of_zone("method: nodal_lagrange, nodal_pairs: true"), Sentences{});
  EXPECT_EQ(faults_of_zone("method: penalty, nodal_pairs: true"),
            Sentences{"contact.a.nodal_pairs: found nodal_pairs: true, which takes a master with nodes and a "
                      "nodal method, expected nodal_lagrange, nodal_penalty or nodal_pcg before a master"});
  EXPECT_EQ(
      faults_of_zone("method: nodal_pcg, bilateral: true"),
      Sentences{"contact.a.bilateral: found bilateral: true, but nodal_pcg knows of pushing forces only, "
                "expected nodal_lagrange"});
  EXPECT_EQ(
      faults_of_zone("freeze: true, iterate: {geometry: fixed_point}"),
      Sentences{"contact.a.iterate.geometry: found fixed_point beside freeze: true, which leaves no geometry "
                "to iterate, expected newton"});
  EXPECT_EQ(faults_of_zone("bilateral: maybe").size(), 1U);
  for (const char* key : {"bilateral", "freeze"})
    EXPECT_EQ(
        faults_of_explicit("end: 1", std::string("contact: {a: {master: M, slave: S, method: penalty, ") +
                                         key + ": true}}\n"),
        Sentences{std::string("contact.a.") + key + ": found " + key +
                  ": true, which the scheme central_difference does not have, expected an implicit "
                  "scheme"});
  EXPECT_EQ(faults_of_explicit("end: 1", "contact: {a: {master: M, slave: S, tie: true}}\n"), Sentences{});
}

} // namespace
} // namespace rubato::deck::contact_zone_test
