// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/results/checks.hpp"

#include <gtest/gtest.h>

#include "support/scratch_folder.hpp"
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::results::checks_test {
namespace {

/// y = −1 − 10 t at four instants, x = 0.
const Table probes{{"t", "tip.x", "tip.y"}, {{0, 0, -1}, {0.1, 0, -2}, {0.3, 0, -4}, {0.4, 0, -5}}};

study::Check check(int component, double at, double reference, double tolerance, bool relative) {
  study::Check check;
  check.probe = "tip";
  check.component = std::string(1, "xyz"[component]);
  check.at = at;
  check.reference = reference;
  check.tolerance = tolerance;
  check.relative = relative;
  return check;
}

CheckResult result_of(const study::Check& check, const Table& table = probes) {
  return evaluate_checks(std::array{check}, table).at(0);
}

TEST(Check, TakesTheValueOfItsInstant) {
  const auto result = result_of(check(1, 0.3, -4.004, 1e-3, true));
  EXPECT_EQ(result.quantity, "tip.y");
  EXPECT_EQ(result.value, -4.0);
  EXPECT_NEAR(result.deviation, 0.004 / 4.004, 1e-15);
  EXPECT_TRUE(result.holds);
  EXPECT_FALSE(result_of(check(1, 0.3, -4.005, 1e-3, true)).holds);
}

TEST(Check, InterpolatesBetweenTwoInstants) {
  EXPECT_NEAR(result_of(check(1, 0.15, -2.5, 1e-12, true)).value.value(), -2.5, 1e-15);
}

TEST(Check, SeesInstantsThroughTheRoundingOfTime) {
  auto table = probes;
  table.rows[2][0] = 0.1 + 0.2;
  EXPECT_EQ(result_of(check(1, 0.3, -4, 1e-12, true), table).value, -4.0);
  EXPECT_EQ(result_of(check(1, 0.4 * (1 + 1e-12), -5, 1e-12, true)).value, -5.0);
}

TEST(Check, TakesTheExtremesOfAWholeHistory) {
  auto extreme = check(1, 0, -1, 1e-12, true);
  extreme.when = study::CheckedTime::largest;
  EXPECT_EQ(result_of(extreme).value, -1.0);
  EXPECT_EQ(result_of(extreme).over, "max");
  extreme.when = study::CheckedTime::least;
  EXPECT_EQ(result_of(extreme).value, -5.0);
  extreme.when = study::CheckedTime::largest_magnitude;
  EXPECT_EQ(result_of(extreme).value, 5.0);
  EXPECT_NE(to_text(std::array{result_of(extreme)}).find(" max_magnitude "), std::string::npos);
}

TEST(Check, TakesAScalarByItsProbesName) {
  study::Check scalar;
  scalar.probe = "peak";
  scalar.at = 1;
  scalar.reference = 7;
  scalar.tolerance = 1e-12;
  const auto result = result_of(scalar, {{"t", "peak"}, {{0, 3}, {1, 7}}});
  EXPECT_EQ(result.quantity, "peak");
  EXPECT_TRUE(result.holds);
}

TEST(Check, TakesEnergiesAndResultantsFromTheTablesOfTheRun) {
  const test::ScratchFolder folder;
  CsvWriter(folder / "energy.csv", std::vector<std::string>{"t", "friction"}).row(std::array{1.0, 4.0});
  CsvWriter(folder / "resultants_joint.csv", std::vector<std::string>{"t", "normal", "force.x"})
      .row(std::array{1.0, 5.0, 6.0});
  study::Check energy;
  energy.energy = "friction";
  energy.at = 1;
  energy.reference = 4;
  energy.tolerance = 1e-12;
  study::Check force = energy;
  force.energy.clear();
  force.resultant = {"joint", "force.x"};
  force.reference = 6;
  const auto results = evaluate_checks(std::array{energy, force}, probes, folder.path());
  EXPECT_EQ(results[0].quantity, "energy friction");
  EXPECT_EQ(results[0].value, 4.0);
  EXPECT_EQ(results[1].quantity, "joint.force.x");
  EXPECT_EQ(results[1].value, 6.0);
  EXPECT_TRUE(results[0].holds && results[1].holds);
}

TEST(Check, MeasuresAbsolutelyWhenAsked) {
  const auto result = result_of(check(0, 0.1, 1e-4, 2e-4, false));
  EXPECT_NEAR(result.deviation, 1e-4, 1e-18);
  EXPECT_TRUE(result.holds);
  EXPECT_FALSE(result_of(check(0, 0.1, 3e-4, 2e-4, false)).holds);
}

TEST(Check, FailsWhenTheRunDidNotReachItsInstant) {
  for (const double at : {0.41, -0.1}) {
    const auto result = result_of(check(1, at, -5, 1, true));
    EXPECT_FALSE(result.value.has_value());
    EXPECT_FALSE(result.holds);
  }
  EXPECT_FALSE(result_of(check(1, 0, 0, 1, false), {{"t", "tip.y"}, {}}).value.has_value());
  EXPECT_FALSE(result_of(check(2, 0.1, 0, 1, false)).value.has_value()) << "no such column";
  EXPECT_NE(to_text(std::array{result_of(check(1, 0.41, -5, 1, true))}).find("not reached"),
            std::string::npos);
}

TEST(Check, NeverHoldsForWhatIsNotANumber) {
  const Table broken{{"t", "tip.y"}, {{0, std::nan("")}}};
  EXPECT_FALSE(result_of(check(1, 0, 1, 1, true), broken).holds);
}

TEST(CheckTable, ShowsSourceAndNote) {
  auto one = check(1, 0.3, -4, 1e-3, true);
  one.source = study::CheckSource::other_code;
  one.note = "a report";
  const auto text = to_text(std::array{result_of(one), result_of(check(0, 0.1, 1, 0.5, false))});
  EXPECT_NE(text.find("ok     other_code: a report\n"), std::string::npos) << text;
  EXPECT_NE(text.find("FAILS  external\n"), std::string::npos) << text;
  EXPECT_NE(text.find("5.0e-01 abs"), std::string::npos) << text;
}

TEST(CheckTable, InMarkdownHasACellForEachPart) {
  auto result = result_of(check(1, 0.3, -4.004, 1e-3, true));
  result.note = "a | b * c";
  EXPECT_EQ(to_markdown(std::array{result}),
            "| quantity | t | value | reference | difference | deviation | tolerance | verdict | source |\n"
            "|---|---:|---:|---:|---:|---:|---:|---|---|\n"
            "| tip.y | 0.3 | -4 | -4.004 | 4.00e-03 | 9.99e-04 | 1.0e-03 relative | ok | external: a \\| b "
            "\\* c |\n");
  const auto missing = result_of(check(1, 9, 1, 1e-3, false));
  EXPECT_NE(to_markdown(std::array{missing})
                .find("| tip.y | 9 | not reached | 1 |  |  | 1.0e-03 absolute | **FAILS** |"),
            std::string::npos)
      << to_markdown(std::array{missing});
}

} // namespace
} // namespace rubato::results::checks_test
