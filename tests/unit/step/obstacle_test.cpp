// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps against rigid obstacles: what a meshed rigid master does, the energy they give, and what only they
// can: round ones.
#include "rubato/deck/read.hpp"
#include "rubato/step/energy.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::obstacle_test {
namespace {

using Changes = std::vector<deck::Setting>;
using test::Walk;

/// A block on a foundation that is held at all its nodes and carried along as a whole, rubbing.
const std::string on_foundation = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [4, 3], sides: {top: top, bottom: under}}
    - {name: plane, rectangle: {from: [-1, -0.5], to: [2, 0]}, divisions: [12, 2], sides: {top: over}}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
functions: {ramp: {times: [0, 1], values: [0, 1]}, wave: {times: [0, 0.4, 1], values: [0, 1, -1]}}
supports:
  - {on: top, x: 0, y: {value: -0.01, function: ramp}}
  - {on: plane, x: {value: 0.02, function: wave}, y: {value: 0.005, function: ramp}}
contact: {foot: {master: over, slave: under, integration: nodes, friction: 0.3}}
time: {scheme: static, step: 0.1, end: 1}
newton: {residual: 1e-11}
)";

/// The same with a plane in the foundation's place.
std::string on_plane() {
  auto deck = on_foundation;
  const auto take_out = [&](const std::string& start) {
    const auto at = deck.find(start);
    deck.erase(at, deck.find('\n', at) + 1 - at);
  };
  take_out("    - {name: plane");
  take_out("  - {on: plane");
  const std::string master = "master: over";
  deck.replace(deck.find(master), master.size(),
               "obstacle: {plane: {point: [5, 0], normal: [0, 2]}, move: {x: {value: 0.02, function: wave}, "
               "y: {value: 0.005, function: ramp}}}");
  return deck;
}

struct Steps {
  std::vector<Eigen::VectorXd> u; ///< of the block
  EnergyLedger energy;
  double worst_balance = 0;
  int iterations = 0;
};

Steps steps_of(const std::string& deck, const Changes& changes) {
  Walk walk(deck, changes);
  Steps steps;
  walk.accepted = [&] {
    steps.worst_balance = std::max(steps.worst_balance, std::abs(walk.simulation.energy().balance()));
  };
  while (!walk.finished()) {
    if (!walk.advance()) {
      ADD_FAILURE() << to_string(walk.reports.back().outcome) << " at " << walk.target();
      break;
    }
    steps.u.push_back(walk.state().motion.u);
  }
  steps.energy = walk.simulation.energy();
  steps.iterations = walk.simulation.counters().iterations;
  return steps;
}

struct Variation {
  std::string name;
  Changes changes;
};

class Plane : public testing::TestWithParam<Variation> {};

TEST_P(Plane, DoesWhatAFoundationOfHeldNodesDoes) {
  const auto meshed = steps_of(on_foundation, GetParam().changes);
  const auto plane = steps_of(on_plane(), GetParam().changes);
  ASSERT_EQ(plane.u.size(), meshed.u.size());
  for (std::size_t i = 0; i < plane.u.size(); ++i) {
    const Eigen::VectorXd block = meshed.u[i].head(plane.u[i].size());
    EXPECT_LT((plane.u[i] - block).lpNorm<Eigen::Infinity>(), 1e-9 * block.lpNorm<Eigen::Infinity>()) << i;
  }
  const double scale = plane.energy.largest();
  EXPECT_LT(plane.worst_balance, 1e-10 * scale);
  EXPECT_NEAR(plane.energy.strain, meshed.energy.strain, 1e-8 * scale);
  EXPECT_NEAR(plane.energy.friction, meshed.energy.friction, 1e-8 * scale);
  EXPECT_NEAR(plane.energy.impact, meshed.energy.impact, 1e-8 * scale);
  if (plane.energy.kinetic == 0) { // the foundation's own mass is moved, too
    EXPECT_NEAR(plane.energy.support_work, meshed.energy.support_work, 1e-8 * scale);
  }
}

const Changes hht{{"time.scheme", "hht"}, {"time.alpha", "-0.1"}, {"time.step", "0.02"}};
Changes with(Changes changes, const Changes& more) {
  changes.insert(changes.end(), more.begin(), more.end());
  return changes;
}
const std::string foot = "contact.foot.";

