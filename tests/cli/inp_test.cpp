// SPDX-License-Identifier: LGPL-3.0-or-later
// .inp files as the program meets them.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include <sstream>
#include <vector>

namespace rubato::inp_test {
namespace {

using test::run_program;
using test::ScratchFolder;

std::string inp(const std::string& name) {
  return std::string(RUBATO_SOURCE_DIR) + "/tests/inp/" + name + ".inp";
}

/// The last number of the last line.
double last_number(const std::filesystem::path& table) {
  std::istringstream lines(test::text_of(table));
  std::string line, last;
  while (std::getline(lines, line))
    last = line;
  return std::stod(last.substr(last.rfind(',') + 1));
}

TEST(InpFiles, RunEachStepInItsFolderAndSayWhatDiffers) {
  const ScratchFolder folder;
  const auto run = run_program({"run", inp("moved_support"), "-q", "-o", "out"}, folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NEAR(last_number(folder / "out/step1/probes.csv"), 0, 1e-6); // z of the reaction
  EXPECT_TRUE(std::filesystem::exists(folder / "out/step2/run.json"));
  const auto loud = run_program({"run", inp("c3d8r"), "-o", "out"}, folder.path());
  EXPECT_NE(loud.err.find("C3D8R has forces of rubato's own against hourglasses"), std::string::npos)
      << loud.err;
}

TEST(InpFiles, AreDecksWithTheSameAnswer) {
  for (const auto* name : {"sdnl140_f", "preloaded", "amplitudes", "discrete"}) {
    const ScratchFolder folder;
    const auto deck = run_program({"deck", inp(name), "-o", "deck.yaml"}, folder.path());
    ASSERT_EQ(deck.exit_code, 0) << deck.err;
    ASSERT_EQ(run_program({"run", inp(name), "-q", "-o", "a"}, folder.path()).exit_code, 0);
    const auto again = run_program({"run", "deck.yaml", "-q", "-o", "b"}, folder.path());
    ASSERT_EQ(again.exit_code, 0) << again.err;
    int runs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "a")) {
      if (!entry.is_directory())
        continue; // results of all steps
      const auto run = entry.path().filename().string();
      for (const auto* table : {"probes.csv", "energy.csv"})
        EXPECT_EQ(test::text_of(folder / "a" / run / table), test::text_of(folder / "b" / run / table))
            << name;
      ++runs;
    }
    EXPECT_GE(runs, 1) << name;
    // To standard output it is the same text.
    EXPECT_EQ(nlohmann::json::parse(run_program({"deck", inp(name)}, folder.path()).out).size(),
              nlohmann::json::parse(test::text_of(folder / "deck.yaml")).size());
  }
}

TEST(InpFiles, TakeSettingsAndTheChoiceOfRuns) {
  const ScratchFolder folder;
  const auto run = run_program(
      {"run", inp("two_steps"), "-q", "-o", "out", "--only", "More", "--set", "fields.digits=9"},
      folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "out/Load/run.json")); // which it starts from
  EXPECT_FALSE(std::filesystem::exists(folder / "out/Off"));
  const auto bad = run_program({"run", inp("two_steps"), "--set", "time.stepp=1"}, folder.path());
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.err.find("did you mean 'step'?"), std::string::npos) << bad.err;
}

