// SPDX-License-Identifier: LGPL-3.0-or-later
// Runs that go well, fail a check, or do not converge: exit codes and what is left in the folder.
#include "rubato/core/tolerances.hpp"
#include "rubato/results/csv.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.hpp"
#include "support/two_blocks.hpp"

namespace rubato::run_test {
namespace {

using test::two_blocks;

nlohmann::json summary(const std::filesystem::path& folder) {
  return nlohmann::json::parse(test::text_of(folder / "run.json"));
}

/// No step of it ever satisfies the wanted residual.
const std::string hopeless = "newton: {residual: 1e-300, max_iterations: 1}\n";

std::string check_of(const std::string& reference) {
  return "checks:\n  - {probe: end.y, at: 4e-4, reference: " + reference + ", tolerance: 1e-3}\n";
}

class Run : public testing::Test {
protected:
  test::Outcome run(const std::string& deck, const std::vector<std::string>& options = {}) const {
    test::write_text(folder_ / "deck.yaml", deck);
    std::vector<std::string> arguments{"run", "deck.yaml", "-o", "out"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return test::run_program(arguments, folder_.path());
  }

  test::Outcome check(const std::string& what) const {
    return test::run_program({"check", what}, folder_.path());
  }

  bool exists(const std::string& file) const { return std::filesystem::exists(folder_ / file); }

  test::ScratchFolder folder_;
};

TEST_F(Run, WritesItsFolderAndEndsWithZero) {
  const auto outcome = run(two_blocks);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("run: 4 steps, ")) << outcome.out;
  EXPECT_NE(outcome.out.find("results in out/run\n"), std::string::npos);
  EXPECT_NE(outcome.err.find("100 % t = 0.0004"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << "standard error is no terminal";
  EXPECT_EQ(results::read_csv(folder_ / "out/run/probes.csv").rows.size(), 5U);
  EXPECT_EQ(results::read_csv(folder_ / "out/run/resultants_interface.csv").rows.size(), 4U);
  EXPECT_EQ(summary(folder_ / "out/run").at("status"), "complete");
}

TEST_F(Run, SaysWhatItsFactorNeedsBeforeTheFirstStep) {
  const auto outcome = run(two_blocks);
  const auto told = outcome.err.find("run: factoring the matrix takes ");
  ASSERT_NE(told, std::string::npos) << outcome.err;
  EXPECT_LT(told, outcome.err.find("run: solver "));
  EXPECT_GT(summary(folder_ / "out/run").at("factor_bytes"), 0);
}

TEST_F(Run, EchoesWhatDecidesWhenAStepEnds) {
  ASSERT_EQ(run(two_blocks).exit_code, 0);
  const auto echoed = summary(folder_ / "out/run").at("tolerances");
  EXPECT_EQ(echoed.size(), named_tolerances.size());
  for (const auto& entry : named_tolerances)
    EXPECT_EQ(echoed.at(std::string(entry.name)), tolerances.*entry.value) << entry.name;
}

TEST_F(Run, WritesInstantsAsTheyWereMeant) {
  const auto deck = test::with(two_blocks, "step: 1e-4, end: 4e-4", "step: 0.001, end: 0.01");
  ASSERT_EQ(run(deck + "fields: {formats: [vtu], every: 3}\n").exit_code, 0);
  const auto probes = test::text_of(folder_ / "out/run/probes.csv");
  EXPECT_NE(probes.find("\n0.009,"), std::string::npos) << probes;
  EXPECT_NE(test::text_of(folder_ / "out/run/fields.pvd").find("\"0.009\""), std::string::npos);
}

TEST_F(Run, SaysNothingWhenQuiet) {
  const auto outcome = run(two_blocks, {"--quiet"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.out + outcome.err, "");
}

TEST_F(Run, WritesBesideTheCallerUnderTheDecksNameByDefault) {
  test::write_text(folder_ / "deck.yaml", two_blocks);
  EXPECT_EQ(test::run_program({"run", "deck.yaml"}, folder_.path()).exit_code, 0);
  EXPECT_TRUE(exists("deck/run/run.json"));
}

TEST_F(Run, EndsWithOneWhenACheckFailsAndSoDoesCheckingAgain) {
  const auto outcome = run(two_blocks + check_of("1.5"), {"-q"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("FAILS"), std::string::npos) << outcome.out;
  const auto again = check("out");
  EXPECT_EQ(again.exit_code, 1) << again.err;
  EXPECT_NE(again.out.find("FAILS"), std::string::npos);
}

TEST_F(Run, EndsWithZeroWhenItsChecksHoldAndSoDoesCheckingAgain) {
  ASSERT_EQ(run(two_blocks).exit_code, 0);
  const auto probes = results::read_csv(folder_ / "out/run/probes.csv");
  const auto value = probes.rows.back().at(static_cast<std::size_t>(probes.column("end.y")));
  const auto outcome = run(two_blocks + check_of(std::to_string(value * 1e3) + "e-3"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out;
  EXPECT_EQ(check("out/run").exit_code, 0);
}

TEST_F(Run, EndsWithThreeWithoutConvergenceAndKeepsWhatWasReached) {
  const auto outcome = run(two_blocks + hopeless);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("error: run: no convergence from t = 0 to "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("the results up to there are in out/run, --resume goes on from there\n"),
            std::string::npos)
      << outcome.err;
  const auto json = summary(folder_ / "out/run");
  EXPECT_EQ(json.at("status"), "not_converged");
  EXPECT_TRUE(json.at("reason").get<std::string>().starts_with("no convergence"));
  EXPECT_EQ(json.at("cuts"), 12);
  EXPECT_EQ(results::read_csv(folder_ / "out/run/probes.csv").rows.size(), 1U);
  EXPECT_EQ(check("out").exit_code, 3);
}

TEST_F(Run, LeavesNothingOfTheRunThatWasThereBefore) {
  const std::string fields = "fields: {every: 1}\n";
  ASSERT_EQ(run(two_blocks + fields).exit_code, 0);
  EXPECT_TRUE(exists("out/run/fields/000004.vtu"));
  test::write_text(folder_ / "out/run/notes.txt", "mine");
  test::write_text(folder_ / "out/run/fields/mine.vtu", "mine");
  ASSERT_EQ(
      run(test::with(two_blocks, "interface:", "touch:") + fields, {"--set", "time.end=2e-4"}).exit_code, 0);
  EXPECT_TRUE(exists("out/run/fields/000002.vtu"));
  EXPECT_FALSE(exists("out/run/fields/000004.vtu"));
  EXPECT_FALSE(exists("out/run/resultants_interface.csv"));
  EXPECT_TRUE(exists("out/run/resultants_touch.csv"));
  EXPECT_TRUE(exists("out/run/notes.txt"));
  EXPECT_TRUE(exists("out/run/fields/mine.vtu"));
}

TEST_F(Run, GoesOnWithRunsThatDoNotNeedTheOneThatFailed) {
  const std::string runs = "runs:\n"
                           "  preload:\n    time: {scheme: static, alpha: ~, step: 1, end: 1}\n    " +
                           hopeless + "  after: {time: {start: {from: preload}}}\n  alone: {}\n";
  const auto outcome = run(two_blocks + runs);
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("error: after: not run, because preload did not come to its end\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_FALSE(exists("out/after"));
  EXPECT_EQ(summary(folder_ / "out/alone").at("status"), "complete");
}

TEST_F(Run, OfAFewOnlyRunsWhatTheyStartFromToo) {
  const std::string runs = "runs:\n  preload: {time: {scheme: static, alpha: ~, step: 1, end: 1}}\n"
                           "  after: {time: {start: {from: preload}}}\n  alone: {}\n";
  EXPECT_EQ(run(two_blocks + runs, {"--only", "after"}).exit_code, 0);
  EXPECT_TRUE(exists("out/preload/run.json"));
  EXPECT_TRUE(exists("out/after/run.json"));
  EXPECT_FALSE(exists("out/alone"));
}

class RunOfAFew : public Run {
protected:
  const std::string deck_ = two_blocks + R"(fields: {formats: [med]}
runs:
  preload: {time: {scheme: static, alpha: ~, step: 0.5, end: 1}}
  after: {time: {start: {from: preload}}}
)";
  /// Whether the run that the other one starts from was computed.
  static bool computed(const test::Outcome& outcome) {
    return outcome.err.find("preload: scheme static") != std::string::npos;
  }
  static bool told_of_use(const test::Outcome& outcome) {
    return outcome.err.find("preload: complete and unchanged in out/preload, not computed again\n") !=
           std::string::npos;
  }
};

TEST_F(RunOfAFew, UsesWhatItStartsFromWhereThatIsThereAndUnchanged) {
  const auto first = run(deck_, {"--only", "after"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_TRUE(computed(first));
  const auto probes = test::text_of(folder_ / "out/after/probes.csv");
  const auto again = run(test::with(deck_, "title: two blocks", "title: another"), {"--only", "after"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(told_of_use(again)) << again.err;
  EXPECT_FALSE(computed(again)) << again.err;
  EXPECT_FALSE(exists("out/preload/former"));
  EXPECT_EQ(test::text_of(folder_ / "out/after/probes.csv"), probes);
  EXPECT_TRUE(computed(run(deck_))) << "a run that is asked for is computed";
}

TEST_F(RunOfAFew, ComputesWhatItStartsFromAgainWhereThatHasChanged) {
  ASSERT_EQ(run(deck_, {"--only", "after"}).exit_code, 0);
  for (const auto* change : {"runs.preload.time.step=0.25", "runs.preload.time.end=2",
                             "runs.preload.probes=~", "runs.preload.newton.residual=1e-9"}) {
    const auto outcome = run(deck_, {"--only", "after", "--set", change});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(computed(outcome)) << change << "\n" << outcome.err;
    EXPECT_FALSE(told_of_use(outcome)) << change;
  }
}

TEST_F(RunOfAFew, ComputesWhatItStartsFromAgainWhereThatIsNotWhole) {
  for (const auto* file : {"checkpoint.h5", "run.json", "probes.csv"}) {
    ASSERT_EQ(run(deck_, {"--only", "after"}).exit_code, 0);
    std::filesystem::remove(folder_ / "out/preload" / file);
    const auto outcome = run(deck_, {"--only", "after"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(computed(outcome)) << file << "\n" << outcome.err;
  }
  ASSERT_EQ(
      run(deck_, {"--only", "preload", "--set", "newton.max_iterations=1", "--set", "newton.residual=1e-300"})
          .exit_code,
      3);
  EXPECT_TRUE(computed(run(deck_, {"--only", "after"}))) << "it had failed";
}

TEST_F(RunOfAFew, SaysWhichRunASettingLeftAlone) {
  const auto outcome = run(deck_, {"--only", "after", "--set", "time.step=2e-4"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("preload: left as in the deck, as --set changes the runs of --only; '--only "
                             "preload,after' would change it, too\n"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(summary(folder_ / "out/preload").at("steps"), 2);
  EXPECT_EQ(summary(folder_ / "out/after").at("steps"), 2);
}

TEST_F(Run, IsCheckedOnlyWhereThereIsOne) {
  EXPECT_EQ(check(".").err, "error: .: found no run.json, expected the folder of a run\n");
  EXPECT_EQ(check("none").err, "error: none: found no run.json, expected the folder of a run\n");
  EXPECT_EQ(check("none").exit_code, 2);
  test::write_text(folder_ / "run.json", "{\"status\": ");
  EXPECT_EQ(check(".").exit_code, 2);
}

} // namespace
} // namespace rubato::run_test
