// SPDX-License-Identifier: LGPL-3.0-or-later
// Obstacles that rotate: what they carry and drag, with which forces, and the work they do.
#include "rubato/contact/pairing.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::rotating_obstacle_test {
namespace {

using Changes = std::vector<deck::Setting>;
using Eigen::Vector3d;
using test::Walk;

struct Way {
  std::string name;
  Changes changes;
  double turned = 1e-6; ///< part of a work that a normal does which turns over a face
};

std::string name_of(const testing::TestParamInfo<Way>& info) {
  return info.param.name;
}

/// Where the points of the first zone are.
std::vector<Vector3d> places_of(const Walk& walk) {
  const auto& u = walk.state().motion.u;
  const contact::Configuration now{&walk.model.mesh, &walk.model.dofs, &u, &u,
                                   walk.state().t,   walk.state().t};
  std::vector<Vector3d> places;
  for (const auto& point : walk.model.zones.front().points)
    places.push_back(contact::position(point, now));
  return places;
}

/// Σ (x − c) × f about z, f what the obstacle of the first zone pushes the body with.
double moment_about(const Walk& walk, const Vector3d& centre) {
  const auto places = places_of(walk);
  double moment = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& outcome = walk.state().zones.front().outcomes[i];
    moment += (places[i] - centre).cross(outcome.normal + outcome.tangential)[2];
  }
  return moment;
}

/// A roller below a block that is pressed onto it and held at its top. The roller turns to the left above its
/// axis: against the clock.
const std::string on_roller = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [-1, 0], to: [1, 1]}, divisions: [9, 4], sides: {top: top, bottom: under}}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
functions: {press: {times: [0, 0.2], values: [0, 1]}, roll: {times: [0.2, 1], values: [0, 1]}}
supports: [{on: top, x: 0, y: {value: -0.05, function: press}}]
contact:
  roller:
    obstacle:
      cylinder: {point: [0, -1], radius: 1}
      rotate: {about: [0, -1], angle: {value: 0.8, function: roll}}
    slave: under
    integration: nodes
    friction: 0.3
time: {scheme: static, step: 0.04, end: 1}
newton: {residual: 1e-11}
)";

class RotatingRoller : public testing::TestWithParam<Way> {};

/// From the first full slip on the force is μN, and what the roller gives is what friction takes: the moment
/// times sin Δθ in each step, as the block stays where it is.
TEST_P(RotatingRoller, DragsTheBlockWithFrictionTimesForceAndDoesTheWorkOfItsMoment) {
  Walk walk(on_roller, GetParam().changes);
  const double turn = 0.8 / 20;
  double balance = 0;
  walk.accepted = [&] { balance = std::max(balance, std::abs(walk.simulation.energy().balance())); };
  while (walk.state().t < 0.5)
    ASSERT_TRUE(walk.advance());
  auto before = walk.simulation.energy();
  double moment = moment_about(walk, {0, -1, 0});
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    const auto now = walk.simulation.energy();
    const auto force = walk.resultants().force;
    EXPECT_GT(force[1], 1000);
    const double moment_now = moment_about(walk, {0, -1, 0});
    const double work = now.support_work - before.support_work;
    EXPECT_NEAR(work, 0.5 * (moment + moment_now) * std::sin(turn), GetParam().turned * work);
    EXPECT_NEAR(now.friction - before.friction, work, GetParam().turned * work);
    EXPECT_NEAR(moment_now, 0.3 * walk.resultants().normal, 2e-2 * moment_now); // the arm is the radius
    before = now;
    moment = moment_now;
  }
  EXPECT_LT(balance, 1e-10 * walk.simulation.energy().largest());
}

const std::string roller = "contact.roller.";

INSTANTIATE_TEST_SUITE_P(By, RotatingRoller,
                         testing::Values(Way{"AugmentedLagrangian", {}},
                                         Way{"WholeSystem", {{"solver", "full"}}},
                                         Way{"Mortar", {{roller + "integration", "mortar"}}, 1e-3},
                                         Way{"NodalLagrange",
                                             {{roller + "method", "nodal_lagrange"},
                                              {roller + "coefficients", "{tangential: 1e8}"}}}),
                         name_of);

class EveryWayOfRolling : public testing::TestWithParam<Way> {};

TEST_P(EveryWayOfRolling, ClosesTheLedger) {
  Walk walk(on_roller, GetParam().changes);
  double balance = 0;
  walk.accepted = [&] { balance = std::max(balance, std::abs(walk.simulation.energy().balance())); };
  ASSERT_TRUE(walk.to_end());
  const auto energy = walk.simulation.energy();
  EXPECT_LT(balance, 1e-10 * energy.largest());
  EXPECT_GT(energy.friction, 0.1 * energy.largest());
}

