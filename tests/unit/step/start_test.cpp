// SPDX-License-Identifier: LGPL-3.0-or-later
/// How a run begins: loads that are there from the first instant, and runs that go on from others.
#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include "unit/step/decks.hpp"
#include "unit/step/walk.hpp"

namespace rubato::step {
namespace {

using test::Walk;

const std::vector<deck::Setting> static_step{
    {"time.scheme", "static"}, {"time.alpha", "~"}, {"time.step", "1"}, {"time.end", "1"}};

std::vector<deck::Setting> and_static(std::vector<deck::Setting> changes) {
  changes.insert(changes.end(), static_step.begin(), static_step.end());
  return changes;
}

double deflection_after_one_step(const char* start) {
  Walk walk(test::two_beams, {{"contact", "~"}, {"time.start", start}});
  EXPECT_TRUE(walk.advance());
  return walk.displacement(walk.node_at(1, 0.1), 1);
}

/// −0.0229 is Code_Aster's, −0.0307 the scheme's own.
TEST(FirstStep, CountsTheLoadThatIsThereFromTheStart) {
  EXPECT_NEAR(deflection_after_one_step("consistent"), -0.0307, 5e-5);
}

TEST(FirstStep, TakesTheStartAsUnloadedWhenAskedTo) {
  EXPECT_NEAR(deflection_after_one_step("at_rest_unloaded"), -0.022942, 5e-7);
}

TEST(InitialState, HasTheAccelerationOfItsLoad) {
  const Walk walk(test::two_beams);
  const auto& model = walk.model;
  const Eigen::VectorXd balance = model.mass * walk.state.motion.a - model::external_force(model, 0);
  const double load = 1e7;
  for (const auto dof : model.free_dofs)
    EXPECT_NEAR(balance[dof], 0, 1e-9 * load);
  for (const auto& constraint : model.constraints)
    EXPECT_EQ(walk.state.motion.a[constraint.dof], 0);
}

TEST(StaticSteps, FindTheEquilibriumInOneSolveWhenNothingTouches) {
  Walk walk(test::two_beams, and_static({{"contact", "~"}}));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.back().iterations, 1);
  const Eigen::VectorXd unbalance =
      walk.model.stiffness * walk.state.motion.u - model::external_force(walk.model, 1);
  for (const auto dof : walk.model.free_dofs)
    EXPECT_NEAR(unbalance[dof], 0, 1e-9 * 1e7);
  EXPECT_EQ(walk.state.motion.v.norm(), 0);
}

/// A beam bent, let go: no load, so it starts with K u as its unbalance and not from rest.
TEST(ContinuedState, KeepsTheShapeAndTakesItsAccelerationFromTheNewBalance) {
  Walk bent(test::two_beams, and_static({{"contact", "~"}}));
  ASSERT_TRUE(bent.to_end());
  Walk released(test::two_beams, {{"contact", "~"}, {"loads", "~"}});
  const auto state = continued_state(released.model, released.scheme, bent.state, 0);
  EXPECT_EQ(state.t, 0);
  EXPECT_EQ(state.motion.u, bent.state.motion.u);
  const Eigen::VectorXd balance =
      released.model.mass * state.motion.a + released.model.stiffness * state.motion.u;
  for (const auto dof : released.model.free_dofs)
    EXPECT_NEAR(balance[dof], 0, 1e-9 * 1e7);
}

/// Held by the same load, a static equilibrium stays one.
TEST(ContinuedState, OfAnEquilibriumStaysAtRestWithItsContactForces) {
  const std::vector<deck::Setting> gentle{{"loads.0.nodal_force.y", "-1e5"}};
  Walk pressed(test::two_beams, and_static(gentle));
  ASSERT_TRUE(pressed.to_end());
  ASSERT_GT(pressed.resultants().in_contact, 0);
  Walk held(test::two_beams, gentle);
  held.state = continued_state(held.model, held.scheme, pressed.state, 0);
  const auto tip = held.node_at(1, 0.1);
  const double deflection = held.displacement(tip, 1);
  ASSERT_TRUE(held.to_end());
  EXPECT_NEAR(held.displacement(tip, 1), deflection, 1e-6 * std::abs(deflection));
}

} // namespace
} // namespace rubato::step