INSTANTIATE_TEST_SUITE_P(
    By, Plane,
    testing::Values(
        Variation{"AugmentedLagrangian", {}},
        Variation{"AugmentedLagrangianAndFrictionByPenalty",
                  {{foot + "friction_method", "penalty"}, {foot + "coefficients.tangential", "1e3"}}},
        Variation{"GaussPoints", {{foot + "integration", "{gauss: 2}"}}},
        Variation{"Penalty",
                  {{foot + "method", "penalty"}, {foot + "coefficients", "{normal: 1e8, tangential: 1e3}"}}},
        Variation{"PenaltyAndExactFriction",
                  {{foot + "method", "penalty"}, {foot + "friction_method", "augmented_lagrangian"}}},
        Variation{"NodalLagrange", {{foot + "method", "nodal_lagrange"}}},
        Variation{"NodalPenalty", {{foot + "method", "nodal_penalty"}}},
        Variation{"NodalPcg", {{foot + "method", "nodal_pcg"}, {foot + "friction", "0"}}},
        Variation{"WholeSystem", {{"solver", "full"}}}, Variation{"Motion", hht},
        Variation{"MotionAndWholeSystem", with(hht, {{"solver", "full"}})},
        Variation{"MotionByPenalty", with(hht, {{foot + "method", "penalty"}})},
        Variation{"MotionByNodalLagrange", with(hht, {{foot + "method", "nodal_lagrange"}})},
        Variation{"MoreauJean", {{"time.scheme", "moreau_jean"}, {"time.theta", "1"}, {"time.step", "0.02"}}},
        Variation{"MassRedistributed", with(hht, {{"time.contact_mass", "redistributed"}})},
        Variation{"GeometryInALoop", {{foot + "iterate", "{geometry: fixed_point}"}}},
        Variation{"ThreeLoops",
                  {{foot + "iterate",
                    "{geometry: fixed_point, friction: {by: fixed_point, tolerance: 1e-12, max_loops: 100}, "
                    "status: fixed_point}"}}}),
    [](const auto& chosen) { return chosen.param.name; });

/// By central differences, the foundation's nodes having no say in the stiffness of the springs.
TEST(PlaneByCentralDifferences, DoesWhatAFoundationOfHeldNodesDoes) {
  const Changes changes{{"time", "{scheme: central_difference, step: auto, end: 0.2}"},
                        {foot + "method", "penalty"}};
  const auto model_of = [&](const std::string& deck) {
    return test::BuiltModel(deck::parse_deck(deck, "deck.yaml", changes).runs.front());
  };
  const auto meshed = model_of(on_foundation);
  const auto plane = model_of(on_plane());
  ExplicitMotion a(meshed);
  ExplicitMotion b(plane);
  EXPECT_NEAR(b.spectrum().contact, a.spectrum().contact, 1e-9 * a.spectrum().contact);
  int touched = 0;
  for (int part = 1; part <= 20; ++part) {
    a.advance(0.01 * part, 60);
    b.advance(0.01 * part, 60);
    const Eigen::VectorXd u = b.state().motion.u;
    const Eigen::VectorXd block = a.state().motion.u.head(u.size());
    EXPECT_LT((u - block).lpNorm<Eigen::Infinity>(), 1e-9 * block.lpNorm<Eigen::Infinity>()) << part;
    touched += b.energy().contact > 0 ? 1 : 0;
  }
  EXPECT_GT(touched, 5);
  EXPECT_GT(b.energy().friction, 0);
  EXPECT_NEAR(b.energy().friction, a.energy().friction, 1e-8 * a.energy().friction);
}

/// A block that starts in touch and is pushed and rubbed by a plane that comes up: springs in constant touch
/// keep no secret from the ledger.
TEST(PlaneByCentralDifferences, EntersItsWorkToRounding) {
  const Changes changes{{"time", "{scheme: central_difference, step: auto, end: 0.01}"},
                        {foot + "method", "penalty"},
                        {"supports", "[{on: top, x: 0, y: -0.001}]"},
                        {foot + "obstacle.move.x", "{value: 1, function: ramp}"},
                        {foot + "obstacle.move.y", "{value: 0.1, function: ramp}"}};
  const test::BuiltModel model(deck::parse_deck(on_plane(), "deck.yaml", changes).runs.front());
  ExplicitMotion motion(model);
  motion.advance(0.002, 100);
  const double before = motion.energy().balance();
  EXPECT_GT(motion.energy().contact, 0);
  motion.advance(0.004, 100);
  const auto ledger = motion.energy();
  EXPECT_NEAR(ledger.balance(), before, 1e-11 * ledger.largest());
  EXPECT_GT(ledger.support_work, 0.01 * ledger.largest());
}

