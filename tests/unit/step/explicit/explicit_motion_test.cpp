// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/constraint/reduction.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include <cmath>
#include <numbers>
#include <string>

namespace rubato::step::explicit_motion_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

test::BuiltModel model_of(const std::string& deck, const std::vector<deck::Setting>& changes = {}) {
  return test::BuiltModel(deck::parse_deck(deck, "deck.yaml", changes).runs.front());
}

/// A row of squares of side 1 that move along x only: springs of stiffness 1 between nodes of mass 1 in all
/// (two nodes of 1/2 above each other), the left end held. A unit force stretches its free end.
std::string bar(int cells) {
  return R"(
mesh:
  generate:
    - {name: bar, rectangle: {from: [0, 0], to: [)" +
         std::to_string(cells) + R"(, 1]}, divisions: [)" + std::to_string(cells) + R"(, 1],
       sides: {left: held, right: end}}
physics: plane_stress
materials: {unit: {young: 1, poisson: 0, density: 1}}
supports: [{on: held, fix: x}, {on: bar, fix: y}]
loads: [{surface_force: {on: end, x: 1}}]
time: {scheme: central_difference, end: 1, record: 1}
)";
}

double end_of(const test::ModelParts& model, const VectorXd& values) {
  double largest = -1;
  double value = 0;
  for (const auto node : model.dofs.nodes)
    if (const double x = model.mesh.points[static_cast<std::size_t>(node)][0]; x > largest) {
      largest = x;
      value = values[model.dofs.dof(node, 0)];
    }
  return value;
}

/// The square of bar(1), let go at a stretch and a speed: u = u₀ cos ωt + v₀/ω sin ωt.
TEST(ExplicitOscillator, BeginsWithTheMotionOfTheDeck) {
  const auto model =
      model_of(bar(1), {{"loads", ""}, {"initial", "[{on: end, displacement: {x: 0.5}, velocity: {x: 3}}]"}});
  const double omega = std::sqrt(2.0);
  ExplicitMotion motion(model);
  EXPECT_NEAR(motion.energy().start, 0.5 * 0.5 * 9 + 0.5 * 0.25, 1e-12);
  EXPECT_EQ(end_of(model, motion.state().motion.v), 3);
  motion.advance(2, 2000);
  EXPECT_NEAR(end_of(model, motion.state().motion.u),
              0.5 * std::cos(2 * omega) + 3 / omega * std::sin(2 * omega), 2e-6);
  EXPECT_LE(std::abs(motion.energy().balance()), 1e-12 * motion.energy().largest());
}

/// One square is an oscillator of ω² = k/m = 1/(1/2), two dofs of x moving alike.
TEST(ExplicitOscillator, IsExactToSecondOrder) {
  const auto model = model_of(bar(1));
  const double omega = std::sqrt(2.0);
  const double end = 2;
  std::vector<double> errors;
  for (const int steps : {40, 80, 160}) {
    ExplicitMotion motion(model);
    motion.advance(end, steps);
    const auto state = motion.state();
    errors.push_back(std::abs(end_of(model, state.motion.u) - (1 - std::cos(omega * end))));
    EXPECT_NEAR(end_of(model, state.motion.v), omega * std::sin(omega * end), 20. / (steps * steps));
    EXPECT_NEAR(end_of(model, state.motion.a), 2 * std::cos(omega * end), 20. / (steps * steps));
  }
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.05);
  EXPECT_NEAR(errors[1] / errors[2], 4, 0.02);
}

/// A chain of n equal masses, the last one halved: ω_max = 2 sin(π/2 (1 − 1/(2n))) is just below 2.
TEST(ExplicitBar, HasTheStableStepOfAChainOfSprings) {
  for (const int cells : {1, 2, 10, 50}) {
    const ExplicitMotion motion(model_of(bar(cells)));
    const double omega = 2 * std::sin(std::numbers::pi / 2 * (1 - 0.5 / cells));
    const double found = motion.spectrum().stable_step();
    EXPECT_LE(found, 2 / omega * (1 + 1e-12)) << cells;
    EXPECT_GE(found, 0.994 * 2 / omega) << cells;
  }
}

