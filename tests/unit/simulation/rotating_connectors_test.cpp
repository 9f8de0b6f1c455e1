// SPDX-License-Identifier: LGPL-3.0-or-later
/// Connectors with rotates: true: pendulums against equations of motion that are integrated apart, trusses
/// and ropes against closed forms, turned problems, restarts, refusals.
#include "rubato/element/failure.hpp"
#include "rubato/modes/modal_study.hpp"
#include "rubato/modes/modes.hpp"
#include "rubato/step/energy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

namespace rubato::simulation::rotating_connectors_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double gravity = 9.81;
constexpr double mass = 10;

/// A block that only translates, around (1, 0), hung to the origin: a mass at a point.
std::string bob(const std::string& connector, const std::string& time, const std::string& more = "") {
  return fmt::format(
      R"(mesh: {{generate: [{{name: bob, rectangle: {{from: [0.95, -0.05], to: [1.05, 0.05]}}, divisions: [1, 1], cells: quad4}}]}}
physics: plane_stress
materials: {{any: {{young: 1e7, poisson: 0, density: 1000}}}}
relations: {{stiff: {{equal: {{on: bob}}}}, eye: {{embedded: {{at: [1, 0], in: bob}}}}}}
connectors: [{{on: eye, anchor: [0, 0], rotates: true, {}}}]
newton: {{residual: 1e-11}}
time: {}
{})",
      connector, time, more);
}

const std::string falls = "loads: [{gravity: {y: -9.81}}]\n";

std::string solid_bob(const std::string& connector, const std::string& time) {
  return fmt::format(
      R"(mesh: {{generate: [{{name: bob, box: {{from: [0.9, -0.1, -0.1], to: [1.1, 0.1, 0.1]}}, divisions: [1, 1, 1], cells: hexa8}}]}}
physics: solid
materials: {{any: {{young: 1e7, poisson: 0, density: 1250}}}}
relations: {{stiff: {{equal: {{on: bob}}}}, eye: {{embedded: {{at: [1, 0, 0], in: bob}}}}}}
connectors: [{{on: eye, anchor: [0, 0, 0], rotates: true, {}}}]
loads: [{{gravity: {{z: -9.81}}}}]
initial: [{{on: all, velocity: {{y: 2, z: 0.5}}}}]
newton: {{residual: 1e-11}}
time: {}
)",
      connector, time);
}

struct Pendulum {
  Vector3d place = Vector3d::UnitX();
  Vector3d velocity = Vector3d::Zero();
  Vector3d weight = Vector3d(0, -gravity, 0);
  std::function<double(double)> spring, dashpot;

  Vector3d acceleration(const Vector3d& x, const Vector3d& v) const {
    const double l = x.norm();
    return weight - (spring(l - 1) + (dashpot ? dashpot(x.dot(v) / l) : 0)) / mass * x / l;
  }
  /// Runge and Kutta's method of fourth order.
  void run(double time, int steps) {
    const double h = time / steps;
    for (int i = 0; i < steps; ++i) {
      const Vector3d v1 = velocity, a1 = acceleration(place, v1);
      const Vector3d v2 = velocity + h / 2 * a1, a2 = acceleration(place + h / 2 * v1, v2);
      const Vector3d v3 = velocity + h / 2 * a2, a3 = acceleration(place + h / 2 * v2, v3);
      const Vector3d v4 = velocity + h * a3, a4 = acceleration(place + h * v3, v4);
      place += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
      velocity += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
  }
};

/// Of the block's first node, with the others' the same.
Vector3d place_of(const step::State& state, int components) {
  Vector3d place = Vector3d::UnitX();
  for (int i = 0; i < components; ++i)
    place[i] += state.motion.u[i];
  return place;
}

struct Course {
  std::string name;
  std::string time;
  double error; ///< allowed, of the length
};

/// How failures print it.
void PrintTo(const Course& course, std::ostream* out) {
  *out << course.name;
}

class Pendulums : public testing::TestWithParam<Course> {};

struct Hung {
  std::string connector;
  std::function<double(double)> spring, dashpot;
};

const std::vector<Hung> hung{
    {"stiffness: 2000", [](double e) { return 2000 * e; }, {}},
    {"stiffness: 2000, damping: 40", [](double e) { return 2000 * e; },
     [](double rate) { return 40 * rate; }},
    {"force: {elongations: [-1, 0, 0.1, 1], forces: [-2000, 50, 150, 3750]}, damper: {rates: [-2, -0.2, 0.2, "
     "2], forces: [-40, -20, 20, 40]}",
     [](double e) { return e < 0     ? 50 + 2050 * e
                           : e < 0.1 ? 50 + 1000 * e
                                     : 150 + 4000 * (e - 0.1); },
     [](double rate) {
       const double size = std::abs(rate);
       return std::copysign(size < 0.2 ? 100 * size : 20 + (size - 0.2) * 20 / 1.8, rate);
     }}};

/// Swings from the horizontal past the bottom.
TEST_P(Pendulums, SwingAsTheEquationsOfMotionSay) {
  for (const auto& [connector, spring, dashpot] : hung) {
    Pendulum apart{.spring = spring, .dashpot = dashpot};
    apart.run(1, 20000);
    Simulation plane(test::study_of(bob(connector, GetParam().time, falls)));
    while (!plane.finished())
      ASSERT_TRUE(plane.advance().accepted());
    EXPECT_LE((place_of(plane.state(), 2) - apart.place).norm(), GetParam().error) << connector;
    const auto energy = plane.energy();
    EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest()) << connector;
    EXPECT_GT(energy.strain, 0);
  }
}