TEST(InpFiles, AreResumedAndCheckedAsDecksAre) {
  const ScratchFolder folder;
  ASSERT_EQ(run_program({"run", inp("two_steps"), "-q", "-o", "out"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_program({"run", inp("two_steps"), "-q", "-o", "out", "--resume"}, folder.path()).exit_code,
            0);
  const auto check = run_program({"check", inp("two_steps")}, folder.path());
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_NE(check.out.find("no fault in the deck; 3 runs: Load, More, Off"), std::string::npos) << check.out;
  EXPECT_EQ(run_program({"check", "out/Load"}, folder.path()).exit_code, 0);
}

TEST(InpFiles, HaveModesAsManyAsTheyAskFor) {
  const ScratchFolder folder;
  const auto modes = run_program({"modes", inp("modes"), "-o", "out"}, folder.path());
  EXPECT_EQ(modes.exit_code, 0) << modes.err;
  EXPECT_NE(modes.out.find("run: 3 modes"), std::string::npos) << modes.out;
  // A run computes them among the other steps.
  auto text = test::text_of(inp("modes"));
  test::write_text(folder / "both.inp", text + "*STEP\n*STATIC\n*CLOAD\n END, 1, 1.\n*END STEP\n");
  const auto run = run_program({"run", "both.inp", "-o", "both"}, folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.out.find("step1: 3 modes"), std::string::npos) << run.out;
  EXPECT_TRUE(std::filesystem::exists(folder / "both/step1/modes.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "both/step2/run.json"));
  const auto deck = run_program({"deck", "both.inp"}, folder.path());
  EXPECT_EQ(deck.out.find("step1"), std::string::npos) << deck.out;
  EXPECT_EQ(run_program({"check", "both.inp"}, folder.path()).exit_code, 0);
  EXPECT_EQ(run_program({"check", inp("modes")}, folder.path()).exit_code, 0);
}

/// The first frequencies of a table of modes.
std::vector<double> frequencies(const std::filesystem::path& table) {
  std::istringstream lines(test::text_of(table));
  std::string line;
  std::getline(lines, line);
  std::vector<double> found;
  while (std::getline(lines, line))
    found.push_back(std::stod(line.substr(line.find(',') + 1)));
  return found;
}

TEST(InpFiles, HaveModesInARange) {
  const ScratchFolder folder;
  const auto of = [&](const std::string& numbers) {
    auto text = test::text_of(inp("modes"));
    const auto at = text.find('\n', text.find("*FREQUENCY")) + 1;
    text.replace(at, text.find('\n', at) - at, numbers);
    test::write_text(folder / "range.inp", text);
    const auto run = run_program({"modes", "range.inp", "-o", "out"}, folder.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return frequencies(folder / "out/run/modes.csv");
  };
  const auto all = of("4");
  ASSERT_EQ(all.size(), 4U);
  const auto between = [](double a, double b) { return std::to_string(0.5 * (a + b)); };
  EXPECT_EQ(of("2, " + between(all[0], all[1])), (std::vector{all[1], all[2]}));
  EXPECT_EQ(of(", , " + between(all[2], all[3])), (std::vector{all[0], all[1], all[2]}));
  EXPECT_EQ(of("4, , " + between(all[0], all[1])), (std::vector{all[0]}));
}

TEST(InpFiles, AreRefusedWithEveryFaultBeforeAnythingIsWritten) {
  const ScratchFolder folder;
  test::write_text(folder / "bad.inp", "*NODE\n 1, 0, 0\n 2, x, 0\n*ELEMNT, TYPE=CPS3\n 1, 1, 2, 3\n");
  const auto run = run_program({"run", "bad.inp"}, folder.path());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.err,
            "error: bad.inp:3:5: found 'x', expected a coordinate, a number\n"
            "error: bad.inp:4:1: found '*ELEMNT', which is no keyword of Abaqus or CalculiX; did you mean "
            "'*ELEMENT'?\n");
  EXPECT_FALSE(std::filesystem::exists(folder / "bad"));
  EXPECT_EQ(run_program({"run", "none.inp"}, folder.path()).err,
            "error: mesh file 'none.inp' does not exist\n");
}

TEST(InpFiles, TellFaultsThatOnlyTheMeshShowsAtTheirLines) {
  const ScratchFolder folder;
  auto text = test::text_of(inp("c3d8"));
  // Nothing holds the bar along z any more: that shows when the model is built.
  text.replace(text.find(" Z0, 3, 3\n"), 11, "");
  test::write_text(folder / "loose.inp", text);
  const auto run = run_program({"run", "loose.inp", "-q"}, folder.path());
  EXPECT_EQ(run.exit_code, 2) << run.err;
  EXPECT_TRUE(run.err.find("error: loose.inp:") == 0) << run.err;
  const auto check = run_program({"check", "loose.inp"}, folder.path());
  EXPECT_EQ(check.exit_code, 2) << check.out;
  EXPECT_NE(check.err.find(run.err), std::string::npos) << check.err;
}

} // namespace
} // namespace rubato::inp_test