TEST(ExplicitBar, StaysBoundedAtItsStableStepAndNotBeyond) {
  const auto model = model_of(bar(10));
  for (const double factor : {1.0, 1.02}) {
    ExplicitMotion motion(model);
    const double h = factor * motion.spectrum().stable_step();
    motion.advance(3000 * h, 3000);
    EXPECT_EQ(motion.state().motion.u.lpNorm<Eigen::Infinity>() < 100, factor == 1.0);
  }
}

TEST(ExplicitBar, ClosesItsEnergyToRounding) {
  const auto model = model_of(bar(10), {{"loads.0.surface_force.function", "hum"},
                                        {"functions.hum", "{times: [0, 1, 3], values: [0.5, 2, -1]}"}});
  ExplicitMotion motion(model);
  const double h = 0.9 * motion.spectrum().stable_step();
  double most = 0;
  for (int i = 1; i <= 40; ++i) {
    motion.advance(5 * i * h * (i > 20 ? 0.9 : 1), 5);
    const auto energy = motion.energy();
    most = std::max(most, energy.largest());
    EXPECT_LT(std::abs(energy.balance()), 1e-12 * most) << i;
  }
  EXPECT_GT(most, 1);
}

TEST(ExplicitBar, AccountsForSupportsThatMoveAndForDamping) {
  const auto model =
      model_of(bar(5), {{"supports", "[{on: held, x: {value: 0.3, function: pull}}, {on: bar, fix: y}]"},
                        {"functions.pull", "{times: [0, 2, 3], values: [0, 1, -1]}"},
                        {"materials.unit.rayleigh", "{stiffness: 0.05, mass: 0.1}"}});
  ExplicitMotion motion(model);
  const int steps = static_cast<int>(std::ceil(8 / (0.9 * motion.spectrum().stable_step())));
  motion.advance(8, steps);
  const auto energy = motion.energy();
  EXPECT_GT(energy.damping, 0.01);
  EXPECT_GT(std::abs(energy.support_work), 0.01);
  EXPECT_LT(std::abs(energy.balance()), 1e-12 * energy.largest());
  EXPECT_NEAR(motion.state().motion.u[model.reduction.prescribed().front().dof], -0.3, 1e-15);
}

/// The decay of the first mode of one square: u″ + 2ξω u′ + ω² u = 0, 2ξω = mass + stiffness ω².
TEST(ExplicitOscillator, IsDampedAsRayleighSays) {
  const auto model = model_of(bar(1), {{"materials.unit.rayleigh", "{stiffness: 0.1, mass: 0.2}"}});
  const double omega = std::sqrt(2.0);
  const double xi = (0.2 + 0.1 * 2) / (2 * omega);
  const double rest = omega * std::sqrt(1 - xi * xi);
  const double t = 3;
  ExplicitMotion motion(model);
  motion.advance(t, 20'000);
  const double expected =
      1 - std::exp(-xi * omega * t) * (std::cos(rest * t) + xi * omega / rest * std::sin(rest * t));
  EXPECT_NEAR(end_of(model, motion.state().motion.u), expected, 1e-4);
}

TEST(ExplicitDamping, ShortensTheStableStep) {
  const auto damped = model_of(bar(10), {{"materials.unit.rayleigh", "{stiffness: 0.5, mass: 0}"}});
  ExplicitMotion motion(damped);
  const double stable = motion.spectrum().stable_step();
  EXPECT_LT(stable, 0.7 * ExplicitMotion(model_of(bar(10))).spectrum().stable_step());
  motion.advance(3000 * stable, 3000);
  EXPECT_LT(motion.state().motion.u.lpNorm<Eigen::Infinity>(), 100);
}

/// One body against the wall of a second one that is held: its momentum turns round, its energy stays.
const std::string impact = R"(
mesh:
  generate:
    - {name: flying, rectangle: {from: [0, 0.01], to: [1, 1.01]}, divisions: [4, 8], sides: {bottom: nose, top: roof}}
    - {name: wall, rectangle: {from: [-1, -1], to: [2, 0]}, divisions: [8, 3], sides: {top: face, bottom: ground}}
physics: plane_stress
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
functions: {push: {times: [0, 0.005, 0.0051], values: [1, 1, 0]}}
supports: [{on: ground, fix: [x, y]}]
loads: [{gravity: {on: flying, x: 20, y: -400, function: push}}]
contact: {zone: {master: face, slave: nose, integration: nodes, friction: 0.3, method: penalty}}
time: {scheme: central_difference, end: 0.03, record: 0.03}
)";

