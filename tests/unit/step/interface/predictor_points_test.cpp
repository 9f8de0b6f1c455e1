// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which points the guess of a step's contact follows, and what becomes of those that lose their master.
#include "rubato/model/model.hpp"
#include "rubato/step/interface/predictor_points.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <cmath>

namespace rubato::step::predictor_points_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// The first component of the first node moves its gap.
PredictorPoint point_with(std::size_t index, double gap, double force) {
  PredictorPoint point;
  point.index = index;
  point.stencil.nodes = {{.at = {static_cast<int>(index), -1, -1}, .weight = 1}};
  point.gap = gap;
  point.value[0] = gap;
  point.force[0] = force;
  return point;
}

TEST(GuessPoints, AreFollowedWhereTheyPressPenetrateOrComeHalfWay) {
  const std::vector points{point_with(0, 1, 0),  // stays
                           point_with(1, 1, 0),  // comes by less than half
                           point_with(2, 1, 0),  // by more
                           point_with(3, -1, 0), // penetrates
                           point_with(4, -1, 0), // penetrated
                           point_with(5, 1, 7)}; // presses
  const VectorXd d = (VectorXd(6) << 0, -0.4, -0.6, 0.1, 1.1, 5).finished();
  PointsOfZones touching(1, {17});
  find_touching(points, d, touching);
  EXPECT_EQ(touching, (PointsOfZones{{2, 3, 5}}));
}

class PointsOfBeams : public testing::Test {
protected:
  PointsOfBeams() {
    side_.measure(state_, held_, contact_);
    take_points(model_, side_, held_, *system_.compliance, contact_, at_rest_, state_, points_);
  }

  test::Walk walk_{test::two_beams};
  const model::Model& model_ = walk_.model;
  State state_ = walk_.state();
  EffectiveSystem system_ = make_effective_system(model_, walk_.scheme, 1e-3);
  ContactEvaluator side_{model_, walk_.scheme, system_, walk_.state(), {}};
  Frozen held_ = Frozen(1);
  ContactIterate contact_;
  VectorXd at_rest_ = VectorXd::Zero(system_.compliance->size());
  std::vector<PredictorPoint> points_;
};

TEST_F(PointsOfBeams, AreThoseThatFaceTheMasterAndMayTouch) {
  ASSERT_FALSE(points_.empty());
  for (const auto& point : points_) {
    EXPECT_FALSE(model_.zones[0].points[point.index].excluded);
    EXPECT_EQ(measures_of(point, at_rest_)[0], contact_.points[0][point.index].variables.gap);
  }
}

/// In its frame a point's gap is linear in the surface's motion; a new frame there has the exact one.
TEST_F(PointsOfBeams, HaveTheGapOfTheirNewFrame) {
  VectorXd d = at_rest_;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    d[i] = 1e-3 * std::sin(static_cast<double>(i));
    state_.motion.u[system_.compliance->dof_of_interface_dof()[static_cast<std::size_t>(i)]] = d[i];
  }
  PointsOfZones all(1);
  for (const auto& point : points_)
    all[0].push_back(point.index);
  side_.measure(state_, held_, all, contact_);
  move_frames(model_, side_, held_, *system_.compliance, contact_, d, all, points_);
  for (const auto& point : points_) {
    const double gap = contact_.points[0][point.index].kinematics->gap;
    EXPECT_EQ(point.gap, gap);
    EXPECT_NEAR(measures_of(point, d)[0], gap, 1e-15);
  }
}

TEST_F(PointsOfBeams, LoseTheirForceWithTheirMaster) {
  const PointsOfZones lost{{points_[3].index}};
  contact_.points[0][points_[3].index].kinematics.reset();
  for (auto& point : points_)
    point.force = Vector3d(2, 0.1, 0);
  move_frames(model_, side_, held_, *system_.compliance, contact_, at_rest_, lost, points_);
  EXPECT_EQ(points_[3].force, Vector3d::Zero());
  EXPECT_EQ(measures_of(points_[3], at_rest_)[0], INFINITY);
  EXPECT_EQ(points_[2].force, Vector3d(2, 0.1, 0));
}

} // namespace
} // namespace rubato::step::predictor_points_test