TEST_P(Pendulums, SwingInSpace) {
  for (const auto& [connector, spring, dashpot] : hung) {
    Pendulum apart{.velocity = {0, 2, 0.5}, .weight = {0, 0, -gravity}, .spring = spring, .dashpot = dashpot};
    apart.run(1, 20000);
    Simulation solid(test::study_of(solid_bob(connector, GetParam().time)));
    while (!solid.finished())
      ASSERT_TRUE(solid.advance().accepted());
    EXPECT_LE((place_of(solid.state(), 3) - apart.place).norm(), GetParam().error) << connector;
    const auto energy = solid.energy();
    EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest()) << connector;
  }
}

/// The ledger goes on with the same bits, too.
TEST_P(Pendulums, GoOnFromAMementoToTheSameBits) {
  const auto study = test::study_of(bob(hung[2].connector, GetParam().time, falls));
  Simulation whole(study);
  std::vector<Memento> mementos;
  while (!whole.finished()) {
    ASSERT_TRUE(whole.advance().accepted());
    mementos.push_back(whole.memento());
  }
  for (std::size_t i = 0; i < mementos.size(); i += mementos.size() / 5) {
    Simulation rest(study, {.memento = &mementos[i]});
    while (!rest.finished())
      ASSERT_TRUE(rest.advance().accepted());
    EXPECT_EQ(rest.state().motion.u, whole.state().motion.u) << "from t = " << mementos[i].state.t;
    EXPECT_EQ(rest.energy().balance(), whole.energy().balance());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, Pendulums,
    testing::Values(Course{"Newmark", "{scheme: newmark, step: 1e-3, end: 1}", 1e-4},
                    Course{"Hht", "{scheme: hht, alpha: -0.1, step: 1e-3, end: 1}", 1e-4},
                    Course{"GeneralizedAlpha", "{scheme: generalized_alpha, step: 1e-3, end: 1}", 1e-4},
                    Course{"MoreauJean", "{scheme: moreau_jean, step: 1e-3, end: 1}", 1e-4},
                    Course{"EnergyMomentum", "{scheme: energy_momentum, step: 1e-3, end: 1}", 1e-4},
                    Course{"CentralDifference", "{scheme: central_difference, record: 1e-3, end: 1}", 1e-3}),
    [](const auto& info) { return info.param.name; });

/// At the bottom a stiff bar that fell from the horizontal carries three times the weight.
TEST(RotatingConnectors, CarryThreeTimesTheWeightAtTheBottom) {
  test::Walk walk(bob("stiffness: 1e6", "{scheme: newmark, step: 5e-4, end: 0.7}", falls));
  double largest = 0, passed = 0;
  walk.accepted = [&] {
    const auto place = place_of(walk.state(), 2);
    largest = std::max(largest, 1e6 * (place.norm() - 1));
    const auto before = place_of(walk.before, 2);
    if (before[0] > 0 && place[0] <= 0)
      passed = walk.before.t + walk.length() * before[0] / (before[0] - place[0]);
  };
  ASSERT_TRUE(walk.to_end());
  EXPECT_NEAR(largest, 3 * mass * gravity, 0.01 * 3 * mass * gravity);
  const double quarter = std::comp_ellint_1(std::numbers::sqrt2 / 2) / std::sqrt(gravity);
  EXPECT_NEAR(passed, quarter, 1e-3 * quarter);
}

/// With steps of a twentieth of the radial period.
TEST(RotatingConnectors, KeepEnergyAndAngularMomentumOverLongSteps) {
  const std::string thrown = "initial: [{on: all, velocity: {x: 1, y: 3}}]\n";
  for (const auto& law :
       {hung[0].connector, std::string("force: {elongations: [-1, 0, 0.1, 1], forces: [-2000, "
                                       "50, 150, 3750]}")}) {
    test::Walk walk(bob(law, "{scheme: energy_momentum, step: 0.02, end: 10}", thrown));
    ASSERT_TRUE(walk.to_end());
    const auto energy = walk.simulation.energy();
    EXPECT_NEAR(energy.stored(), energy.start, 1e-9 * energy.start);
    EXPECT_EQ(energy.bulk_scheme, 0);
    const auto place = place_of(walk.state(), 2);
    const auto& v = walk.state().motion.v;
    EXPECT_NEAR(place[0] * v[1] - place[1] * v[0], 3, 1e-9);
  }
}

/// Runs of a block that deforms, hung to another one by its middle: mass that is lumped at nodes turns less
/// easily.
TEST(RotatingConnectors, SwingAlikeInExplicitAndImplicitRuns) {
  const auto deck = [](const std::string& time) {
    return R"(mesh:
  generate:
    - {name: bob, rectangle: {from: [0.9, -0.1], to: [1.1, 0.1]}, divisions: [2, 2], cells: quad4}
    - {name: post, rectangle: {from: [-0.1, -0.1], to: [0.1, 0.1]}, divisions: [2, 2], cells: quad4, sides: {left: held}}
physics: plane_stress
materials: {any: {young: 1e6, poisson: 0.3, density: 1000, strain: green_lagrange}}
relations: {hub: {embedded: {at: [0.03, 0.02], in: post}}, eye: {embedded: {at: [1, 0], in: bob}}}
connectors: [{on: hub, to: eye, rotates: true, stiffness: 5e3, damping: 20}]
supports: [{on: held, fix: [x, y]}]
loads: [{gravity: {y: -9.81, on: bob}}]
newton: {residual: 1e-10}
time: )" + time +
           "\n";
  };
  Simulation implicit(test::study_of(deck("{scheme: newmark, step: 5e-4, end: 0.8}")));
  Simulation explicitly(test::study_of(deck("{scheme: central_difference, record: 5e-4, end: 0.8}")));
  for (auto* run : {&implicit, &explicitly}) {
    while (!run->finished())
      ASSERT_TRUE(run->advance().accepted());
    const auto energy = run->energy();
    EXPECT_NEAR(energy.balance(), 0, 1e-9 * energy.largest());
    EXPECT_GT(energy.damping, 0);
  }
  const auto& u = implicit.state().motion.u;
  EXPECT_GT(u.lpNorm<Eigen::Infinity>(), 1);
  EXPECT_LE((explicitly.state().motion.u - u).lpNorm<Eigen::Infinity>(), 2e-3 * u.lpNorm<Eigen::Infinity>());
}