TEST(ExplicitImpact, KeepsMomentumAndEnergy) {
  const auto model = model_of(impact);
  ExplicitMotion motion(model);
  const int steps = static_cast<int>(std::ceil(0.03 / (0.9 * motion.spectrum().stable_step())));
  motion.advance(0.03 / 2, steps / 2);
  const auto state = motion.state();
  Eigen::Vector2d total = Eigen::Vector2d::Zero();
  for (const auto node : model.dofs.nodes)
    total += state.contact_force.segment<2>(model.dofs.dof(node, 0));
  EXPECT_GT(state.contact_force.norm(), 0) << "the body is to touch now";
  EXPECT_LT(total.norm(), 1e-12 * state.contact_force.lpNorm<1>());
  motion.advance(0.03, steps - steps / 2);
  const auto energy = motion.energy();
  EXPECT_GT(energy.friction, 0);
  EXPECT_LT(std::abs(energy.balance()), 1e-13 * energy.largest());
}

/// What springs take and neither keep nor rub away, because points touch, leave and turn within a step, is
/// the error of the steps.
TEST(ExplicitImpact, LosesLessToItsSpringsInShorterSteps) {
  const auto model = model_of(impact);
  std::vector<double> lost;
  for (const int refined : {1, 4, 16}) {
    ExplicitMotion motion(model);
    motion.advance(0.03,
                   refined * static_cast<int>(std::ceil(0.03 / (0.9 * motion.spectrum().stable_step()))));
    const auto energy = motion.energy();
    lost.push_back(std::abs(energy.impact) / energy.largest());
  }
  EXPECT_LT(lost[0], 2e-3);
  EXPECT_GT(lost[0], 0);
  EXPECT_LT(lost[1], lost[0] / 8);
  EXPECT_LT(lost[2], lost[1] / 8);
}

/// Beams on each other, their nodes face to face: points go to and fro between the faces beside a node.
TEST(ExplicitMotion, HasNoMemoryBesideTheOneItTells) {
  const auto model = model_of(test::two_beams, {{"contact.interface.method", "penalty"},
                                                {"time.scheme", "central_difference"},
                                                {"time.alpha", ""},
                                                {"time.step", ""}});
  ExplicitMotion motion(model);
  const double h = 0.8 * motion.spectrum().stable_step();
  for (int i = 1; i * 50 * h < 6e-3; ++i) {
    const auto start = motion.memory();
    motion.advance(50 * i * h, 50);
    ExplicitMotion resumed(model);
    resumed.restore(start);
    resumed.advance(50 * i * h, 50);
    ASSERT_EQ(resumed.state().motion.u, motion.state().motion.u) << "from t = " << start.t;
    ASSERT_EQ(resumed.state().contact_force, motion.state().contact_force) << "from t = " << start.t;
    motion.restore(start);
    motion.advance(50 * i * h, 50);
    ASSERT_EQ(resumed.state().motion.u, motion.state().motion.u) << "back to t = " << start.t;
  }
  EXPECT_GT(motion.state().contact_force.norm(), 0);
}

TEST(AStableStep, IsShorterWithStifferContact) {
  const auto usual_model = model_of(impact);
  const auto stiff_model = model_of(impact, {{"contact.zone.coefficients.normal", "1e10"}});
  const ExplicitMotion usual(usual_model);
  const ExplicitMotion stiff(stiff_model);
  EXPECT_GT(usual.spectrum().contact, 0);
  EXPECT_LT(usual.spectrum().contact, usual.spectrum().stiffness);
  EXPECT_GT(stiff.spectrum().contact, 10 * usual.spectrum().contact);
}

} // namespace
} // namespace rubato::step::explicit_motion_test
