// SPDX-License-Identifier: LGPL-3.0-or-later
// Energy of bodies that overlap when a run begins.
#include "rubato/contact/zone.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/step/overlap.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace rubato::step::overlap_test {
namespace {

using Eigen::Vector3d;
using test::Walk;

constexpr double depth = 0.02;

/// A block of height 1.02, held at its top, that begins 0.02 deep in one of height 1; both are 2 wide. Of the
/// five nodes of its foot the first one is excluded.
const std::string overlapping = R"(
mesh:
  generate:
    - {name: low, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [4, 2], sides: {bottom: ground, top: over}}
    - {name: high, rectangle: {from: [0, 0.98], to: [2, 2]}, divisions: [4, 2],
       sides: {bottom: under, top: roof}, points: {left_bottom: corner}}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0}}
supports: [{on: ground, fix: [x, y]}, {on: roof, fix: [x, y]}]
contact: {fit: {master: over, slave: under, integration: nodes, exclude_nodes: [corner]}}
time: {scheme: static, step: 1, end: 1}
)";

class Overlapping : public testing::Test {
protected:
  /// The start, or some other state, with these outcomes of the zone's points.
  static State with(State state, const std::vector<contact::PointOutcome>& outcomes) {
    state.zones[0].outcomes = outcomes;
    return state;
  }
  /// A force of 50 along a normal, at a gap.
  static contact::PointOutcome pressed(double gap) { return {.gap = gap, .normal = Vector3d(30, 40, 0)}; }
  static contact::PointOutcome open(double gap) { return {.gap = gap}; }

  Walk exact_{overlapping};
  Walk soft_{overlapping, {{"contact.fit.method", "penalty"}}};
};

TEST_F(Overlapping, PointsStandAsDeepAsTheyAreInTheBodyTheyFace) {
  const auto overlaps = overlaps_of(exact_.model, exact_.state());
  ASSERT_EQ(overlaps.size(), 1U);
  ASSERT_EQ(overlaps[0].size(), 5U);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(overlaps[0][i], exact_.model.zones[0].points[i].excluded ? 0 : depth, 1e-15);
  EXPECT_EQ(std::ranges::count(overlaps[0], 0.0), 1);
}

TEST_F(Overlapping, DepthIsOfTheStateAndNoneWhereBodiesAreApart) {
  auto state = exact_.state();
  for (const auto node : exact_.model.zones[0].slave.nodes)
    state.motion.u[exact_.model.dofs.dof(node, 1)] = 0.015;
  EXPECT_NEAR(overlaps_of(exact_.model, state)[0][2], 0.005, 1e-15);
  for (const auto node : exact_.model.zones[0].slave.nodes)
    state.motion.u[exact_.model.dofs.dof(node, 1)] = 0.025;
  EXPECT_TRUE(overlaps_of(exact_.model, state).empty());
}

TEST_F(Overlapping, PointsThatPressAlreadyHaveGivenTheirEnergy) {
  std::vector<contact::PointOutcome> outcomes(5);
  outcomes[3] = pressed(-depth);
  const auto overlaps = overlaps_of(soft_.model, with(soft_.state(), outcomes));
  EXPECT_EQ(overlaps[0][3], 0);
  EXPECT_NEAR(overlaps[0][2], depth, 1e-15);
}

/// Half of the force over the way that the step closes.
TEST_F(Overlapping, GiveHalfTheForceTimesTheWay) {
  const Overlaps overlaps{{0, depth, depth, 0, 0}};
  auto state = with(exact_.state(), {open(0), pressed(0), open(0), pressed(0), open(0)});
  state.moved_out = {{depth, depth, depth, depth, depth}};
  EXPECT_NEAR(work_of_overlaps(exact_.model, overlaps, state), 0.5 * 50 * depth, 1e-14);
  state.moved_out = {{0, 0.75 * depth, 0, 0, 0}};
  EXPECT_NEAR(work_of_overlaps(exact_.model, overlaps, state), 0.5 * 50 * 0.75 * depth, 1e-14);
}

