// SPDX-License-Identifier: LGPL-3.0-or-later
// Decks that ask for what cannot be: exit code 2, one sentence each at its place, and nothing is written.
#include <gtest/gtest.h>

#include "program.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <ostream>

namespace rubato::bad_input_test {
namespace {

using test::two_blocks;
using test::with;

/// The sound deck with one thing changed, and what is said to that.
struct Fault {
  std::string name;
  std::string old;
  std::string replacement;
  std::string sentence;
};

void PrintTo(const Fault& fault, std::ostream* out) {
  *out << fault.name;
}

class BadDeck : public testing::TestWithParam<Fault> {};

TEST_P(BadDeck, IsRefusedWithOneSentenceAndLeavesNothing) {
  const test::ScratchFolder folder;
  const auto& fault = GetParam();
  test::write_text(folder / "deck.yaml", with(two_blocks, fault.old, fault.replacement));
  const auto outcome = test::run_program({"run", "deck.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "error: deck.yaml:" + fault.sentence + "\n");
  EXPECT_EQ(outcome.out, "");
  EXPECT_FALSE(std::filesystem::exists(folder / "deck"));
}

INSTANTIATE_TEST_SUITE_P(
    Of, BadDeck,
    testing::Values(
        Fault{
            "AssigningExpression", "y: -1e7", "y: x = 1",
            "20:31: loads.0.nodal_force.y: found 'x = 1', expected a number or an expression of x, y, z and "
            "t: '=' at character 3 would assign, expected '==', which compares"},
        Fault{
            "CallingExpression", "y: -1e7", "y: tann('x')",
            "20:31: loads.0.nodal_force.y: found 'tann('x')', expected a number or an expression of x, y, z "
            "and t: unknown name 'tann' at character 1; did you mean 'tan'?"},
        Fault{"InfiniteExpression", "y: -1e7", "y: 1/(x-1)",
              "20:31: loads.0.nodal_force.y: '1/(x-1)' is infinite at x = 1, y = 0.2, z = 0, t = 0, expected "
              "a finite number"},
        Fault{"UnknownKey", "thickness: 1", "thicknes: 1",
              "14:1: unknown key 'thicknes'; did you mean 'thickness'?"},
        Fault{"WrongType", "step: 1e-4", "step: soon",
              "23:40: time.step: found 'soon', expected a number > 0"},
        Fault{"NegativeStep", "step: 1e-4", "step: -1e-4",
              "23:40: time.step: found '-0.0001', expected a number > 0"},
        Fault{"NegativeThickness", "thickness: 1", "thickness: -1",
              "14:12: thickness: found '-1', expected a number > 0"},
        Fault{"MissingGroup", "on: held,", "on: hold,",
              "18:10: found 'hold', expected a group or a node ('N90') of the mesh; did you mean 'held'?"},
        Fault{"MissingMaterialGroup", "cells: all", "cells: [upper, lowe]",
              "16:69: found 'lowe', expected a group of cells of the mesh; did you mean 'lower'?"},
        Fault{"MaterialOnEdges", "cells: all", "cells: held",
              "16:61: group 'held' holds SEG2 cells, expected surface cells for material 'steel'"},
        Fault{"MaterialWithoutCells", "cells: all}",
              "cells: [upper, lower]}\n  rubber: {young: 1e6, poisson: 0.4, density: 1000, cells: []}",
              "17:60: materials.rubber.cells: found an empty list, expected 'all' or groups of cells"},
        Fault{"CellsWithoutMaterial", "cells: all", "cells: upper",
              "16:3: 8 of 16 cells have no material, the first one is cell 25 (QUAD4); expected one for "
              "every cell (`cells: all`, or a group)"},
        Fault{"NoDensity", "density: 7800, ", "",
              "16:3: materials.steel: 'density' is missing: the scheme hht moves masses"},
        Fault{"MasterIsSlave", "slave: lower_face", "slave: upper_face",
              "22:42: contact.interface.slave: found 'upper_face' as slave and as master, expected two "
              "surfaces, or 'self' for one that touches itself"},
        Fault{"NeitherMasterNorObstacle", "master: upper_face, ", "",
              "22:3: contact.interface: 'master' or 'obstacle' is missing"},
        Fault{"ObstacleWithoutDirection", "master: upper_face",
              "obstacle: {plane: {point: [0, 0], normal: [0, 0]}}",
              "22:57: contact.interface.obstacle.plane.normal: found a vector of length 0, expected one that "
              "points somewhere"},
        Fault{"UnknownObstacle", "master: upper_face", "obstacle: {cylindre: {point: [0, 0], radius: 1}}",
              "22:26: unknown key 'contact.interface.obstacle.cylindre'; did you mean 'cylinder'?"},
        Fault{"ContactOnBodies", "master: upper_face", "master: upper",
              "22:23: contact surface 'upper': 8 cells (the first: number 17 of QUAD4) found where segments "
              "are expected"},
        Fault{"ContactOnNodes", "master: upper_face", "master: tip",
              "22:23: group 'tip' holds nodes, expected a group of cells"},
        Fault{"ProbeWithoutNode", "node: tip", "node: tp",
              "25:15: found 'tp', expected a group or a node ('N90') of the mesh; did you mean 'tip'?"},
        Fault{"ProbeOnManyNodes", "node: tip", "node: held",
              "25:15: probe 'end': group 'held' has 6 nodes, expected one, or what is taken of them: {on: "
              "held, take: "
              "sum}, mean, min or max"},
        Fault{"LoadOnBodies", "nodal_force: {on: tip, y: -1e7}", "pressure: {on: upper, value: 1e6}",
              "20:20: loaded surface 'upper': 8 cells (the first: number 17 of QUAD4) found where segments "
              "are expected"}),
    [](const auto& fault) { return fault.param.name; });

TEST(BadDecks, AreToldWhichBodyAStaticRunDoesNotHold) {
  const test::ScratchFolder folder;
  auto deck = with(two_blocks, "top: lower_face", "bottom: ground, top: lower_face");
  deck = with(deck, "on: held, fix", "on: ground, fix");
  deck = with(deck, "friction: 0.2", "friction: 0");
  test::write_text(folder / "deck.yaml", with(deck, "hht, alpha: -0.1,", "static,"));
  const auto outcome = test::run_program({"run", "deck.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(
      outcome.err,
      "error: deck.yaml:23:7: the body 'upper' (of node N1 (0, 0)) is not held: it can move as a rigid body "
      "along x, and a static run has no inertia; expected supports, springs, or contact with something "
      "that is held (frictionless contact holds across the surface only)\n");
}

TEST(BadDecks, AreToldAllTheirFaultsAtOnce) {
  const test::ScratchFolder folder;
  auto deck = with(two_blocks, "on: held,", "on: hold,");
  deck = with(deck, "{on: tip, y", "{on: top, y");
  deck = with(deck, "slave: lower_face", "slave: lower_fase");
  deck = with(deck, "node: tip", "node: N999");
  test::write_text(folder / "deck.yaml", deck);
  const auto outcome = test::run_program({"run", "deck.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 4) << outcome.err;
}

TEST(BadDecks, AreRefusedBeforeTheirFirstRun) {
  const test::ScratchFolder folder;
  test::write_text(folder / "deck.yaml",
                   two_blocks + "runs:\n  good: {}\n  bad: {probes: {end: {node: nowhere}}}\n");
  const auto outcome = test::run_program({"run", "deck.yaml"}, folder.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(outcome.err.starts_with("error: deck.yaml:28:")) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "deck"));
}

TEST(BadDecks, WhoseExpressionEndsInAStepKeepTheStepsBefore) {
  const test::ScratchFolder folder;
  test::write_text(folder / "deck.yaml",
                   with(two_blocks, "y: -1e7", "y: \"if(abs(t-3e-4) < 1e-6, 1/0, -1e7)\""));
  const auto outcome = test::run_program({"run", "deck.yaml", "-q"}, folder.path());
  const std::string told = "loads.0.nodal_force.y: 'if(abs(t-3e-4) < 1e-6, 1/0, -1e7)' is infinite at x = 1, "
                           "y = 0.2, z = 0, t = 0.0003, expected a finite number";
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err, "error: deck.yaml:20:31: " + told + "\n");
  const auto summary = test::text_of(folder / "deck/run/run.json");
  EXPECT_NE(summary.find("\"status\": \"interrupted\""), std::string::npos);
  EXPECT_NE(summary.find(told + "; the last whole step ends at t = 0.0002"), std::string::npos);
}

TEST(BadDecks, AreRefusedWhenTheOutputCannotBeMade) {
  const test::ScratchFolder folder;
  test::write_text(folder / "deck.yaml", two_blocks);
  test::write_text(folder / "taken", "");
  const auto fault_for = [&](const std::string& output) {
    const auto outcome = test::run_program({"run", "deck.yaml", "-q", "-o", output}, folder.path());
    EXPECT_EQ(outcome.exit_code, 2);
    return outcome.err;
  };
  EXPECT_EQ(fault_for("taken"), "error: taken/run: the folder of results cannot be made (Not a directory)\n");
  EXPECT_EQ(fault_for("taken/deeper"),
            "error: taken/deeper/run: the folder of results cannot be made (Not a directory)\n");
  std::filesystem::create_directory(folder / "out");
  test::write_text(folder / "out/run", "");
  EXPECT_EQ(fault_for("out"), "error: out/run: the folder of results cannot be made (Not a directory)\n");
}

} // namespace
} // namespace rubato::bad_input_test
