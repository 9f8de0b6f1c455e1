// SPDX-License-Identifier: LGPL-3.0-or-later
// What the report of a step says of how it went.
#include "rubato/step/report.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace rubato::step::report_test {
namespace {

using Eigen::VectorXd;

constexpr std::array every_outcome{
    Outcome::converged,          Outcome::too_many_iterations, Outcome::cycling,
    Outcome::singular_matrix,    Outcome::not_finite,          Outcome::geometry_unsettled,
    Outcome::friction_unsettled, Outcome::status_unsettled,    Outcome::pressed_afar,
    Outcome::interrupted};

TEST(AStepReport, HasAWordOfItsOwnForEachOutcomeAndCriterion) {
  std::set<std::string_view> words;
  for (const auto outcome : every_outcome)
    words.insert(to_string(outcome));
  EXPECT_EQ(words.size(), every_outcome.size());
  EXPECT_FALSE(words.contains(""));
  words.clear();
  for (const auto criterion :
       {Criterion::residual, Criterion::status, Criterion::gap, Criterion::projection, Criterion::point_lost,
        Criterion::distance, Criterion::singular, Criterion::geometry_loop, Criterion::friction_loop})
    words.insert(to_string(criterion));
  EXPECT_EQ(words.size(), 9U);
  EXPECT_FALSE(words.contains(""));
}

TEST(AStepReport, NamesTheLevelThatCameToNoEnd) {
  EXPECT_EQ(level_of(Outcome::geometry_unsettled), "geometry");
  EXPECT_EQ(level_of(Outcome::friction_unsettled), "friction");
  EXPECT_EQ(level_of(Outcome::status_unsettled), "status");
  EXPECT_EQ(level_of(Outcome::cycling), "status");
  EXPECT_EQ(level_of(Outcome::too_many_iterations), "newton");
  EXPECT_EQ(level_of(Outcome::singular_matrix), "newton");
}

TEST(AStepReport, FailsUnlessItConvergedOrWasInterrupted) {
  for (const auto outcome : every_outcome) {
    StepReport report;
    report.outcome = outcome;
    EXPECT_EQ(report.converged(), outcome == Outcome::converged);
    EXPECT_EQ(report.failed(), outcome != Outcome::converged && outcome != Outcome::interrupted)
        << to_string(outcome);
  }
}

TEST(AStepReport, NamesTheFirstPointThatChangedAndHowManyDid) {
  StepReport report;
  name_status_changes(report);
  EXPECT_TRUE(report.unmet.empty());
  report.status_changes = 7;
  report.changing_points = {{2, 31, contact::Status::open, contact::Status::slip}, {0, 4, {}, {}}};
  name_status_changes(report);
  ASSERT_EQ(report.unmet.size(), 1U);
  EXPECT_EQ(report.unmet[0].criterion, Criterion::status);
  EXPECT_EQ(report.unmet[0].zone, 2);
  EXPECT_EQ(report.unmet[0].node, 31);
  EXPECT_EQ(report.unmet[0].count, 7);
  EXPECT_EQ(report.unmet_by(Criterion::status), &report.unmet[0]);
  EXPECT_EQ(report.unmet_by(Criterion::gap), nullptr);
}

StepReport with_residual(double residual, Outcome outcome = Outcome::too_many_iterations) {
  StepReport report;
  report.outcome = outcome;
  report.residual = residual;
  report.tolerance = 1e-8;
  report.worst_node = 5;
  report.unmet = {{Criterion::gap}};
  name_residual_growth(report);
  return report;
}

TEST(AStepReport, NamesTheResidualThatIsBeyondItsTolerance) {
  EXPECT_EQ(with_residual(1e-8).unmet_by(Criterion::residual), nullptr);
  for (const double residual : {1.1e-8, std::numeric_limits<double>::quiet_NaN()}) {
    const auto report = with_residual(residual);
    ASSERT_NE(report.unmet_by(Criterion::residual), nullptr) << residual;
    EXPECT_EQ(report.unmet.back().node, 5);
    EXPECT_EQ(report.unmet.back().allowed, 1e-8);
  }
}

TEST(AStepReport, NamesASingularMatrixFirst) {
  const auto report = with_residual(1, Outcome::singular_matrix);
  ASSERT_EQ(report.unmet.size(), 3U);
  EXPECT_EQ(report.unmet[0].criterion, Criterion::singular);
  EXPECT_EQ(report.unmet[1].criterion, Criterion::gap);
}

TEST(TheWorstNodes, AreThoseOfTheLargestEntries) {
  const std::array<mesh::NodeIndex, 6> nodes{3, 3, 8, 8, 1, 1};
  const auto worst = worst_nodes((VectorXd(6) << 1, -4, 0, 0, 6, 2).finished(), nodes, 2);
  ASSERT_EQ(worst.size(), 2U) << "node 8 is in balance";
  EXPECT_EQ(worst[0].node, 1);
  EXPECT_EQ(worst[0].residual, 3);
  EXPECT_EQ(worst[1].node, 3);
  EXPECT_EQ(worst[1].residual, 2);
}

TEST(TheWorstNodes, BeginWithThoseThatAreNotFinite) {
  const std::array<mesh::NodeIndex, 4> nodes{3, 4, 5, 5};
  const auto worst = worst_nodes((VectorXd(4) << 1e300, NAN, 2, -INFINITY).finished(), nodes, 1);
  ASSERT_EQ(worst.size(), 3U);
  EXPECT_EQ(worst[0].node, 4);
  EXPECT_EQ(worst[0].residual, INFINITY);
  EXPECT_EQ(worst[1].node, 5);
  EXPECT_EQ(worst[2].node, 3);
}

TEST(TheWorstNodes, AreFiveAtMostAndInTheirOrderWhereTheyAreEqual) {
  const std::array<mesh::NodeIndex, 7> nodes{6, 5, 4, 3, 2, 1, 0};
  const auto worst = worst_nodes(VectorXd::Ones(7), nodes, 1);
  ASSERT_EQ(worst.size(), 5U);
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(worst[static_cast<std::size_t>(i)].node, i);
}

TEST(AStall, IsAResidualThatIsNotHalved) {
  StallWatch watch;
  EXPECT_FALSE(watch.stalls(1)) << "the first one has none before it";
  EXPECT_FALSE(watch.stalls(0.5));
  EXPECT_TRUE(watch.stalls(0.26));
  EXPECT_FALSE(watch.stalls(0.13)) << "held against the one before, not against the best";
  EXPECT_TRUE(watch.stalls(1));
}

} // namespace
} // namespace rubato::step::report_test
