// SPDX-License-Identifier: LGPL-3.0-or-later
// Faults of probes in cuts, of differences and of chosen fields.
#include <gtest/gtest.h>

#include "unit/deck/sample_deck.hpp"

namespace rubato::deck::result_faults_test {
namespace {

using test::faults_of;
using test::smallest_deck;

/// Of a deck with these lines: without the place, which other tests look at.
std::string fault(const std::string& lines) {
  const auto sentences = faults_of(smallest_deck + lines);
  EXPECT_EQ(sentences.size(), 1U) << lines;
  const auto& first = sentences.empty() ? std::string() : sentences.front();
  return first.substr(first.find(": ") + 2);
}

std::string fault_of_probe(const std::string& probe) {
  return fault("probes: {tip: {node: N1}, fast: {node: N1, field: velocity}, far: {minus: [tip, tip]}, p: {" +
               probe + "}}\n");
}

TEST(FaultsOfDifferences, SayWhichProbesTheyTake) {
  EXPECT_EQ(fault_of_probe("minus: [tip, tp]"),
            "probes.p.minus: no probe is called 'tp'; did you mean 'tip'?");
  EXPECT_EQ(fault_of_probe("minus: [tip, far]"),
            "probes.p.minus: 'far' is a difference itself, expected probes that are none");
  EXPECT_EQ(fault_of_probe("minus: [tip, fast]"),
            "probes.p.minus: 'tip' is of displacement and 'fast' of velocity, expected two of one kind");
  EXPECT_EQ(fault_of_probe("minus: [tip]"),
            "probes.p.minus: found 1 probes, expected two: the first minus the second");
  EXPECT_EQ(fault_of_probe("minus: [tip, tip], node: N1"),
            "probes.p: found both 'node' and 'minus', expected one of them");
  EXPECT_EQ(fault_of_probe("minus: [tip, tip], field: stress"),
            "probes.p.field: goes with 'node', 'point' or 'on': sections and contact have forces, "
            "differences what their "
            "probes have");
}

TEST(FaultsOfSections, SayWhatACutNeeds) {
  EXPECT_EQ(fault_of_probe("section: {point: [0, 0, 0]}"), "probes.p.section: 'normal' is missing");
  EXPECT_EQ(fault_of_probe("section: {point: [0, 0, 0], normal: [0, 0, 0]}"),
            "probes.p.section.normal: found a vector of length 0, expected one that points somewhere");
  EXPECT_EQ(fault_of_probe("section: {point: [0, 0], normal: [0, 0, 1]}"),
            "probes.p.section.point: found 2 coordinates, expected 3");
  EXPECT_EQ(fault_of_probe("section: {point: [0, 0, 0], normal: [0, 0, 1], sells: all}"),
            "unknown key 'probes.p.section.sells'; did you mean 'cells'?");
}

TEST(FaultsOfChecks, OfSectionsNameTheirComponents) {
  EXPECT_EQ(fault("probes: {cut: {section: {point: [0, 0, 0], normal: [0, 0, 1]}}}\n"
                  "checks: [{probe: cut.m, at: 0.012, reference: 1, tolerance: 1}]\n"),
            "checks.0.probe: found the component 'm', expected x, y, z, mx, my, mz, normal or shear");
}

TEST(FaultsOfTables, SayWhatTheyList) {
  EXPECT_EQ(fault("fields: {tables: [{quantities: [U]}]}\n"),
            "fields.tables.0: expected one of the keys 'nodes', 'cells', 'faces' and 'zones'");
  EXPECT_EQ(fault("fields: {tables: [{nodes: all, cells: all, quantities: [U]}]}\n"),
            "fields.tables.0: expected one of the keys 'nodes', 'cells', 'faces' and 'zones'");
  EXPECT_EQ(fault("fields: {tables: [{nodes: all, quantities: [S]}]}\n"),
            "fields.tables.0.quantities: found 'S', expected for nodes some of: U, V, A, RF, NT, UR, RM");
  EXPECT_EQ(fault("fields: {tables: [{faces: all, quantities: [SOF]}]}\n"),
            "fields.tables.0.faces: found all faces, expected a group of faces");
  EXPECT_EQ(fault("fields: {tables: [{nodes: all, quantities: [U], every: -1}]}\n"),
            "fields.tables.0.every: found '-1', expected a whole number >= 0");
}

TEST(FaultsOfFields, NameTheNearestField) {
  EXPECT_EQ(fault("fields: {only: [displacment]}\n"),
            "fields.only.0: no field is called 'displacment'; did you mean 'displacement'?");
  EXPECT_EQ(fault("fields: {also: strain_elg}\n"),
            "fields.also: no field is called 'strain_elg'; did you mean 'strain_elga'?");
  EXPECT_EQ(fault("fields: {only: stress, also: strain}\n"),
            "fields.also: goes without 'only', which names all fields that are written");
  EXPECT_EQ(fault("fields: {only: contact_gap}\n"),
            "fields.only.0: found 'contact_gap', but the study has no contact");
  EXPECT_EQ(fault("fields: {digits: 20}\n"),
            "fields.digits: found '20', expected a whole number from 6 to 17");
}

} // namespace
} // namespace rubato::deck::result_faults_test
