// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact as a law of velocities: what moreau_jean asks of points that touch.
#include "rubato/contact/velocity_frames.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/step/common/contact_evaluator.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::velocity_contact_test {
namespace {

using Changes = std::vector<deck::Setting>;
using Eigen::VectorXd;

const Changes by_velocities{
    {"time.scheme", "moreau_jean"}, {"time.alpha", ""}, {"time.contact_mass", "consistent"}};

Changes with(Changes changes, const Changes& more) {
  changes.insert(changes.end(), more.begin(), more.end());
  return changes;
}

/// SDNL140's beams, touching all along and falling towards each other at −2 up and sideways at 3.
struct Approaching : testing::Test {
  test::Walk walk{test::two_beams, with(by_velocities, {{"contact.interface.restitution", "0.25"},
                                                        {"contact.interface.exclude_nodes", "[]"}})};
  VectorXd velocity = VectorXd::Zero(walk.model.dofs.dof_count);
  const double h = 0.1;
  const double theta = 0.6;

  void SetUp() override {
    for (const auto node : walk.model.zones[0].master.nodes) {
      velocity[walk.model.dofs.dof(node, 0)] = 3;
      velocity[walk.model.dofs.dof(node, 1)] = speed;
    }
  }
  double speed = -2;

  /// Gap and slip after a step of velocities v₁ = `end` × the velocity at the start.
  contact::PointState after(double end, const contact::VelocityLaw& law) {
    const auto& model = walk.model;
    const VectorXd rest = VectorXd::Zero(velocity.size());
    auto discretisation = contact::make_discretisation(model.zones[0]);
    std::vector<double> standing(model.zones[0].points.size());
    const auto frames = contact::velocity_frames(discretisation, {&model.mesh, &model.dofs, &rest, &rest},
                                                 velocity, law, standing);
    const VectorXd moved = law.step * (law.theta * end + (1 - law.theta)) * velocity;
    const auto points = contact::evaluate_in_frozen_frames(frames, model.zones[0],
                                                           VectorXd::Zero(model.zones[0].multiplier_count()),
                                                           {&model.mesh, &model.dofs, &moved, &rest});
    return points[5].variables;
  }
};

TEST_F(Approaching, GapIsTheVelocityBeyondTheRebound) {
  for (const double end : {1., 0., -0.25, -3.})
    EXPECT_NEAR(after(end, {h, theta, false}).gap, h * theta * (end * speed - 0.25 * 2), 1e-14) << end;
}

TEST_F(Approaching, SlipIsTheVelocityAtTheEnd) {
  for (const double end : {1., 0., -2.})
    EXPECT_NEAR(std::abs(after(end, {h, theta, false}).slip[0]), h * theta * std::abs(end) * 3, 1e-14) << end;
}

TEST_F(Approaching, GapOfSurfacesWithoutMassIsWhatTheyMove) {
  EXPECT_NEAR(after(0.5, {h, 0.5, true}).gap, h * 0.75 * speed, 1e-14);
  EXPECT_NEAR(std::abs(after(0.5, {h, 0.5, true}).slip[0]), h * 0.75 * 3, 1e-14);
}

TEST_F(Approaching, GapOfSurfacesThatPartIsWhatTheyMove) {
  velocity *= -1;
  EXPECT_NEAR(after(0.5, {h, 0.5, false}).gap, -h * 0.75 * speed, 1e-14);
}

/// The surfaces apart, and which points touch in a step then.
struct Apart : Approaching {
  const double gap = 1e-3;
  std::vector<double> standing = std::vector<double>(walk.model.zones[0].points.size());

