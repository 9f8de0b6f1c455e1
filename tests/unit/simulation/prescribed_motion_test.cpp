// SPDX-License-Identifier: LGPL-3.0-or-later
/// Supports that are given by velocities and accelerations.
#include "rubato/constraint/reduction.hpp"
#include "rubato/core/error.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>

namespace rubato::simulation::prescribed_motion_test {
namespace {

using std::numbers::pi;

/// A bar along x, of area 1; `support`: of its right end, along x.
std::string bar(const std::string& support, const std::string& time, const std::string& more = "") {
  return fmt::format(
      R"(mesh: {{generate: [{{name: bar, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [4, 1], cells: quad4, sides: {{left: left, right: right}}}}]}}
physics: plane_stress
materials: {{any: {{young: 1, poisson: 0, density: 1}}}}
functions:
  shake: {{sine: {{frequency: 0.5, amplitude: 2, phase: 30, mean: 0.1}}}}
  pulse: {{expression: exp(-t)}}
  both: {{product: [shake, pulse]}}
supports: [{{on: left, fix: [x, y]}}, {}]
newton: {{residual: 1e-12}}
time: {}
{})",
      support, time, more);
}

const std::string newmark = "{scheme: newmark, step: 0.01, end: 1}";
const std::string explicit_steps = "{scheme: central_difference, record: 0.01, end: 1}";

using Formula = std::function<double(double)>;

struct Moved {
  std::string name;
  std::string support;
  Formula u, v, a; ///< v and a at the begin
};

const double w = pi;
double shaken(double t) {
  return 0.1 + 2 * std::sin(w * t + pi / 6);
}

std::vector<Moved> moved() {
  const auto turned_once = [](double t) {
    return 0.1 * t - 2 * (std::cos(w * t + pi / 6) - std::cos(pi / 6)) / w;
  };
  return {
      {"ConstantVelocity", "x: {velocity: 0.5}", [](double t) { return 0.5 * t; }, [](double) { return 0.5; },
       [](double) { return 0.; }},
      {"SineVelocity", "x: {velocity: 0.1, function: shake}", [=](double t) { return 0.1 * turned_once(t); },
       [](double t) { return 0.1 * shaken(t); }, [](double t) { return 0.2 * w * std::cos(w * t + pi / 6); }},
      {"SineAcceleration", "x: {acceleration: 0.1, function: shake}",
       [](double t) {
         return 0.1 * (0.05 * t * t + 2 * std::cos(pi / 6) * t / w -
                       2 * (std::sin(w * t + pi / 6) - std::sin(pi / 6)) / w / w);
       },
       [=](double t) { return 0.1 * turned_once(t); }, [](double t) { return 0.1 * shaken(t); }},
      {"ExpressionOfTime", "x: {velocity: 'exp(-t)'}", [](double t) { return 1 - std::exp(-t); },
       [](double t) { return std::exp(-t); }, [](double t) { return -std::exp(-t); }},
      {"ExpressionOfPlace", "x: {velocity: '0.1*x', function: pulse}",
       [](double t) { return 0.1 * (1 - std::exp(-t)); }, [](double t) { return 0.1 * std::exp(-t); },
       [](double t) { return -0.1 * std::exp(-t); }},
      {"AlongADirection", "along: [2, 0], value: {velocity: 0.5, function: pulse}",
       [](double t) { return 0.5 * (1 - std::exp(-t)); }, [](double t) { return 0.5 * std::exp(-t); },
       [](double t) { return -0.5 * std::exp(-t); }},
  };
}

void PrintTo(const Moved& tested, std::ostream* out) {
  *out << tested.name;
}

class PrescribedMotion : public testing::TestWithParam<Moved> {};

std::string on_right(const std::string& support) {
  return "{on: right, " + support + "}";
}

TEST_P(PrescribedMotion, IsTheExactIntegralFromTheFirstInstantOn) {
  const auto& motion = GetParam();
  test::Walk walk(bar(on_right(motion.support), newmark));
  const auto node = walk.node_at(1, 0);
  const int dof = walk.model.dofs.dof(node, 0);
  EXPECT_NEAR(walk.state().motion.v[dof], motion.v(0), 1e-14);
  EXPECT_NEAR(walk.state().motion.a[dof], motion.a(0), 1e-9); // a derivative of polynomials
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    EXPECT_NEAR(walk.displacement(node, 0), motion.u(walk.state().t), 2e-15);
  }
  const auto& energy = walk.simulation.energy();
  EXPECT_LE(std::abs(energy.balance()), 1e-12 * energy.largest());
}

