// SPDX-License-Identifier: LGPL-3.0-or-later
// Groups that decks and the command line make, through the program.
#include <gtest/gtest.h>

#include "program.hpp"
#include <sstream>

namespace rubato::groups_test {
namespace {

using test::run_program;

const std::string deck = R"(mesh:
  generate: [{name: block, box: {from: [0, 0, 0], to: [1, 1, 2]}, divisions: [2, 2, 4]}]
  groups:
    floor: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}}
    roof: {normal: [0, 0, 1], of: block}
physics: solid
materials: {steel: {young: 200e9, poisson: 0}}
supports: [{on: floor, fix: [x, y, z]}]
functions: {press: {product: [{ramp: [0, 1]}, {expression: 2*t}]}}
loads: [{pressure: {on: roof, value: {along: x, at: [0, 1], values: [1e6, 1e6]}, function: press}}]
time: {scheme: static, step: 0.5, end: 1}
probes: {roof: {on: roof, take: mean}}
checks:
  - {probe: roof.z, at: 0.5, reference: -5e-6, tolerance: 1e-9, source: analytic}
  - {probe: roof.z, at: 1, reference: -2e-5, tolerance: 1e-9, source: analytic}
)";

class GroupsOfTheProgram : public testing::Test {
protected:
  GroupsOfTheProgram() { test::write_text(folder_ / "deck.yaml", deck); }
  test::Outcome run(const std::vector<std::string>& arguments) const {
    return run_program(arguments, folder_.path());
  }

  test::ScratchFolder folder_;
};

TEST_F(GroupsOfTheProgram, HoldAndLoadABlock) {
  const auto outcome = run({"run", "deck.yaml", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
}

TEST_F(GroupsOfTheProgram, AreWrittenAndMadeOnTheCommandLine) {
  ASSERT_EQ(run({"mesh", "deck.yaml", "a.med"}).exit_code, 0);
  const auto made = run({"mesh", "a.med", "b.med", "--group", "skin={skin: all}", "--group",
                         "walls={difference: [skin, roof]}", "--convert", "quadratic"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto info = run({"info", "b.med"}).out;
  EXPECT_NE(info.find("roof                         4   faces"), std::string::npos) << info;
  EXPECT_NE(info.find("skin                        40   faces"), std::string::npos) << info;
  EXPECT_NE(info.find("walls                       36   faces"), std::string::npos) << info;
  EXPECT_NE(info.find("QUAD8             40"), std::string::npos) << info;
}

TEST_F(GroupsOfTheProgram, AreOrderedInMailFiles) {
  ASSERT_EQ(run({"mesh", "deck.yaml", "a.med"}).exit_code, 0);
  const auto made = run({"mesh", "a.med", "b.mail", "--group", "edge={box: {from: [0, 0, 0], to: [0, 0, 2]}}",
                         "--group", "line={along: [0, 0, -1], of: edge}"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto text = test::text_of(folder_ / "b.mail");
  const auto at = text.find("GROUP_NO NOM = line");
  ASSERT_NE(at, std::string::npos) << text;
  std::istringstream words(text.substr(text.find('\n', at)));
  for (const auto* name : {"N37", "N28", "N19", "N10", "N1", "FINSF"}) {
    std::string word;
    words >> word;
    EXPECT_EQ(word, name);
  }
}

TEST_F(GroupsOfTheProgram, AreRefusedInTheDeckAtTheirPlace) {
  const auto outcome = run({"run", "deck.yaml", "--set", "mesh.groups.roof.angle=1", "--set",
                            "mesh.groups.roof.normal=[1, 1, 0]", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_TRUE(
      outcome.err.starts_with("error: deck.yaml:5:5: mesh.groups.roof: found no face with this outward "
                              "normal; that of the face of nodes N"))
      << outcome.err;
  EXPECT_TRUE(outcome.err.ends_with("is the nearest, 45 degrees off\n")) << outcome.err;
}

TEST_F(GroupsOfTheProgram, AreRefusedOnTheCommandLine) {
  ASSERT_EQ(run({"mesh", "deck.yaml", "a.med"}).exit_code, 0);
  const auto known = run({"mesh", "a.med", "b.med", "--group", "roof={skin: all}"});
  EXPECT_EQ(known.exit_code, 2);
  EXPECT_EQ(known.err,
            "error: --group: mesh.groups.roof: the mesh has a group 'roof' already, expected another "
            "name\n");
  const auto word = run({"mesh", "a.med", "b.med", "--group", "top={skn: all}"});
  EXPECT_EQ(word.exit_code, 2);
  EXPECT_EQ(word.err, "error: --group top: unknown key 'mesh.groups.top.skn'; did you mean 'skin'?\n");
}

} // namespace
} // namespace rubato::groups_test