/// Swings onto a table and rubs on it.
TEST(RotatingConnectors, HangInContactAlikeInWholeSteps) {
  const auto deck = [](const std::string& solver) {
    return R"(mesh:
  generate:
    - {name: bob, rectangle: {from: [0.9, -0.1], to: [1.1, 0.1]}, divisions: [2, 2], cells: quad4, sides: {bottom: under}}
    - {name: table, rectangle: {from: [-0.6, -1.4], to: [0.9, -1.05]}, divisions: [9, 2], cells: quad4, sides: {top: over, bottom: ground}}
physics: plane_strain
materials: {any: {young: 1e6, poisson: 0.3, density: 1000, strain: green_lagrange}}
relations: {eye: {embedded: {at: [1, 0], in: bob}}}
connectors: [{on: eye, anchor: [0, 0], rotates: true, stiffness: 1e4, damping: 50}]
supports: [{on: ground, fix: [x, y]}]
loads: [{gravity: {y: -9.81, on: bob}}]
contact: {foot: {master: over, slave: under, integration: nodes, friction: 0.2}}
newton: {residual: 1e-11}
time: {scheme: moreau_jean, step: 5e-3, end: 0.7}
solver: )" +
           solver + "\n";
  };
  test::Walk condensed(deck("condensed"));
  test::Walk full(deck("full"));
  ASSERT_TRUE(condensed.to_end());
  ASSERT_TRUE(full.to_end());
  const auto& u = full.state().motion.u;
  EXPECT_LE((condensed.state().motion.u - u).lpNorm<Eigen::Infinity>(), 1e-8 * u.lpNorm<Eigen::Infinity>());
  for (const auto* walk : {&condensed, &full}) {
    const auto energy = walk->simulation.energy();
    EXPECT_GT(energy.friction, 0);
    EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest());
  }
}