  std::vector<contact::PointEvaluation> frames(double step, bool massless = false) {
    const auto& model = walk.model;
    VectorXd apart = VectorXd::Zero(velocity.size());
    for (const auto node : model.zones[0].slave.nodes)
      apart[model.dofs.dof(node, 1)] = -gap;
    auto discretisation = contact::make_discretisation(model.zones[0]);
    return contact::velocity_frames(discretisation, {&model.mesh, &model.dofs, &apart, &apart}, velocity,
                                    {step, theta, massless}, standing);
  }
};

TEST_F(Apart, PointsThatDoNotArriveInTheFirstHalfOfTheStepAreOpen) {
  for (const auto& point : frames(0.99e-3))
    EXPECT_FALSE(point.kinematics.has_value());
}

/// They count their gap, and are no farther than the surface at the end of the step.
TEST_F(Apart, PointsWithoutMassThatDoNotArriveMayStillClose) {
  for (const auto& point : frames(0.99e-3, true)) {
    ASSERT_TRUE(point.kinematics.has_value());
    EXPECT_EQ(point.kinematics->gap_origin, 0);
    EXPECT_NEAR(point.kinematics->gap, gap, 1e-15);
  }
  EXPECT_EQ(standing[5], 0);
}

TEST_F(Apart, PointsThatArriveInTheFirstHalfStandWhereTheyAre) {
  for (const auto& point : frames(1.01e-3))
    EXPECT_TRUE(point.kinematics.has_value());
  EXPECT_NEAR(standing[5], gap, 1e-15);
  velocity.setZero();
  for (const auto& point : frames(1e-3))
    EXPECT_TRUE(point.kinematics.has_value());
  standing.assign(standing.size(), gap / 2);
  for (const auto& point : frames(1e-3))
    EXPECT_FALSE(point.kinematics.has_value());
}

/// Surfaces without mass, before a step of half the length of the last one, in which the master came down at
/// a mean of 1 and stopped: again so fast it arrives in the first half of the step, half as fast it does not.
TEST(MasslessSurfaces, ComeByTheMeanVelocityOfTheLastStepWhateverTheLengthOfTheNext) {
  constexpr double last = 2e-3;
  constexpr double next = last / 2;
  constexpr double gap = 0.75 * next / 2;
  const test::Walk walk(test::two_beams, {{"time.scheme", "moreau_jean"}, {"time.alpha", ""}});
  const auto& model = walk.model;
  ASSERT_FALSE(model.massless_nodes.empty());
  State state = walk.state();
  for (const auto node : model.zones[0].slave.nodes)
    state.motion.u[model.dofs.dof(node, 1)] -= gap;
  state.motion.v.setZero();
  state.motion.a.setZero();
  for (const auto node : model.zones[0].master.nodes)
    state.motion.a[model.dofs.dof(node, 1)] = 1 / ((1 - walk.scheme.beta) * last);
  const auto arriving = [&](double length) {
    state.step = length;
    auto system = make_effective_system(model, walk.scheme, next);
    const ContactEvaluator side(model, walk.scheme, system, state, {});
    const auto points = side.at(state, Frozen(1)).points[0];
    return std::ranges::count_if(points, [](const auto& point) { return point.variables.gap < 1e-12; });
  };
  EXPECT_GT(arriving(last), 0);
  EXPECT_EQ(arriving(next), 0) << "the same change of velocity in half the time: half the mean";
}

struct RunContext {
  EnergyLedger end;
  double least_impact = 0;   ///< of a step
  double least_friction = 0; ///< of a step
  double largest = 0;
  VectorXd u;
};

RunContext course_of(const Changes& changes) {
  test::Walk walk(test::two_beams, changes);
  EnergyAccount account(walk.model, walk.scheme, walk.state());
  RunContext course;
  walk.accepted = [&] {
    const auto before = account.ledger();
    account.enter(walk.before, walk.state());
    const auto& now = account.ledger();
    course.least_impact = std::min(course.least_impact, now.impact - before.impact);
    course.least_friction = std::min(course.least_friction, now.friction - before.friction);
    course.largest = std::max(course.largest, now.largest());
    EXPECT_LE(std::abs(now.balance()), 1e-10 * course.largest);
  };
  EXPECT_TRUE(walk.to_end());
  course.end = account.ledger();
  course.u = walk.state().motion.u;
  return course;
}

const Changes rubbing = with(by_velocities, {{"time.step", "2e-4"}, {"time.end", "0.04"}});

TEST(MoreauJean, NeverGainsFromPressures) {
  const auto course = course_of(rubbing);
  EXPECT_GE(course.least_impact, -1e-12 * course.largest);
  EXPECT_GT(course.end.impact, 1e-4 * course.largest);
  EXPECT_NEAR(course.end.numerical, 0, 1e-9 * course.largest);
}

/// A pressure that closes a gap takes energy: less than impacts take where the surface has mass, and none is
/// given.
TEST(MoreauJean, LosesLittleButFrictionOnSurfacesWithoutMass) {
  const auto course = course_of(with(rubbing, {{"time.contact_mass", "redistributed"}}));
  EXPECT_LT(course.end.impact, 2e-3 * course.largest);
  EXPECT_GE(course.least_impact, -1e-12 * course.largest);
  EXPECT_NEAR(course.end.numerical, 0, 1e-9 * course.largest);
  EXPECT_GE(course.least_friction, -1e-12 * course.largest);
  EXPECT_GT(course.end.friction, 0.01 * course.largest);
}

/// What the bulk loses beyond the middle is the scheme's.
TEST(MoreauJean, LosesBeyondTheMiddle) {
  const auto course = course_of(with(rubbing, {{"time.theta", "0.7"}}));
  EXPECT_GE(course.least_impact, -1e-12 * course.largest);
  EXPECT_GT(course.end.numerical, 1e-3 * course.largest);
}

TEST(MoreauJean, GivesTheSameCondensedAndWhole) {
  const Changes shorter = with(rubbing, {{"time.end", "0.01"}});
  for (const std::string mass : {"consistent", "redistributed"}) {
    const auto condensed = course_of(with(shorter, {{"time.contact_mass", mass}}));
    const auto whole = course_of(with(shorter, {{"time.contact_mass", mass}, {"solver", "full"}}));
    EXPECT_LT((condensed.u - whole.u).lpNorm<Eigen::Infinity>(), 1e-10 * whole.u.lpNorm<Eigen::Infinity>())
        << mass;
  }
}

TEST(MoreauJean, GivesTheSameByEveryExactMethodWithoutFriction) {
  const Changes smooth = with(
      rubbing,
      {{"time.end", "0.01"}, {"contact.interface.friction", "0"}, {"time.contact_mass", "redistributed"}});
  const auto mixed = course_of(smooth);
  for (const std::string method : {"nodal_lagrange", "nodal_pcg"}) {
    const auto nodal = course_of(with(smooth, {{"contact.interface.method", method}}));
    EXPECT_LT((nodal.u - mixed.u).lpNorm<Eigen::Infinity>(), 1e-8 * mixed.u.lpNorm<Eigen::Infinity>())
        << method;
  }
}

} // namespace
} // namespace rubato::step::velocity_contact_test
