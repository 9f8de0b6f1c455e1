// SPDX-License-Identifier: LGPL-3.0-or-later
// rubato compare, and checks of one run against another.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "support/two_blocks.hpp"
#include <memory>

namespace rubato::compare_test {
namespace {

using Words = std::vector<std::string>;

const std::string runs = R"(fields: {formats: [med], at: [1e-4, 2e-4]}
runs:
  rough: {}
  smooth: {contact: {interface: {friction: 0}}}
  fine: {mesh: {refine: 2}}
  silent: {fields: ~}
  cut_short: {newton: {residual: 1e-300, max_iterations: 1}}
)";

class Compare : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<test::ScratchFolder>();
    test::write_text(*folder_ / "deck.yaml", test::two_blocks + runs);
    ASSERT_EQ(test::run_program({"run", "deck.yaml", "-q", "-o", "out"}, folder_->path()).exit_code, 3);
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static test::Outcome compare(const std::string& a, const std::string& b, Words options) {
    Words words{"compare", a, b};
    words.insert(words.end(), options.begin(), options.end());
    return test::run_program(words, folder_->path());
  }

  static void expect_refusal(const std::string& a, const std::string& b, const Words& options,
                             const std::string& sentence) {
    const auto outcome = compare(a, b, options);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.err, "error: " + sentence + "\n");
    EXPECT_EQ(outcome.out, "");
  }

  static inline std::unique_ptr<test::ScratchFolder> folder_;
};

