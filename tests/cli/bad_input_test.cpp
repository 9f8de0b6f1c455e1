// SPDX-License-Identifier: LGPL-3.0-or-later
// Decks that ask for what cannot be: exit code 2, one sentence each at its place, and nothing is written.
#include <gtest/gtest.h>

#include "program.hpp"
#include "support/two_blocks.hpp"
#include <ostream>

namespace rubato {
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
    testing::Values(Fault{"UnknownKey", "thickness: 1", "thicknes: 1",
                          "14:1: unknown key 'thicknes'; did you mean 'thickness'?"},
                    Fault{"WrongType", "step: 1e-4", "step: soon", ""},
                    Fault{"NegativeStep", "step: 1e-4", "step: -1e-4", ""},
                    Fault{"NegativeThickness", "thickness: 1", "thickness: -1", ""},
                    Fault{"MissingGroup", "on: held,", "on: hold,", ""},
                    Fault{"MissingMaterialGroup", "cells: all", "cells: [upper, lowe]", ""},
                    Fault{"MaterialOnEdges", "cells: all", "cells: held", ""},
                    Fault{"MaterialWithoutCells", "cells: all}",
                          "cells: all}\n  rubber: {young: 1e6, poisson: 0.4, density: 1000, cells: []}", ""},
                    Fault{"CellsWithoutMaterial", "cells: all", "cells: upper", ""},
                    Fault{"NoDensity", "density: 7800, ", "", ""},
                    Fault{"MasterIsSlave", "slave: lower_face", "slave: upper_face", ""},
                    Fault{"OverlappingSurfaces", "top: roof}", "top: roof, right: upper_face}", ""},
                    Fault{"ContactOnBodies", "master: upper_face", "master: upper", ""},
                    Fault{"ContactOnNodes", "master: upper_face", "master: tip", ""},
                    Fault{"ProbeWithoutNode", "node: tip", "node: tp", ""},
                    Fault{"ProbeOnManyNodes", "node: tip", "node: held", ""},
                    Fault{"LoadOnBodies", "nodal_force: {on: tip, y: -1e7}",
                          "pressure: {on: upper, value: 1e6}", ""},
                    Fault{"MissingMeshFile", "  generate:", "  file: none.med\n  generated:", ""},
                    Fault{"NothingHeldInStatics", "time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}",
                          "time: {scheme: static, step: 1, end: 1}", ""}),
    [](const auto& info) { return info.param.name; });

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
  EXPECT_EQ(fault_for("out"),
            "error: out/run: the folder of results cannot be made (a file has this name)\n");
}

} // namespace
} // namespace rubato