/// A plane that rises at 1 under a block at rest meets it with that velocity: with restitution e the block's
/// foot leaves it by e, at 1 + e.
TEST(RisingPlane, ThrowsABlockBackWithItsRestitution) {
  for (const std::string restitution : {"0", "0.5", "1"}) {
    Walk walk(on_plane(), {{"time", "{scheme: moreau_jean, contact_mass: consistent, step: 1e-3, end: 1e-3}"},
                           {"supports", "[{on: top, x: 0}]"},
                           {foot + "friction", "0"},
                           {foot + "restitution", restitution},
                           {foot + "obstacle.move", "{x: ~, y: {value: 1, function: ramp}}"}});
    ASSERT_TRUE(walk.to_end());
    for (const auto node : walk.model.zones.front().slave.nodes)
      EXPECT_NEAR(walk.state().motion.v[walk.model.dofs.dof(node, 1)], 1 + std::stod(restitution), 1e-9);
  }
}

/// A circle pressed into a block and drawn along it.
const std::string indented = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [-1, -1], to: [1, 0]}, divisions: [17, 6], sides: {top: top, bottom: ground}}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0.3, density: 1000}}
functions: {press: {times: [0, 0.5], values: [0, 1]}, draw: {times: [0.5, 1], values: [0, 1]}}
supports: [{on: ground, fix: [x, y]}]
contact:
  tyre:
    obstacle:
      cylinder: {point: [0, 1], radius: 1}
      move: {x: {value: 0.3, function: draw}, y: {value: -0.05, function: press}}
    slave: top
    integration: nodes
    friction: 0.4
time: {scheme: static, step: 0.05, end: 1}
newton: {residual: 1e-11}
)";

class Circle : public testing::TestWithParam<Variation> {};

TEST_P(Circle, GivesItsWorkAndTheLedgerCloses) {
  const auto steps = steps_of(indented, GetParam().changes);
  EXPECT_LT(steps.worst_balance, 1e-10 * steps.energy.largest());
  EXPECT_GT(steps.energy.support_work, 0.5 * steps.energy.largest());
  EXPECT_GT(steps.energy.friction, 0.1 * steps.energy.largest());
}

INSTANTIATE_TEST_SUITE_P(
    By, Circle,
    testing::Values(
        Variation{"AugmentedLagrangian", {}}, Variation{"WholeSystem", {{"solver", "full"}}},
        Variation{"Penalty", {{"contact.tyre.method", "penalty"}}},
        Variation{"NodalLagrange", {{"contact.tyre.method", "nodal_lagrange"}}},
        Variation{"NodalPenalty", {{"contact.tyre.method", "nodal_penalty"}}},
        Variation{"Hht", {{"time.scheme", "hht"}, {"time.alpha", "-0.1"}, {"time.step", "0.02"}}},
        Variation{"Newmark", {{"time.scheme", "newmark"}, {"time.step", "0.02"}}},
        Variation{"MoreauJean", {{"time.scheme", "moreau_jean"}, {"time.theta", "1"}, {"time.step", "0.02"}}},
        Variation{
            "MassRedistributed",
            {{"time.scheme", "newmark"}, {"time.contact_mass", "redistributed"}, {"time.step", "0.02"}}},
        Variation{"GeneralizedAlpha", {{"time.scheme", "generalized_alpha"}, {"time.step", "0.02"}}}),
    [](const auto& chosen) { return chosen.param.name; });

TEST(Circle, IsTheSameForEverySolverAndLoop) {
  const auto reference = steps_of(indented, {}).u.back();
  for (const Changes& changes :
       {Changes{{"solver", "full"}},
        Changes{
            {"contact.tyre.iterate", "{geometry: {by: fixed_point, tolerance: 1e-11, max_loops: 100}}"}}}) {
    const auto other = steps_of(indented, changes).u.back();
    EXPECT_LT((other - reference).lpNorm<Eigen::Infinity>(), 1e-9 * reference.lpNorm<Eigen::Infinity>())
        << changes.front().path;
  }
}

/// A ball pressed into a block's top and dragged off, in space. The tangent knows its curvature: Newton needs
/// few iterations a step.
TEST(Ball, IsPressedAndDraggedInFewIterations) {
  const std::string deck = R"(
mesh:
  generate:
    - {name: block, box: {from: [-1, -1, -1], to: [1, 1, 0]}, divisions: [6, 6, 2], sides: {front: top, back: ground}}
physics: solid
materials: {rubber: {young: 1e6, poisson: 0.3}}
functions: {press: {times: [0, 0.5], values: [0, 1]}, draw: {times: [0.5, 1], values: [0, 1]}}
supports: [{on: ground, fix: [x, y, z]}]
contact:
  ball:
    obstacle:
      sphere: {point: [0, 0, 1.5], radius: 1.5}
      move: {x: {value: 0.2, function: draw}, y: {value: 0.1, function: draw}, z: {value: -0.1, function: press}}
    slave: top
    integration: nodes
    friction: 0.3
time: {scheme: static, step: 0.125, end: 1}
newton: {residual: 1e-11}
)";
  const auto steps = steps_of(deck, {});
  ASSERT_EQ(steps.u.size(), 8U);
  EXPECT_LT(steps.worst_balance, 1e-10 * steps.energy.largest());
  EXPECT_LE(steps.iterations, 8 * 10);
  const auto whole = steps_of(deck, {{"solver", "full"}});
  EXPECT_LT((whole.u.back() - steps.u.back()).lpNorm<Eigen::Infinity>(),
            1e-9 * steps.u.back().lpNorm<Eigen::Infinity>());
}