TEST_F(Overlapping, GiveSpringsWhatTheyKeep) {
  const Overlaps overlaps{{0, depth, 0, 0, 0}};
  auto state = with(soft_.state(), {open(0), pressed(-0.25 * depth), open(0), open(0), open(0)});
  state.moved_out = {{0, 0.75 * depth, 0, 0, 0}};
  EXPECT_NEAR(work_of_overlaps(soft_.model, overlaps, state), 0.5 * 50 * depth, 1e-14);
  state.moved_out = {{}};
  EXPECT_NEAR(work_of_overlaps(soft_.model, overlaps, state), 0.5 * 50 * 0.25 * depth, 1e-14);
}

/// A point that went elsewhere has come a way that tells nothing of its overlap.
TEST_F(Overlapping, GiveNoMoreThanTwiceTheirDepthAndTakeNothing) {
  const Overlaps overlaps{{0, depth, 0, 0, 0}};
  auto state = with(exact_.state(), {open(0), pressed(0), open(0), open(0), open(0)});
  state.moved_out = {{0, 5 * depth, 0, 0, 0}};
  EXPECT_NEAR(work_of_overlaps(exact_.model, overlaps, state), 0.5 * 50 * 2 * depth, 1e-14);
  state.moved_out = {{0, -depth, 0, 0, 0}};
  EXPECT_EQ(work_of_overlaps(exact_.model, overlaps, state), 0);
}

/// The first point presses on; the second lets go, the third had no overlap, the fourth faces nothing.
TEST_F(Overlapping, GiveMoreWhereTheyAreThrownApart) {
  const Overlaps overlaps{{depth, depth, 0, depth, depth}};
  const std::vector before{pressed(0), pressed(0), pressed(0), pressed(0), open(0)};
  const std::vector after{pressed(depth), open(depth), open(depth),
                          open(std::numeric_limits<double>::infinity()), open(depth)};
  EXPECT_NEAR(
      work_of_rebound(exact_.model, overlaps, with(exact_.state(), before), with(exact_.state(), after)),
      0.5 * 50 * depth, 1e-14);
}

/// What closes 0.01 of a spring's own compression is in the spring's account.
TEST_F(Overlapping, GiveSpringsThatLetGoTheWayBeyondTheirRest) {
  const Overlaps overlaps{{0, depth, depth, 0, 0}};
  const std::vector before{open(0), pressed(-0.01), pressed(-0.01), open(0), open(0)};
  const std::vector after{open(0), open(0.03), open(-0.005), open(0), open(0)};
  EXPECT_NEAR(work_of_rebound(soft_.model, overlaps, with(soft_.state(), before), with(soft_.state(), after)),
              0.5 * 50 * 0.03, 1e-14);
  EXPECT_NEAR(
      work_of_rebound(exact_.model, overlaps, with(exact_.state(), before), with(exact_.state(), after)),
      0.5 * 50 * (0.04 + 0.005), 1e-14)
      << "an exact contact pressed where it was";
}

/// Two bars in a row of stiffness 2 E/1 and 2 E/1.02 are pressed together by 0.02: all that they hold then
/// has come from the overlap.
TEST_F(Overlapping, HoldInTheEndWhatTheOverlapGave) {
  Walk walk(overlapping, {{"contact.fit.exclude_nodes", "~"}});
  const auto overlaps = overlaps_of(walk.model, walk.state());
  ASSERT_TRUE(walk.to_end());
  const double force = depth / (1 / 2e6 + 1.02 / 2e6);
  EXPECT_NEAR(work_of_overlaps(walk.model, overlaps, walk.state()), 0.5 * force * depth,
              1e-8 * force * depth);
  const auto& u = walk.state().motion.u;
  EXPECT_NEAR(0.5 * u.dot(walk.state().bulk.internal), 0.5 * force * depth, 1e-8 * force * depth);
}

} // namespace
} // namespace rubato::step::overlap_test