/// The inner nodes begin with the acceleration that goes with that of the support.
TEST_P(PrescribedMotion, BeginsInEquilibrium) {
  test::Walk walk(bar(on_right(GetParam().support), newmark));
  const auto& state = walk.state();
  const Eigen::VectorXd left = walk.model.mass * state.motion.a + state.bulk.internal;
  EXPECT_LE(walk.model.reduction.gather(left).lpNorm<Eigen::Infinity>(), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Of, PrescribedMotion, testing::ValuesIn(moved()),
                         [](const auto& tested) { return tested.param.name; });

TEST(PrescribedMotion, MovesExplicitRunsAlike) {
  for (const auto& motion : moved()) {
    if (motion.name == "AlongADirection")
      continue; // refused by explicit runs
    Simulation simulation(test::study_of(bar(on_right(motion.support), explicit_steps)));
    const test::ModelParts model(simulation.model());
    int dof = -1;
    for (const auto node : model.dofs.nodes)
      if (model.mesh.points[static_cast<std::size_t>(node)].isApprox(Eigen::Vector3d(1, 0, 0)))
        dof = model.dofs.dof(node, 0);
    while (!simulation.finished()) {
      ASSERT_TRUE(simulation.advance().accepted());
      const auto& state = simulation.state();
      EXPECT_NEAR(state.motion.u[dof], motion.u(state.t), 1e-14) << motion.name;
      EXPECT_NEAR(state.motion.v[dof], motion.v(state.t), 1e-3) << motion.name;
    }
    EXPECT_LE(std::abs(simulation.energy().balance()), 1e-12 * simulation.energy().largest()) << motion.name;
  }
}

TEST(PrescribedMotion, IsThatOfTheDisplacementInStaticRuns) {
  const std::string time = "{scheme: static, step: 0.1, end: 1}";
  test::Walk by_velocity(bar(on_right("x: {velocity: 'exp(-t)'}"), time));
  test::Walk by_displacement(bar(on_right("x: '1-exp(-t)'"), time));
  ASSERT_TRUE(by_velocity.to_end() && by_displacement.to_end());
  EXPECT_LE((by_velocity.state().motion.u - by_displacement.state().motion.u).lpNorm<Eigen::Infinity>(),
            1e-14);
}

TEST(PrescribedMotion, RefusesAnotherInitialVelocity) {
  const auto deck = [](const std::string& velocity) {
    return bar(on_right("x: {velocity: 0.5}"), newmark,
               "initial: [{on: right, velocity: {x: " + velocity + "}}]\n");
  };
  EXPECT_NO_THROW(test::model_of(deck("0.5")));
  try {
    test::model_of(deck("0.25"));
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("its support moves at 0.5"), std::string::npos) << error.what();
  }
}

/// A rigid end turns about its reference.
TEST(PrescribedMotion, TurnsAReference) {
  test::Walk walk(bar("{on: hub, fix: [x, y], turn: {z: {velocity: 0.1, function: shake}}}", newmark,
                      "relations: {hub: {rigid: {on: right}}}\n"));
  ASSERT_TRUE(walk.to_end());
  const double angle = 0.1 * (0.1 - 2 * (std::cos(w + pi / 6) - std::cos(pi / 6)) / w);
  EXPECT_NEAR(walk.displacement(walk.node_at(1, 1), 0), -0.5 * angle, 1e-14);
  EXPECT_LE(std::abs(walk.simulation.energy().balance()), 1e-12 * walk.simulation.energy().largest());
}

} // namespace
} // namespace rubato::simulation::prescribed_motion_test