/// A rigid ball of radius 1 on a half space: the largest pressure belongs to the force as H. Hertz says (K.
/// L. Johnson, Contact Mechanics, 1985, eq. 4.24), p₀ = (6 F E*²/(π³ R²))^⅓, however deep the body is. Four
/// cells on the radius of contact.
TEST(Ball, PressesAsHertzSays) {
  Walk walk(R"(
mesh:
  generate:
    - {name: half_space, rectangle: {from: [0, -0.4], to: [0.4, 0]}, divisions: [40, 40],
       sides: {top: top, bottom: ground, left: axis}}
  convert: full_quadratic
physics: axisymmetric
materials: {rubber: {young: 1e6, poisson: 0.3}}
supports: [{on: ground, fix: y}, {on: axis, fix: x}]
contact: {ball: {slave: top, integration: nodes, obstacle: {sphere: {point: [0, 0.998], radius: 1}}}}
time: {scheme: static, step: 1, end: 1}
)");
  ASSERT_TRUE(walk.to_end());
  const double force = -walk.resultants().force[1];
  const double stiffness = 1e6 / (1 - 0.3 * 0.3);
  const double largest = std::cbrt(6 * force * stiffness * stiffness / std::pow(M_PI, 3));
  EXPECT_NEAR(walk.resultants().largest_pressure, largest, 0.015 * largest);
}

/// A square plug that is too large for a bore touches it at its corners; the forces keep it in the middle.
TEST(Bore, HoldsAPlugFromInside) {
  Walk walk(R"(
mesh:
  generate:
    - {name: plug, rectangle: {from: [-1, -1], to: [1, 1]}, divisions: [4, 4],
       sides: {left: skin, right: skin, bottom: skin, top: skin}, points: {right_top: corner}}
physics: plane_strain
materials: {rubber: {young: 1e6, poisson: 0.3}}
contact:
  wall: {obstacle: {cylinder: {point: [0, 0], radius: 1.4, side: inside}}, slave: skin, integration: nodes, friction: 0.1}
time: {scheme: static, step: 1, end: 1}
)");
  ASSERT_TRUE(walk.to_end());
  const double radius = std::sqrt(2.0) * (1 + walk.displacement(walk.node_at(1, 1), 0));
  EXPECT_NEAR(radius, 1.4, 1e-12);
  EXPECT_LT(walk.resultants().force.norm(), 1e-9);
  EXPECT_EQ(walk.resultants().in_contact, 4);
}

/// Sphere, cylinder and plane in a meridian plane: a disc pressed by each of them.
TEST(AxisymmetricObstacles, PushAlongOrAcrossTheAxis) {
  const std::string deck = R"(
mesh:
  generate:
    - {name: disc, rectangle: {from: [0, 0], to: [1, 0.5]}, divisions: [8, 4],
       sides: {left: axis, top: top, bottom: ground, right: rim}}
physics: axisymmetric
materials: {rubber: {young: 1e6, poisson: 0.3}}
supports: [{on: ground, fix: y}, {on: axis, fix: x}]
contact: {zone: {obstacle: {plane: {point: [0, 0.49], normal: [0, -1]}}, slave: top, integration: nodes}}
time: {scheme: static, step: 1, end: 1}
)";
  const auto force = [&](const Changes& changes) {
    Walk walk(deck, changes);
    EXPECT_TRUE(walk.to_end());
    EXPECT_GT(walk.resultants().in_contact, 0);
    return walk.resultants().force;
  };
  EXPECT_NEAR(force({})[1], -1e6 * 0.02 * M_PI, 1e-6); // uniform: E ε times the area
  EXPECT_LT(force({{"contact.zone.obstacle.plane", ""},
                   {"contact.zone.obstacle", "{sphere: {point: [0, 2.48], radius: 2}}"}})[1],
            -100);
  EXPECT_LT(force({{"contact.zone.obstacle.plane", ""},
                   {"contact.zone.obstacle", "{cylinder: {radius: 0.99, side: inside}}"},
                   {"contact.zone.slave", "rim"}})[0],
            -100);
}

} // namespace
} // namespace rubato::step::obstacle_test