std::string list_of(const Vector3d& x) {
  return fmt::format("[{:.17g}, {:.17g}]", x[0], x[1]);
}

struct Pull {
  Vector3d anchor;
  std::string law;
};

/// A block around the origin that only translates, on connectors to anchors, under a load; all turned by an
/// angle. Returns where it comes to, turned back.
Vector3d rest_of(const std::vector<Pull>& pulls, const Vector3d& load, double angle = 0) {
  const auto turned = [&](const Vector3d& x, double by) {
    return Vector3d(std::cos(by) * x[0] - std::sin(by) * x[1], std::sin(by) * x[0] + std::cos(by) * x[1], 0);
  };
  std::string connectors;
  for (const auto& [anchor, law] : pulls)
    connectors +=
        fmt::format("  - {{on: eye, anchor: {}, rotates: true, {}}}\n", list_of(turned(anchor, angle)), law);
  const auto force = turned(load, angle);
  test::Walk walk(fmt::format(
      R"(mesh: {{generate: [{{name: bob, rectangle: {{from: [-0.05, -0.05], to: [0.05, 0.05]}}, divisions: [1, 1], cells: quad4, points: {{left_bottom: corner}}}}]}}
physics: plane_stress
materials: {{any: {{young: 1e4, poisson: 0}}}}
relations: {{stiff: {{equal: {{on: bob}}}}, eye: {{embedded: {{at: [0, 0], in: bob}}}}}}
connectors:
{}loads: [{{nodal_force: {{on: corner, x: {:.17g}, y: {:.17g}, function: rise}}}}]
functions: {{rise: {{ramp: {{begin: 0, end: 1}}}}}}
newton: {{residual: 1e-13}}
time: {{scheme: static, step: 0.1, end: 1}}
)",
      connectors, force[0], force[1]));
  EXPECT_TRUE(walk.to_end());
  const auto energy = walk.simulation.energy();
  EXPECT_NEAR(energy.balance(), 0, 1e-11 * energy.largest());
  const auto& u = walk.state().motion.u;
  return turned({u[0], u[1], 0}, -angle);
}

/// f(x) = 0 between two places of unlike signs.
double root_of(const std::function<double(double)>& f, double low, double high) {
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(low) < 0) == (f(middle) < 0) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Bars from (±1, -0.3) up to the origin, pressed down, short of the limit load.
TEST(RotatingConnectors, CarryATrussAsTheClosedFormSays) {
  constexpr double stiffness = 1000, height = 0.3, load = 8;
  const auto resisting = [&](double y) {
    const double l = std::hypot(1, height + y);
    return 2 * stiffness * (l - std::hypot(1, height)) * (height + y) / l + load;
  };
  const double expected = root_of(resisting, -0.1, 0);
  const std::vector<Pull> bars{{{-1, -height, 0}, "stiffness: 1000"}, {{1, -height, 0}, "stiffness: 1000"}};
  const auto moved = rest_of(bars, {0, -load, 0});
  EXPECT_NEAR(moved[1], expected, 1e-12);
  EXPECT_NEAR(moved[0], 0, 1e-13);
}

/// A rope between (±1, 0) with a tension of 50, pulled aside.
TEST(RotatingConnectors, CarryARopeAsTheClosedFormSays) {
  const auto resisting = [](double y) {
    const double l = std::hypot(1, y);
    return 2 * (50 + 200 * (l - 1)) * y / l - 30;
  };
  const std::string law = "force: {elongations: [0, 1], forces: [50, 250]}";
  const auto moved = rest_of({{{-1, 0, 0}, law}, {{1, 0, 0}, law}}, {0, 30, 0});
  EXPECT_NEAR(moved[1], root_of(resisting, 0, 1), 1e-12);
}