TEST_F(Compare, ShowsNormsOverTheWholeMesh) {
  const auto outcome = compare("out/rough", "out/smooth", {"--at", "2e-4"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("displacement at t = 0.0002, A = out/rough, B = out/smooth\n"
                                      "whole mesh, 30 nodes\n"))
      << outcome.out;
  EXPECT_NE(outcome.out.find("  N"), std::string::npos) << "the node of the largest difference";
}

TEST_F(Compare, ShowsANodeByNumberGroupOrProbe) {
  const auto by_number = compare("out/rough", "out/smooth", {"--at", "2e-4", "--node", "N15"});
  EXPECT_EQ(by_number.exit_code, 0) << by_number.err;
  EXPECT_NE(by_number.out.find("\nN15 (1, 0.2)\n"), std::string::npos) << by_number.out;
  EXPECT_EQ(by_number.out.find("whole mesh"), std::string::npos);
  for (const auto* name : {"tip", "end"})
    EXPECT_EQ(compare("out/rough", "out/smooth", {"--at", "2e-4", "--node", name}).out, by_number.out)
        << name;
}

TEST_F(Compare, ShowsAGroupAndTheWholeMeshWhenBothAreAsked) {
  const auto outcome =
      compare("out/rough", "out/smooth",
              {"--at", "2e-4", "--field", "contact_pressure", "--group", "lower_face", "--norms"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("\nlower_face, 5 nodes\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("\nwhole mesh, 30 nodes\n"), std::string::npos) << outcome.out;
}

TEST_F(Compare, WritesTheDifferenceForParaView) {
  const auto outcome = compare("out/rough", "out/smooth", {"--at", "2e-4", "-o", "difference.vtu"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("written to difference.vtu\n"), std::string::npos);
  EXPECT_NE(test::text_of(*folder_ / "difference.vtu").find("displacement_difference"), std::string::npos);
}

TEST_F(Compare, IsACheckWithATolerance) {
  const auto loose = compare("out/rough", "out/smooth", {"--at", "2e-4", "--tolerance", "1"});
  EXPECT_EQ(loose.exit_code, 0);
  EXPECT_TRUE(loose.out.ends_with("tolerance 1: ok\n")) << loose.out;
  const auto tight = compare("out/rough", "out/smooth", {"--at", "2e-4", "--tolerance", "1e-30"});
  EXPECT_EQ(tight.exit_code, 1);
  EXPECT_TRUE(tight.out.ends_with("tolerance 1e-30: FAILS\n")) << tight.out;
  EXPECT_EQ(compare("out/rough", "out/rough", {"--at", "2e-4", "--tolerance", "0"}).exit_code, 0);
}

TEST_F(Compare, ShowsHistoriesOfRunsOnAnyMeshWithAnyFields) {
  const auto outcome = compare("out/rough", "out/fine", {"--probe", "end"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("A = out/rough, B = out/fine, 5 common instants\n")) << outcome.out;
  EXPECT_NE(outcome.out.find("end.x"), std::string::npos);
  EXPECT_EQ(compare("out/rough", "out/silent", {"--probe", "end.y", "--tolerance", "0"}).exit_code, 0);
  EXPECT_EQ(compare("out/rough", "out/smooth", {"--probe", "end", "--tolerance", "0"}).exit_code, 1);
  EXPECT_EQ(compare("out/rough", "out/smooth", {"--probe", "end.y", "--at", "1.5e-4"}).exit_code, 0);
}

TEST_F(Compare, ComparesWhatARunThatStoppedEarlyReached) {
  const auto outcome = compare("out/rough", "out/cut_short", {"--probe", "end"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("A = out/rough, B = out/cut_short, 1 common instant\n")) << outcome.out;
  expect_refusal("out/rough", "out/cut_short", {"--probe", "end", "--at", "2e-4"},
                 "run B: goes from t = 0 to 0, which does not reach 0.0002");
  expect_refusal("out/rough", "out/cut_short", {"--at", "2e-4"}, "out/cut_short: has stored no field yet");
}

TEST_F(Compare, RefusesWhatCannotBeCompared) {
  const Words at{"--at", "2e-4"};
  expect_refusal("out/ruff", "out/smooth", at,
                 "out/ruff: found no run.json, expected the folder of a run; did you mean 'out/rough'?");
  expect_refusal("out/rough", "out", at,
                 "out: found no run.json, expected the folder of a run; there are out/cut_short, out/fine, "
                 "out/rough, out/silent, out/smooth");
  expect_refusal("out/rough", "out/smooth", {},
                 "'--at' is missing: expected the instant at which the field is compared, or '--probe' to "
                 "compare histories");
  expect_refusal("out/rough", "out/smooth", {"--at", "3e-4"},
                 "out/rough: holds no displacement at t = 0.0003; the nearest stored are 0.0002 and 0.0004");
  expect_refusal("out/rough", "out/smooth", {"--at", "2e-4", "--field", "pressure"},
                 "out/rough: no field is called 'pressure'; there are acceleration, contact_cumulated_slip, "
                 "contact_friction_work, contact_gap, "
                 "contact_pressure, contact_slip, contact_status, displacement, stress, velocity, von_mises");
  expect_refusal("out/rough", "out/silent", at,
                 "out/silent: holds no fields that can be read back, expected a run with 'fields: {formats: "
                 "[med], at: [0.0002]}'");
  expect_refusal("out/rough", "out/fine", at,
                 "out/rough and out/fine have different meshes: 30 nodes and 32 cells against 90 and 96");
}

TEST_F(Compare, RefusesNamesThatMeanNothing) {
  expect_refusal("out/rough", "out/smooth", {"--at", "2e-4", "--node", "N99"},
                 "found 'N99', expected a group or a node ('N90') of the mesh; the mesh has the groups held, "
                 "lower, lower_face, roof, tip, upper, upper_face");
  expect_refusal("out/rough", "out/smooth", {"--at", "2e-4", "--node", "held"},
                 "--node: group 'held' has 6 nodes, expected one (--group takes many)");
  expect_refusal("out/rough", "out/smooth", {"--at", "2e-4", "--group", "roff"},
                 "found 'roff', expected a group or a node ('N90') of the mesh; did you mean 'roof'?");
  expect_refusal("out/rough", "out/smooth", {"--probe", "ends"},
                 "run A: no probe is called 'ends'; did you mean 'end'?");
  expect_refusal("out/rough", "out/smooth", {"--probe", "end", "--node", "N15"},
                 "--node excludes --probe (rubato --help tells more)");
}

// ---- checks of one run against another

class CheckedAgainst : public testing::Test {
protected:
  CheckedAgainst() {
    test::write_text(folder_ / "deck.yaml", test::two_blocks + R"(fields: {formats: [med], at: [2e-4]}
runs:
  rough: {}
  smooth:
    contact: {interface: {friction: 0}}
    checks:
      - {probe: end.y, at: 2e-4, run: rough, tolerance: 0.5, note: nearly}
      - {field: displacement.y, on: lower_face, at: 2e-4, run: rough, tolerance: 0.1, kind: absolute}
)");
  }
  test::Outcome rubato(const Words& words) const { return test::run_program(words, folder_.path()); }

  test::ScratchFolder folder_;
};

TEST_F(CheckedAgainst, AnEarlierRunShowsTheDifferenceAndKeepsIt) {
  const auto outcome = rubato({"run", "deck.yaml", "-q", "-o", "out"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("other_run rough: nearly\n"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("displacement.y on lower_face"), std::string::npos) << outcome.out;
  const auto checks = nlohmann::json::parse(test::text_of(folder_ / "out/smooth/run.json")).at("checks");
  EXPECT_EQ(checks.at(0).at("run"), "rough");
  EXPECT_EQ(checks.at(0).at("source"), "other_run");
  const auto again = rubato({"check", "out/smooth"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.out.find("other_run rough: nearly\n"), std::string::npos) << again.out;
  EXPECT_EQ(rubato({"check", "out/smooth/"}).out, again.out);
}

TEST_F(CheckedAgainst, AnEarlierRunFailsBeyondTheTolerance) {
  const auto outcome =
      rubato({"run", "deck.yaml", "-q", "-o", "out", "--set", "runs.smooth.checks.0.tolerance=1e-30"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
  EXPECT_EQ(rubato({"check", "out"}).exit_code, 1);
}

TEST_F(CheckedAgainst, ARunOfAFormerCommandReadsItsFolder) {
  const auto refused = rubato({"run", "deck.yaml", "-o", "out", "--only", "smooth"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(
      refused.err.find("run smooth is checked against run rough, which is not run now and is not in out; "
                       "expected '--only rough,smooth'\n"),
      std::string::npos)
      << refused.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
  EXPECT_EQ(rubato({"run", "deck.yaml", "-q", "-o", "out", "--only", "rough"}).exit_code, 0);
  EXPECT_EQ(rubato({"run", "deck.yaml", "-q", "-o", "out", "--only", "smooth"}).exit_code, 0);
}

TEST_F(CheckedAgainst, ARunOnAGroupThatThereIsNotIsRefusedBeforeAnyRun) {
  const auto outcome =
      rubato({"run", "deck.yaml", "-o", "out", "--set", "runs.smooth.checks.1.on=lower_fce"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(
      outcome.err.find("found 'lower_fce', expected a group or a node ('N90') of the mesh; did you mean "
                       "'lower_face'?\n"),
      std::string::npos)
      << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

} // namespace
} // namespace rubato::compare_test
