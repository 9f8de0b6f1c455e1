// SPDX-License-Identifier: LGPL-3.0-or-later
// An attempt that fails names the criterion that is not met and the point where it is furthest from it.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/step/common/contact_evaluator.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"

namespace rubato::step::unmet_test {
namespace {

/// A block on a plane after one step, and its contact there, which tests spoil.
class Spoilt : public testing::Test {
protected:
  Spoilt() : walk_(test::block_on_plane), held_(walk_.model.zones.size()) {
    EXPECT_TRUE(walk_.advance());
    system_.emplace(make_effective_system(walk_.model, walk_.scheme, walk_.length()));
    side_.emplace(walk_.model, walk_.scheme, *system_, walk_.state(), RetrySettings{});
    before_ = side_->at(walk_.state(), held_);
    now_ = before_;
    while (now_.status[0][point_] == contact::Status::open)
      ++point_;
  }

  contact::PointEvaluation& spoilt(std::size_t further = 0) { return now_.points[0][point_ + further]; }
  mesh::NodeIndex node(std::size_t further = 0) const {
    return walk_.model.zones[0].points[point_ + further].nodes.front();
  }
  StepReport report() const {
    StepReport report;
    side_->collect_status_changes(held_, before_, now_, report);
    side_->name_unmet(held_, &before_, now_, report);
    return report;
  }
  bool settled() const { return side_->settled(held_, before_, now_); }

  test::Walk walk_;
  std::optional<EffectiveSystem> system_;
  Frozen held_;
  std::optional<ContactEvaluator> side_;
  ContactIterate before_, now_;
  std::size_t point_ = 0;
};

TEST_F(Spoilt, NothingIsNamedWhereContactIsSettled) {
  EXPECT_TRUE(settled());
  EXPECT_TRUE(report().unmet.empty());
}

TEST_F(Spoilt, AGapThatIsNotClosedIsNamedWithItsWorstPoint) {
  spoilt().variables.gap = 1e-4;
  spoilt(1).variables.gap = -3e-4;
  EXPECT_FALSE(settled());
  const auto unmet = report().unmet;
  ASSERT_EQ(unmet.size(), 1U);
  EXPECT_EQ(unmet[0].criterion, Criterion::gap);
  EXPECT_EQ(unmet[0].zone, 0);
  EXPECT_EQ(unmet[0].node, node(1));
  EXPECT_DOUBLE_EQ(unmet[0].value, 3e-4);
  EXPECT_GT(unmet[0].allowed, 0);
  EXPECT_LT(unmet[0].allowed, 1e-4);
  EXPECT_EQ(unmet[0].count, 2);
}

TEST_F(Spoilt, AGapThatIsNoNumberIsNotClosed) {
  spoilt().variables.gap = std::numeric_limits<double>::quiet_NaN();
  spoilt(1).variables.gap = 1;
  EXPECT_FALSE(settled());
  EXPECT_EQ(report().unmet_by(Criterion::gap)->count, 2);
}

TEST_F(Spoilt, AProjectionThatMovesIsNamed) {
  spoilt().pair.projection.clamped[0] += 0.125;
  EXPECT_FALSE(settled());
  const auto unmet = report().unmet;
  ASSERT_EQ(unmet.size(), 1U);
  EXPECT_EQ(unmet[0].criterion, Criterion::projection);
  EXPECT_EQ(unmet[0].node, node());
  EXPECT_DOUBLE_EQ(unmet[0].value, 0.125);
}

TEST_F(Spoilt, APointThatLostItsMasterFaceIsNamed) {
  spoilt().kinematics.reset();
  spoilt().pair = {};
  now_.status[0][point_] = contact::Status::open;
  const auto unmet = report().unmet;
  ASSERT_EQ(unmet.size(), 2U);
  EXPECT_EQ(unmet[0].criterion, Criterion::point_lost);
  EXPECT_EQ(unmet[0].zone, 0);
  EXPECT_EQ(unmet[0].node, node());
  EXPECT_EQ(unmet[1].criterion, Criterion::status);
  EXPECT_EQ(unmet[1].node, node());
  EXPECT_EQ(unmet[1].count, 1);
}

/// All points are in contact before the first step, those that nothing faces too: none of these is lost.
TEST(APointThatNothingEverFaced, IsNotLost) {
  test::Walk walk(test::block_on_plane, {{"mesh.generate.1.rectangle.from", "[0.4, -1]"}});
  auto system = make_effective_system(walk.model, walk.scheme, walk.length());
  const ContactEvaluator side(walk.model, walk.scheme, system, walk.state(), {});
  const Frozen held(walk.model.zones.size());
  const auto now = side.at(walk.state(), held);
  EXPECT_FALSE(now.points[0].front().kinematics && now.points[0].back().kinematics);
  StepReport report;
  side.name_unmet(held, nullptr, now, report);
  EXPECT_EQ(report.unmet_by(Criterion::point_lost), nullptr);
}

StepReport failure_of(const std::vector<deck::Setting>& changes) {
  auto all = changes;
  all.push_back({"time.on_failure.levels", "0"});
  test::Walk walk(test::two_beams, all);
  EXPECT_FALSE(walk.to_end());
  return walk.reports.back();
}

TEST(ASingularMatrix, IsNamed) {
  StepReport report;
  report.outcome = Outcome::singular_matrix;
  name_residual_growth(report);
  ASSERT_EQ(report.unmet.size(), 1U);
  EXPECT_EQ(report.unmet[0].criterion, Criterion::singular);
}

TEST(ForcesOutOfBalance, AreNamedWithTheWorstNode) {
  const auto report = failure_of({{"newton.residual", "1e-300"}, {"newton.max_iterations", "3"}});
  const auto* residual = report.unmet_by(Criterion::residual);
  ASSERT_NE(residual, nullptr);
  EXPECT_GE(residual->node, 0);
  EXPECT_EQ(residual->value, report.residual);
  EXPECT_EQ(residual->allowed, 1e-300);
}

TEST(ALoopThatComesToNoEnd, IsNamedWithItsLastChange) {
  const auto geometry = failure_of(
      {{"contact.interface.iterate", "{geometry: {by: fixed_point, tolerance: 1e-14, max_loops: 2}}"}});
  ASSERT_EQ(geometry.outcome, Outcome::geometry_unsettled);
  ASSERT_NE(geometry.unmet_by(Criterion::geometry_loop), nullptr);
  EXPECT_EQ(geometry.unmet_by(Criterion::geometry_loop)->value, geometry.rounds.back().change);
  EXPECT_GE(geometry.unmet_by(Criterion::geometry_loop)->node, 0);

  const auto friction =
      failure_of({{"contact.interface.iterate", "{friction: {by: fixed_point, max_loops: 1}}"}});
  ASSERT_EQ(friction.outcome, Outcome::friction_unsettled);
  const auto* unmet = friction.unmet_by(Criterion::friction_loop);
  ASSERT_NE(unmet, nullptr);
  EXPECT_EQ(unmet->zone, 0);
  EXPECT_GE(unmet->node, 0);
  EXPECT_EQ(unmet->value, friction.rounds.back().change);
}

} // namespace
} // namespace rubato::step::unmet_test