TEST(RotatingConnectors, TurnWithTheWholeProblem) {
  const std::vector<Pull> pulls{{{-1, 0.2, 0}, "stiffness: 100"},
                                {{0.3, 1.1, 0}, "force: {elongations: [-1, 0, 1], forces: [-50, 20, 200]}"},
                                {{0.8, -0.9, 0}, "stiffness: 40"}};
  const Vector3d load(30, -25, 0);
  const auto moved = rest_of(pulls, load);
  EXPECT_GT(moved.norm(), 0.1);
  for (const double angle : {0.7, 1.9, -2.8})
    EXPECT_LE((rest_of(pulls, load, angle) - moved).norm(), 1e-12) << angle;
}

/// Past its limit load and through: the factor of the load is that of the closed form at each height.
TEST(RotatingConnectors, FollowASnapThrough) {
  test::Walk walk(
      R"(mesh: {generate: [{name: bob, rectangle: {from: [-0.05, -0.05], to: [0.05, 0.05]}, divisions: [1, 1], cells: quad4, points: {left_bottom: corner}}]}
physics: plane_stress
materials: {any: {young: 1e7, poisson: 0}}
relations: {stiff: {equal: {on: bob}}, eye: {embedded: {at: [0, 0], in: bob}}}
connectors:
  - {on: eye, anchor: [-1, -0.3], rotates: true, stiffness: 1000}
  - {on: eye, anchor: [1, -0.3], rotates: true, stiffness: 1000}
loads: [{nodal_force: {on: corner, y: -1}}]
newton: {residual: 1e-11}
time: {scheme: static, step: 0.02, end: 1, arc_length: {length: 0.8, on: corner}}
)");
  double largest = 0, least = 0;
  walk.accepted = [&] {
    const double y = walk.state().motion.u[1], l = std::hypot(1, 0.3 + y);
    const double factor = walk.state().load_factor;
    EXPECT_NEAR(factor, -2000 * (l - std::hypot(1, 0.3)) * (0.3 + y) / l, 1e-8);
    largest = std::max(largest, factor);
    least = std::min(least, factor);
  };
  ASSERT_TRUE(walk.to_end());
  EXPECT_LT(walk.state().motion.u[1], -0.6);
  EXPECT_GT(largest, 9);
  EXPECT_LT(least, -9);
}

/// A body is turned by 90 degrees about a place beside the anchor; another one hangs at it.
TEST(RotatingConnectors, HaveTheForceOfTheirElongationWhereSupportsTurnThem) {
  test::Walk walk(R"(mesh:
  generate:
    - {name: wheel, rectangle: {from: [0.9, -0.1], to: [1.1, 0.1]}, divisions: [1, 1], cells: quad4}
    - {name: rest, rectangle: {from: [5, 0], to: [6, 1]}, divisions: [1, 1], cells: quad4, sides: {left: held}}
physics: plane_stress
materials: {any: {young: 1e5, poisson: 0.3, strain: green_lagrange}}
relations: {eye: {embedded: {at: [1, 0], in: wheel}}}
connectors: [{on: eye, anchor: [0, 0], rotates: true, force: {elongations: [-1, 1], forces: [-300, 500]}}]
supports: [{on: wheel, rotate: {about: [0.2, 0.1], angle: 1.5707963267948966*t}}, {on: held, fix: [x, y]}]
time: {scheme: static, step: 0.1, end: 1}
)");
  walk.accepted = [&] {
    const double angle = std::numbers::pi / 2 * walk.state().t, c = std::cos(angle), s = std::sin(angle);
    const Vector3d place(0.2 + 0.8 * c + 0.1 * s, 0.1 + 0.8 * s - 0.1 * c, 0);
    const double force = 100 + 400 * (place.norm() - 1);
    Vector3d reaction = Vector3d::Zero();
    for (const auto node : walk.model.dofs.nodes)
      if (walk.model.mesh.points[static_cast<std::size_t>(node)][0] < 2)
        for (int i = 0; i < 2; ++i)
          reaction[i] += walk.state().reaction[walk.model.dofs.dof(node, i)];
    EXPECT_LE((reaction - force * place.normalized()).norm(), 1e-9 * force) << walk.state().t;
  };
  ASSERT_TRUE(walk.to_end());
  const auto energy = walk.simulation.energy();
  EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest());
}

