// SPDX-License-Identifier: LGPL-3.0-or-later
// Which cells are told to be too stiff for their material or their part, and what to write instead.
#include "rubato/model/formulation_notes.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include <algorithm>
#include <string>

namespace rubato::model::formulation_notes_test {
namespace {

struct Part {
  std::string material = "young: 1, poisson: 0.3, density: 1";
  std::string cells = "quad4";
  std::string physics = "plane_strain";
  std::string to = "[1, 1]";
  std::string divisions = "[4, 4]";
};

std::string deck_of(const Part& part) {
  return fmt::format(
      R"(mesh: {{generate: [{{name: part, rectangle: {{from: [0, 0], to: {}}}, divisions: {}, cells: {}, sides: {{left: left}}}}]}}
physics: {}
materials: {{any: {{{}}}}}
supports: [{{on: left, fix: [x, y]}}]
time: {{scheme: newmark, step: 1, end: 1}}
)",
      part.to, part.divisions, part.cells, part.physics, part.material);
}

std::string notes_of(const Part& part) {
  std::string all;
  for (const auto& note : examine_formulations(test::model_of(deck_of(part))).notes)
    all += note + "\n";
  return all;
}

bool says(const Part& part, const std::string& what) {
  const auto notes = notes_of(part);
  EXPECT_NE(notes.find(what), std::string::npos) << notes;
  return notes.find(what) != std::string::npos;
}

constexpr auto incompressible = "young: 1, poisson: 0.49, density: 1";
constexpr auto yielding =
    "law: plastic, young: 1, poisson: 0.3, density: 1, hardening: {linear: {yield_stress: 1, modulus: 1}}";

TEST(NotesOnFormulations, TellOfCellsThatKeepTheirVolume) {
  EXPECT_TRUE(says({.material = incompressible}, "its QUAD4 cells are too stiff, as Poisson's ratio 0.49"));
  EXPECT_TRUE(says({.material = incompressible}, "'formulation: mean_dilatation' cures it"));
  EXPECT_TRUE(says({.material = incompressible, .cells = "tria3"},
                   "'mesh: {convert: quadratic}' with 'formulation: mean_dilatation' cures it"));
  EXPECT_TRUE(says({.material = std::string(yielding) + ", formulation: full"}, "as plastic flow"));
  EXPECT_TRUE(says({.material = yielding, .cells = "tria3"}, "as plastic flow"));
  EXPECT_TRUE(says({.material = "law: hyperelastic, c10: 1, bulk: 100, density: 1", .cells = "tria3"},
                   "Poisson's ratio 0.49"));
}

TEST(NotesOnFormulations, TellOfQuadraticCellsWhosePressuresAlternate) {
  constexpr auto rubber = "law: hyperelastic, c10: 1, bulk: 1000, density: 1";
  const auto full = std::string(rubber) + ", formulation: full";
  for (const auto* cells : {"quad8", "quad9", "tria6"}) {
    EXPECT_TRUE(
        says({.material = full, .cells = cells}, "cells have pressures that alternate, as Poisson's"));
    EXPECT_TRUE(says({.material = full, .cells = cells}, "'formulation: mean_dilatation' cures it"));
    EXPECT_EQ(notes_of({.material = rubber, .cells = cells}), "");
  }
  EXPECT_TRUE(says({.material = "young: 1, poisson: 0.499, density: 1", .cells = "quad8"}, "alternate"));
  EXPECT_TRUE(says({.material = rubber, .cells = "tria3"}, "; 'mesh: {convert: quadratic}' cures it"));
}

TEST(NotesOnFormulations, AreSilentWhereCellsDoNotLock) {
  EXPECT_EQ(notes_of({}), "");
  EXPECT_EQ(notes_of({.material = incompressible, .cells = "quad8"}), "");
  EXPECT_EQ(notes_of({.material = incompressible, .physics = "plane_stress"}), "");
  EXPECT_EQ(notes_of({.material = yielding}), "") << "mean dilatation by default";
  EXPECT_EQ(notes_of({.material = std::string(incompressible) + ", formulation: mean_dilatation"}), "");
}

TEST(NotesOnFormulations, TellOfFewLayersInBending) {
  const Part slender{.to = "[20, 1]", .divisions = "[20, 2]"};
  EXPECT_TRUE(
      says(slender, "2 layers of QUAD4 across a part 20 times as long as thick are too stiff in bending"));
  EXPECT_TRUE(says(slender, "'formulation: enhanced'"));
  EXPECT_EQ(notes_of({.to = "[20, 1]", .divisions = "[20, 4]"}), "");
  EXPECT_EQ(notes_of({.to = "[3, 1]", .divisions = "[6, 2]"}), "") << "not slender";
  EXPECT_EQ(notes_of({.cells = "quad8", .to = "[20, 1]", .divisions = "[20, 1]"}), "");
  EXPECT_EQ(notes_of({.material = "young: 1, poisson: 0.3, density: 1, formulation: enhanced",
                      .to = "[20, 1]",
                      .divisions = "[20, 2]"}),
            "");
}

TEST(Formulations, ThatNoCellHasAreRefused) {
  const Part triangles{.material = "young: 1, poisson: 0.3, density: 1, formulation: enhanced",
                       .cells = "tria3"};
  const auto fault = test::fault_of([&] { test::model_of(deck_of(triangles)); });
  EXPECT_NE(fault.find("its TRIA3 cells have no enhanced, QUAD4 and HEXA8 have; expected full"),
            std::string::npos)
      << fault;
}

std::string refusal_of(const std::string& material, const std::string& type, const std::string& more = "") {
  auto deck = deck_of({.material = material + ", formulation: reduced", .cells = type}) + more;
  return test::fault_of([&] { test::model_of(deck); });
}

TEST(ReducedCells, OfOnePointAreRefusedWhereTheyCannotBeHad) {
  EXPECT_NE(
      refusal_of(yielding, "quad4")
          .find("materials.any.formulation: the scheme newmark takes reduced QUAD4 and HEXA8 of materials "
                "that do not yield only, expected mean_dilatation"),
      std::string::npos);
  EXPECT_EQ(refusal_of(yielding, "quad8"), "nothing thrown");
  const std::string warm = "young: 1, poisson: 0.3, density: 1, expansion: 1e-5, reference_temperature: 0";
  const std::string temperature = "temperature: [{on: all, value: 1}]\n";
  EXPECT_NE(refusal_of(warm, "quad4", temperature)
                .find("found thermal expansion of reduced QUAD4 and HEXA8, which follow no temperature"),
            std::string::npos);
  EXPECT_EQ(refusal_of(warm, "quad8", temperature), "nothing thrown");
  EXPECT_NE(refusal_of("young: 1, poisson: 0.3, density: 1", "tria6")
                .find("its TRIA6 cells have no reduced, QUAD4, QUAD8, HEXA8, HEXA20, PENTA6 and PENTA15 "
                      "have; expected full"),
            std::string::npos);
}

std::string reduced_solids(const std::string& divisions, const std::string& supports) {
  return fmt::format(
      R"(mesh: {{generate: [{{name: part, box: {{from: [0, 0, 0], to: [1, 1, 4]}}, divisions: {}, cells: hexa20, sides: {{back: foot, left: left, front: top, bottom: low}}}}]}}
physics: solid
materials: {{any: {{young: 1, poisson: 0.3, formulation: reduced}}}}
supports: [{}]
time: {{scheme: static, step: 1, end: 1}}
)",
      divisions, supports);
}

TEST(ReducedCells, ThatCanDeformWithoutStressAreTold) {
  const auto notes = [](const std::string& deck) {
    std::string all;
    for (const auto& note : examine_formulations(test::model_of(deck)).notes)
      all += note + "\n";
    return all;
  };
  const std::string held = "{on: foot, fix: [x, y, z]}";
  const auto told = notes(reduced_solids("[1, 1, 4]", held));
  EXPECT_NE(told.find("material 'any': 4 reduced cells, the first cell "), std::string::npos) << told;
  EXPECT_NE(told.find("have no neighbours in two directions and can deform without stress"),
            std::string::npos)
      << told;
  EXPECT_EQ(notes(reduced_solids("[2, 1, 4]", held)), "");
  EXPECT_EQ(notes(reduced_solids("[1, 1, 4]", held + ", {on: left, fix: [x]}")), "");
  const std::string reduced = "young: 1, poisson: 0.3, density: 1, formulation: reduced";
  EXPECT_EQ(notes_of({.material = reduced, .cells = "quad8", .divisions = "[2, 1]"}), "");
}

} // namespace
} // namespace rubato::model::formulation_notes_test