const Changes hht{{"time", "{scheme: hht, alpha: -0.1, step: 0.02, end: 1}"}};
Changes with(Changes changes, const Changes& more) {
  changes.insert(changes.end(), more.begin(), more.end());
  return changes;
}

INSTANTIATE_TEST_SUITE_P(
    By, EveryWayOfRolling,
    testing::Values(
        Way{"GaussPoints", {{roller + "integration", "{gauss: 2}"}}},
        Way{"Penalty",
            {{roller + "method", "penalty"}, {roller + "coefficients", "{normal: 1e8, tangential: 1e3}"}}},
        Way{"Exponential",
            {{roller + "method", "exponential"},
             {roller + "coefficients", "{pressure: 1e3, clearance: 1e-3}"}}},
        Way{"NodalPenalty", {{roller + "method", "nodal_penalty"}}},
        Way{"GeometryInALoop",
            {{roller + "iterate", "{geometry: {by: fixed_point, tolerance: 1e-10, max_loops: 50}}"}}},
        Way{"Hht", hht}, Way{"HhtByMortar", with(hht, {{roller + "integration", "mortar"}})},
        Way{"Newmark", {{"time", "{scheme: newmark, step: 0.02, end: 1}"}}},
        Way{"MassRedistributed",
            {{"time", "{scheme: newmark, contact_mass: redistributed, step: 0.02, end: 1}"}}},
        Way{"MoreauJean", {{"time", "{scheme: moreau_jean, theta: 1, step: 0.01, end: 1}"}}},
        Way{"MoreauJeanByMortar",
            {{"time", "{scheme: moreau_jean, step: 0.01, end: 1}"}, {roller + "integration", "mortar"}}},
        Way{"EnergyMomentum",
            {{"time", "{scheme: energy_momentum, step: 0.01, end: 1}"},
             {"materials.rubber.strain", "green_lagrange"}}}),
    name_of);

/// A law of velocities counts no gaps of points that touch: one that turned into the block, or away from it,
/// would be found farther from it from step to step.
TEST(RollerByVelocities, StaysAtTheSurface) {
  Walk slow(on_roller);
  ASSERT_TRUE(slow.to_end());
  for (const double theta : {0.5, 1.0}) {
    Walk walk(on_roller,
              {{"time", fmt::format("{{scheme: moreau_jean, theta: {}, step: 0.001, end: 1}}", theta)}});
    ASSERT_TRUE(walk.to_end());
    for (const auto& outcome : walk.state().zones.front().outcomes)
      EXPECT_GT(outcome.gap, -1e-6);
    const auto moving = walk.resultants().force, still = slow.resultants().force;
    EXPECT_NEAR(moving[1], still[1], 0.03 * still[1]) << theta;
    EXPECT_NEAR(moving[0], still[0], 0.03 * still[1]) << theta;
  }
}

/// Two parallel planes that hold a block between them and turn it round: a block that sticks turns with them
/// as a rigid body, exactly, by steps of any size.
const std::string in_jaws = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [-1, -0.5], to: [1, 0.5]}, divisions: [2, 1], sides: {top: top, bottom: under}}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000, strain: green_lagrange}}
functions: {press: {times: [0, 0.2], values: [0, 1]}, turn: {times: [0.2, 1], values: [0, 1]}}
contact:
  low:
    obstacle: {plane: {point: [0, -0.5], normal: [0, 1]}, rotate: {about: [0.3, 2], angle: {value: 0.8, function: turn}}}
    slave: under
    friction: 1
  high:
    obstacle:
      plane: {point: [0, 0.5], normal: [0, -1]}
      rotate: {about: [0.3, 2], angle: {value: 0.8, function: turn}}
    slave: top
    interference: {value: 0.02, function: press}
    friction: 1
time: {scheme: static, step: 0.2, end: 1}
newton: {residual: 1e-11}
)";

class TurningJaws : public testing::TestWithParam<Way> {};

