// SPDX-License-Identifier: LGPL-3.0-or-later
// The command line itself.
#include <gtest/gtest.h>

#include "program.hpp"
#include "support/two_blocks.hpp"

namespace rubato::arguments_test {
namespace {

using test::run_program;

struct Case {
  std::vector<std::string> arguments;
  int exit_code;
  std::string out; ///< what standard output begins with
  std::string err; ///< what standard error is
};

class CommandLine : public testing::Test {
protected:
  CommandLine() { test::write_text(folder_ / "deck.yaml", test::two_blocks); }

  void expect(const Case& wanted) const {
    const auto outcome = run_program(wanted.arguments, folder_.path());
    EXPECT_EQ(outcome.exit_code, wanted.exit_code) << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with(wanted.out)) << outcome.out;
    EXPECT_EQ(outcome.err, wanted.err);
  }

  test::ScratchFolder folder_;
};

TEST_F(CommandLine, TellsItsVersionAndHelps) {
  expect({{"--version"}, 0, "rubato ", ""});
  expect({{"--help"}, 0, "rubato: how elastic bodies move, touch, rub and part", ""});
  expect({{"run", "--help"}, 0, "run a study", ""});
}

TEST_F(CommandLine, ShowsItsHelpAsAFaultWhenNothingIsAsked) {
  const auto outcome = run_program({}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("Usage: rubato"), std::string::npos);
}

TEST_F(CommandLine, RefusesUnknownSubcommandsAndOptions) {
  expect({{"rum"},
          2,
          "",
          "error: found 'rum', expected one of run, modes, new, deck, check, compare, plot, report, "
          "info, mesh, aster, list, schema; did "
          "you mean "
          "'run'?\n"});
  expect({{"run"}, 2, "", "error: deck is required (rubato --help tells more)\n"});
  expect({{"run", "deck.yaml", "--fast"},
          2,
          "",
          "error: The following argument was not expected: --fast (rubato --help tells more)\n"});
}

TEST_F(CommandLine, NamesTheDeckThatCannotBeRead) {
  expect({{"run", "none.yaml"}, 2, "", "error: none.yaml: the deck file does not exist\n"});
  expect({{"run", "."}, 2, "", "error: .: found a folder, expected a deck file\n"});
}

TEST_F(CommandLine, RefusesSettingsThatMeanNothing) {
  expect({{"run", "deck.yaml", "--set", "time.step"},
          2,
          "",
          "error: --set: found 'time.step', expected path.to.key=value\n"});
  expect({{"run", "deck.yaml", "--set", "time.stop=1"},
          2,
          "",
          "error: --set time.stop: unknown key 'time.stop'; did you mean 'step'?\n"});
  expect({{"run", "deck.yaml", "--set", "time.step=fast"},
          2,
          "",
          "error: --set time.step: time.step: found 'fast', expected a number > 0\n"});
  expect({{"run", "deck.yaml", "--set", "loads.3.nodal_force.y=1"},
          2,
          "",
          "error: --set loads.3.nodal_force.y: found '3' as place in a list, expected 0, the list has one "
          "entry\n"});
  expect({{"mesh", "some.med", "other.med", "--set", "a=b"},
          2,
          "",
          "error: --set changes a deck, but the source is a mesh file\n"});
}

TEST_F(CommandLine, RefusesRunsThatTheDeckDoesNotHave) {
  expect({{"run", "deck.yaml", "--only", "rub"},
          2,
          "",
          "error: --only: found 'rub', expected one of run; did you mean 'run'?\n"});
}

TEST_F(CommandLine, ListsWhatItKnows) {
  const auto outcome = run_program({"list"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 0);
  for (const auto* word : {"HEXA27", "generalized_alpha", "augmented_lagrangian", "sphere", "plane_strain",
                           "orthotropic", ".med"})
    EXPECT_NE(outcome.out.find(word), std::string::npos) << word;
}

TEST_F(CommandLine, DescribesAndWritesMeshes) {
  expect({{"mesh", "deck.yaml", "blocks.med", "--refine", "2", "--convert", "quadratic"},
          0,
          "blocks.med: 242 nodes, 96 cells, 7 groups",
          ""});
  const auto outcome = run_program({"info", "blocks.med"}, folder_.path());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("upper_face"), std::string::npos) << outcome.out;
  expect({{"info", "none.med"}, 2, "", "error: mesh file 'none.med' does not exist\n"});
  expect({{"mesh", "deck.yaml", "blocks.stl"},
          2,
          "",
          "error: mesh file 'blocks.stl' cannot be written: its ending is '.stl', .med, .mail or .vtu was "
          "expected\n"});
  expect({{"mesh", "deck.yaml", "blocks.med", "--convert", "cubic"},
          2,
          "",
          "error: --convert: found 'cubic', expected linear, quadratic or full_quadratic\n"});
  expect({{"mesh", "deck.yaml", "blocks.med", "--refine", "0"},
          2,
          "",
          "error: --refine: found 0, expected 1 or more\n"});
}

} // namespace
} // namespace rubato::arguments_test