/// Stiffened across by the force that the connector has at rest: ω² = N/(m l), along it ω² = k/m.
TEST(RotatingConnectors, StiffenNaturalModesByTheirForce) {
  const auto study = modes::modal_study(test::study_of(
      bob("force: {elongations: [-1, 1], forces: [-350, 450]}", "{scheme: newmark, step: 1, end: 1}")));
  const test::BuiltModel model(study);
  const auto found = modes::modes_of(model, {.number = 2});
  EXPECT_NEAR(found.frequencies[0], std::sqrt(50 / mass) / (2 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(found.frequencies[1], std::sqrt(400 / mass) / (2 * std::numbers::pi), 1e-9);
}

/// Total forces of the ring: a cone of springs.
TEST(RotatingConnectors, PullRingsAlongCones) {
  test::Walk walk(
      R"(mesh: {generate: [{name: ring, rectangle: {from: [0.95, -0.05], to: [1.05, 0.05]}, divisions: [1, 1], cells: quad4, points: {left_bottom: corner}}]}
physics: axisymmetric
materials: {any: {young: 1e4, poisson: 0}}
relations: {stiff: {equal: {on: ring, in: [x, y]}}, eye: {embedded: {at: [1, 0], in: ring}}}
connectors: [{on: eye, anchor: [0.4, 0.8], rotates: true, force: {elongations: [-1, 1], forces: [-190, 210]}}]
supports: [{on: ring, fix: x}]
loads: [{nodal_force: {on: corner, y: -50, function: rise}}]
functions: {rise: {ramp: {begin: 0, end: 1}}}
newton: {residual: 1e-12}
time: {scheme: static, step: 0.1, end: 1}
)");
  ASSERT_TRUE(walk.to_end());
  const auto resisting = [](double y) {
    const double l = std::hypot(0.6, 0.8 - y);
    return (10 + 200 * (l - 1)) * (0.8 - y) / l - 50;
  };
  EXPECT_NEAR(walk.state().motion.u[1], root_of(resisting, -2, 0.5), 1e-10);
}

TEST(RotatingConnectors, FailByNameWhereTheirEndsComeTogether) {
  test::Walk walk(bob("stiffness: 100", "{scheme: static, step: 0.25, end: 1, on_failure: {levels: 0}}",
                      "supports: [{on: bob, fix: y}]\nloads: [{nodal_force: {on: eye, x: -150, function: "
                      "f}}]\nfunctions: {f: {times: [0, 1], values: [0, 1]}}\n"));
  EXPECT_FALSE(walk.to_end());
  const auto& report = walk.reports.back();
  ASSERT_TRUE(report.failed_cell);
  EXPECT_EQ(report.failed_cell->reason, element::Failure::no_length);
  EXPECT_TRUE(walk.state().motion.u.allFinite());
  EXPECT_STREQ(element::described(report.failed_cell->reason),
               "a connector with rotates: true ends there, and its two ends come together: without length it "
               "has no direction");
}

TEST(RotatingConnectors, AreRefusedWhereTheyHaveNoLine) {
  const auto fault = [](const std::string& connector) {
    return test::fault_of([&] {
      test::Walk(fmt::format(
          R"(mesh: {{generate: [{{name: bar, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [1, 1], cells: quad4, sides: {{left: left}}, points: {{left_bottom: a, right_top: b}}}}]}}
physics: plane_stress
materials: {{any: {{young: 1, poisson: 0}}}}
relations: {{eye: {{embedded: {{at: [0, 0], in: bar}}}}}}
supports: [{{on: left, fix: [x, y]}}]
connectors: [{{stiffness: 1, {}}}]
time: {{scheme: static, step: 1, end: 1}}
)",
          connector));
    });
  };
  const auto expect = [&](const std::string& connector, const std::string& text) {
    EXPECT_NE(fault(connector).find(text), std::string::npos) << fault(connector);
  };
  expect("on: a, to: b, along: [1, 0], rotates: true", "found a fixed direction beside rotates: true");
  expect("on: a, rotates: true", "has rotates: true and one end; expected 'to', or 'anchor'");
  expect("on: a, to: b, anchor: [3, 4], rotates: true", "found 'to' and 'anchor', expected one of the two");
  expect("on: a, to: b, anchor: [3, 4]", "only connectors with rotates: true have an anchor");
  expect("on: a, to: eye, rotates: true", "'a' and 'eye' are at the same place, expected two places");
  expect("on: left, anchor: [0, 1], rotates: true",
         "'left' is at the anchor, expected an anchor at another place");
  expect("on: a, to: b, rotates: 3", "rotates");
}

} // namespace
} // namespace rubato::simulation::rotating_connectors_test