TEST_P(TurningJaws, TurnABlockThatSticksAsARigidBody) {
  Walk walk(in_jaws, GetParam().changes);
  ASSERT_TRUE(walk.advance());
  const Eigen::VectorXd pressed = walk.state().motion.u;
  const double stored = walk.simulation.energy().strain;
  const double given = walk.simulation.energy().support_work;
  ASSERT_GT(stored, 1);
  ASSERT_TRUE(walk.to_end());
  const Eigen::Rotation2Dd turn(0.8);
  const Eigen::Vector2d about(0.3, 2);
  for (const auto node : walk.model.dofs.nodes) {
    const Eigen::Vector2d place = walk.model.mesh.points[static_cast<std::size_t>(node)].head<2>();
    const auto dof = walk.model.dofs.dof(node, 0);
    const Eigen::Vector2d end = about + turn * (place + pressed.segment<2>(dof) - about);
    EXPECT_LT((place + walk.state().motion.u.segment<2>(dof) - end).norm(), 1e-9);
  }
  EXPECT_NEAR(walk.simulation.energy().strain, stored, 1e-8 * stored);
  EXPECT_NEAR(walk.simulation.energy().support_work, given, 1e-8 * stored);
}

INSTANTIATE_TEST_SUITE_P(By, TurningJaws,
                         testing::Values(Way{"Nodes", {}}, Way{"WholeSystem", {{"solver", "full"}}},
                                         Way{"Mortar",
                                             {{"contact.low.integration", "mortar"},
                                              {"contact.high.integration", "mortar"}}}),
                         name_of);

/// A pad on a disc beside its axis: friction acts along the circle, whatever the step.
TEST(RotatingDisc, DragsAPadAlongItsCircle) {
  for (const std::string step : {"0.2", "0.05"}) {
    Walk walk(R"(
mesh:
  generate:
    - {name: pad, box: {from: [1.9, -0.1, 0], to: [2.1, 0.1, 0.2]}, divisions: [2, 2, 2], sides: {front: top, back: under}}
physics: solid
materials: {rubber: {young: 1e6, poisson: 0}}
functions: {press: {times: [0, 0.2], values: [0, 1]}, turn: {times: [0.2, 1], values: [0, 1]}}
supports: [{on: top, x: 0, y: 0, z: {value: -0.001, function: press}}]
contact:
  disc:
    obstacle: {plane: {point: [0, 0, 0], normal: [0, 0, 1]}, rotate: {about: [0, 0, 0], axis: [0, 0, 2], angle: {value: 2, function: turn}}}
    slave: under
    friction: 0.4
time: {scheme: static, step: )" +
              step + R"(, end: 1}
newton: {residual: 1e-11}
)");
    ASSERT_TRUE(walk.to_end());
    const auto force = walk.resultants().force;
    EXPECT_NEAR(force[1], 0.4 * force[2], 5e-3 * force[2]); // directions differ over the pad by 0.05
    const auto places = places_of(walk);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const auto& drag = walk.state().zones.front().outcomes[i].tangential;
      EXPECT_NEAR(drag.dot(places[i]), 0, 1e-6 * drag.norm() * places[i].norm());
    }
    EXPECT_NEAR(moment_about(walk, {0, 0, 0}), 2 * force[1], 1e-2 * force[1]);
  }
}

/// By central differences a free block is dragged with μN all the time that the roller is faster than it, and
/// the ledger closes.
TEST(RollerByCentralDifferences, DragsTheBlockAndEntersItsWork) {
  const Changes changes{{"time", "{scheme: central_difference, step: auto, end: 0.4}"},
                        {roller + "method", "penalty"},
                        {"functions.press.times", "[0, 0.1]"},
                        {"functions.roll.times", "[0.1, 0.4]"},
                        {"supports.0.y.value", "-0.01"}};
  const test::BuiltModel model(deck::parse_deck(on_roller, "deck.yaml", changes).runs.front());
  ExplicitMotion motion(model);
  motion.advance(0.35, 3000);
  const auto before = motion.energy();
  motion.advance(0.4, 400);
  const auto now = motion.energy();
  EXPECT_LT(std::abs(now.balance()), 1e-10 * now.largest());
  const auto state = motion.state();
  Vector3d normal = Vector3d::Zero(), tangential = Vector3d::Zero();
  for (const auto& outcome : state.zones.front().outcomes) {
    normal += outcome.normal;
    tangential += outcome.tangential;
  }
  EXPECT_NEAR(tangential.norm(), 0.3 * normal.norm(), 2e-2 * tangential.norm());
  EXPECT_LT(tangential[0], 0);
  EXPECT_GT(now.support_work, before.support_work);
  EXPECT_NEAR(now.support_work - before.support_work, now.friction - before.friction,
              0.05 * (now.friction - before.friction));
}

} // namespace
} // namespace rubato::step::rotating_obstacle_test
