// SPDX-License-Identifier: LGPL-3.0-or-later
/// How a run begins: loads that are there from the first instant, and runs that go on from others.
#include "rubato/constraint/reduction.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/start.hpp"

#include <Eigen/SparseCholesky>
#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <string>

namespace rubato::step::start_test {
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
  const Eigen::VectorXd balance = model.mass * walk.state().motion.a - model::external_force(model, 0);
  const double load = 1e7;
  for (const auto dof : model.reduction.free_dofs())
    EXPECT_NEAR(balance[dof], 0, 1e-9 * load);
  for (const auto& support : model.reduction.prescribed())
    EXPECT_EQ(walk.state().motion.a[support.dof], 0);
}

/// One square between springs, of mass 2 and stiffness 8 in all, that cannot deform along x: an oscillator.
const std::string slider = R"(
mesh: {generate: [{name: body, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [1, 1]}]}
physics: plane_stress
materials: {stone: {young: 1e3, poisson: 0, density: 2, rayleigh: {mass: 0.25}}}
supports: [{on: body, fix: y}]
springs: [{on: body, x: 2}]
initial: [{on: all, displacement: {x: 0.5}, velocity: {x: 3}}]
time: {scheme: newmark, step: 1e-3, end: 1}
)";

/// 2 a + ¼ · 2 v + 8 u = 0.
TEST(InitialMotion, HasTheAccelerationOfItsSpringsAndItsDamping) {
  const Walk walk(slider);
  for (const auto node : walk.model.dofs.nodes) {
    const auto dof = walk.model.dofs.dof(node, 0);
    EXPECT_EQ(walk.state().motion.u[dof], 0.5);
    EXPECT_EQ(walk.state().motion.v[dof], 3);
    EXPECT_NEAR(walk.state().motion.a[dof], -(0.25 * 3 + 4 * 0.5), 1e-12);
  }
}

TEST(InitialMotion, SwingsAsTheOscillatorItIs) {
  Walk walk(slider, {{"materials.stone.rayleigh", ""}});
  EnergyAccount account(walk.model, walk.scheme, walk.state());
  EXPECT_NEAR(account.ledger().start, 0.5 * 2 * 9 + 0.5 * 8 * 0.25, 1e-12);
  ASSERT_TRUE(walk.to_end());
  const double t = 1;
  EXPECT_NEAR(walk.displacement(walk.node_at(1, 1), 0), 0.5 * std::cos(2 * t) + 1.5 * std::sin(2 * t), 2e-6);
}

TEST(InitialMotion, LeavesWhatSupportsImposeToThem) {
  const Walk walk(slider, {{"supports", "[{on: body, y: 0.1}]"}});
  for (const auto node : walk.model.dofs.nodes) {
    EXPECT_EQ(walk.state().motion.u[walk.model.dofs.dof(node, 1)], 0.1);
    EXPECT_EQ(walk.state().motion.v[walk.model.dofs.dof(node, 1)], 0);
  }
}

TEST(StaticSteps, FindTheEquilibriumInOneSolveWhenNothingTouches) {
  Walk walk(test::two_beams, and_static({{"contact", "~"}}));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.back().iterations, 1);
  const Eigen::VectorXd residual_force =
      walk.model.domain.initial_tangent() * walk.state().motion.u - model::external_force(walk.model, 1);
  for (const auto dof : walk.model.reduction.free_dofs())
    EXPECT_NEAR(residual_force[dof], 0, 1e-9 * 1e7);
  EXPECT_EQ(walk.state().motion.v.norm(), 0);
}

/// A beam bent, let go: no load, so it starts with K u as its unbalance and not from rest.
TEST(ContinuedState, KeepsTheShapeAndTakesItsAccelerationFromTheNewBalance) {
  Walk bent(test::two_beams, and_static({{"contact", "~"}}));
  ASSERT_TRUE(bent.to_end());
  Walk released(test::two_beams, {{"contact", "~"}, {"loads", "~"}});
  const auto state = continued_state(released.model, released.scheme, bent.state(), 0);
  EXPECT_EQ(state.t, 0);
  EXPECT_EQ(state.motion.u, bent.state().motion.u);
  const Eigen::VectorXd balance =
      released.model.mass * state.motion.a + released.model.domain.initial_tangent() * state.motion.u;
  for (const auto dof : released.model.reduction.free_dofs())
    EXPECT_NEAR(balance[dof], 0, 1e-9 * 1e7);
}

/// Frozen by the same load, a static equilibrium stays one.
TEST(ContinuedState, OfAnEquilibriumStaysAtRestWithItsContactForces) {
  const std::vector<deck::Setting> gentle{{"loads.0.nodal_force.y", "-1e5"}};
  Walk pressed(test::two_beams, and_static(gentle));
  ASSERT_TRUE(pressed.to_end());
  ASSERT_GT(pressed.resultants().in_contact, 0);
  Walk held(test::two_beams, gentle);
  held.stand_at(continued_state(held.model, held.scheme, pressed.state(), 0));
  const auto tip = held.node_at(1, 0.1);
  const double deflection = held.displacement(tip, 1);
  ASSERT_TRUE(held.to_end());
  EXPECT_NEAR(held.displacement(tip, 1), deflection, 1e-6 * std::abs(deflection));
}

} // namespace
} // namespace rubato::step::start_test
