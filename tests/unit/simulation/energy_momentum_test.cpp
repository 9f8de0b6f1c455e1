// SPDX-License-Identifier: LGPL-3.0-or-later
/// The scheme energy_momentum, from decks: what elastic bodies in finite strain keep, alone, in contact,
/// under loads, and how its steps are solved.
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/step/energy.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::simulation::energy_momentum_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/// Groups of one node each, and their velocities.
struct Throw {
  std::string groups, initial;

  void add(const Vector3d& place, const Vector3d& velocity, int components) {
    const auto list = [&](const Vector3d& x) {
      return components == 2 ? fmt::format("[{}, {}]", x[0], x[1])
                             : fmt::format("[{}, {}, {}]", x[0], x[1], x[2]);
    };
    const auto name = fmt::format("at{}", count_++);
    const Vector3d around = Vector3d::Constant(0.1);
    groups += fmt::format("    {}: {{box: {{from: {}, to: {}}}, take: nodes}}\n", name, list(place - around),
                          list(place + around));
    initial += fmt::format("  - {{on: {}, velocity: {{x: {}, y: {}{}}}}}\n", name, velocity[0], velocity[1],
                           components == 2 ? "" : fmt::format(", z: {}", velocity[2]));
  }

private:
  int count_ = 0;
};

/// A block 1×3, or 1×1×3, of three cells of density 1 that flies, turns and stretches.
std::string thrown(int components, const std::string& material, const std::string& time) {
  const Vector3d turn = components == 2 ? Vector3d(0, 0, 3) : Vector3d(2, 3, 1);
  const int along = components - 1;
  Throw all;
  for (int level = 0; level <= 3; ++level)
    for (int corner = 0; corner < 2 * along; ++corner) {
      Vector3d x(corner % 2, corner / 2, 0);
      x[along] = level;
      Vector3d v = turn.cross(x) + Vector3d(3, 1, components == 2 ? 0 : -2);
      v[along] += 2.5 * (level - 1.5);
      all.add(x, v, components);
    }
  const auto* shape = components == 2
                          ? "rectangle: {from: [0, 0], to: [1, 3]}, divisions: [1, 3], cells: quad4"
                          : "box: {from: [0, 0, 0], to: [1, 1, 3]}, divisions: [1, 1, 3], cells: hexa8";
  return fmt::format(
      "mesh:\n  generate: [{{name: block, {}}}]\n  groups:\n{}physics: {}\nmaterials: {{any: {{{}, "
      "density: 1}}}}\ninitial:\n{}newton: {{residual: 1e-13}}\ntime: {}\n",
      shape, all.groups, components == 2 ? "plane_strain" : "solid", material, all.initial, time);
}

std::string plane_block(const std::string& material, const std::string& time) {
  return thrown(2, material, time);
}

std::string solid_block(const std::string& material, const std::string& time) {
  return thrown(3, material, time);
}

const std::string mooney = "law: hyperelastic, c10: 50, c01: 10, bulk: 1000";
const std::string tumbling = "{scheme: energy_momentum, step: 0.02, end: 4}";

Vector3d angular_momentum(const test::Walk& walk) {
  const auto& motion = walk.state().motion;
  const auto& dofs = walk.model.dofs;
  const VectorXd momentum = walk.model.mass * motion.v;
  Vector3d sum = Vector3d::Zero();
  for (const auto node : dofs.nodes) {
    Vector3d x = walk.model.mesh.points[static_cast<std::size_t>(node)], p = Vector3d::Zero();
    x.head(dofs.components) += motion.u.segment(dofs.dof(node, 0), dofs.components);
    p.head(dofs.components) = momentum.segment(dofs.dof(node, 0), dofs.components);
    sum += x.cross(p);
  }
  return sum;
}

/// Largest changes by the values at the start.
struct Drift {
  double energy = 0, angular_momentum = 0;
  double most_strain = 0; ///< by the energy
  double balance = 0;     ///< by the largest entry
};

Drift drift_of(test::Walk& walk) {
  const auto& ledger = walk.simulation.energy();
  const double energy = ledger.stored();
  const Vector3d momentum = angular_momentum(walk);
  Drift drift;
  walk.accepted = [&] {
    drift.energy = std::max(drift.energy, std::abs(ledger.stored() - energy) / energy);
    drift.angular_momentum =
        std::max(drift.angular_momentum, (angular_momentum(walk) - momentum).norm() / momentum.norm());
    drift.most_strain = std::max(drift.most_strain, ledger.strain / energy);
    drift.balance = std::max(drift.balance, std::abs(ledger.balance()) / ledger.largest());
  };
  EXPECT_TRUE(walk.to_end());
  return drift;
}

struct Tumble {
  std::string name;
  std::string deck;
};

const std::vector<Tumble> every_tumble{
    {"Mooney", plane_block(mooney, tumbling)},
    {"MooneyFull", plane_block(mooney + ", formulation: full", tumbling)},
    {"Yeoh", plane_block("law: yeoh, c10: 50, c20: -2, c30: 3, bulk: 1000", tumbling)},
    {"Ogden",
     plane_block("law: ogden, terms: [{shear: 80, exponent: 1.3}, {shear: 40, exponent: -2}], bulk: 1000",
                 tumbling)},
    {"Logarithmic", plane_block("young: 300, poisson: 0.3, strain: logarithmic", tumbling)},
    {"LogarithmicMeanDilatation",
     plane_block("young: 300, poisson: 0.3, strain: logarithmic, formulation: mean_dilatation", tumbling)},
    {"GreenLagrange", plane_block("young: 300, poisson: 0.3, strain: green_lagrange", tumbling)},
    {"GreenLagrangeEnhanced",
     plane_block("young: 300, poisson: 0.3, strain: green_lagrange, formulation: enhanced", tumbling)},
    {"SolidMooney", solid_block(mooney, tumbling)},
    {"SolidGreenLagrangeEnhanced",
     solid_block("young: 300, poisson: 0.3, strain: green_lagrange, formulation: enhanced", tumbling)},
};

class Tumbling : public testing::TestWithParam<Tumble> {};

TEST_P(Tumbling, KeepsEnergyAndAngularMomentum) {
  test::Walk walk(GetParam().deck);
  const auto drift = drift_of(walk);
  EXPECT_LE(drift.energy, 1e-12);
  EXPECT_LE(drift.angular_momentum, 1e-12);
  EXPECT_LE(drift.balance, 1e-12);
  EXPECT_EQ(walk.simulation.energy().bulk_scheme, 0);
  EXPECT_GT(drift.most_strain, 0.02) << "too stiff to tell anything";
}

INSTANTIATE_TEST_SUITE_P(Of, Tumbling, testing::ValuesIn(every_tumble),
                         [](const auto& chosen) { return chosen.param.name; });

/// The trapezoidal rule does not, and the ledger tells all of it.
TEST(TumblingBlock, LosesThemByNewmark) {
  test::Walk walk(plane_block(mooney, "{scheme: newmark, step: 0.02, end: 4}"));
  const double start = walk.simulation.energy().stored();
  const auto drift = drift_of(walk);
  EXPECT_GT(drift.energy, 1e-3);
  EXPECT_GT(drift.angular_momentum, 1e-4);
  const auto& ledger = walk.simulation.energy();
  EXPECT_NEAR(ledger.stored() - start, -ledger.bulk_scheme, 1e-10 * start);
}

double place_with(double step) {
  test::Walk walk(plane_block(mooney, fmt::format("{{scheme: energy_momentum, step: {}, end: 0.2}}", step)));
  EXPECT_TRUE(walk.to_end());
  return walk.displacement(walk.node_at(1, 3), 0);
}

TEST(TumblingBlock, HasAnErrorOfSecondOrderInTheStep) {
  const double coarse = place_with(1e-3), half = place_with(5e-4), quarter = place_with(2.5e-4);
  EXPECT_GT(std::abs(half - quarter), 1e-8);
  EXPECT_NEAR((coarse - half) / (half - quarter), 4, 0.3);
}

/// Where no material is nonlinear it is the middle rule, as is that other scheme.
TEST(LinearBodies, MoveAsByMoreauAndJean) {
  const auto deck = [](const std::string& scheme) {
    return fmt::format(
        R"(mesh: {{generate: [{{name: beam, rectangle: {{from: [0, 0], to: [4, 1]}}, divisions: [6, 2], sides: {{left: left, right: right, bottom: under}}}}]}}
physics: plane_strain
materials: {{any: {{young: 1000, poisson: 0.3, density: 1, rayleigh: {{stiffness: 1e-3}}, expansion: 1e-3, reference_temperature: 0}}}}
functions: {{warm: {{ramp: [0, 1]}}}}
supports: [{{on: left, fix: [x, y]}}]
temperature: [{{on: beam, value: 20, function: warm}}]
loads: [{{surface_force: {{on: right, y: -5}}}}]
connectors: [{{on: right, along: [0, 1], force: {{elongations: [-1, 0, 1], forces: [-40, 0, 10]}}}}]
contact: {{floor: {{slave: under, obstacle: {{plane: {{point: [0, -0.02], normal: [0, 1]}}}}, friction: 0.2, exclude_nodes: [left]}}}}
newton: {{residual: 1e-12}}
time: {{scheme: {}, step: 0.02, end: 0.6}}
)",
        scheme);
  };
  test::Walk one(deck("energy_momentum")), other(deck("moreau_jean"));
  ASSERT_TRUE(one.model.domain.is_linear());
  ASSERT_TRUE(one.to_end() && other.to_end());
  const auto& u = other.state().motion.u;
  EXPECT_GT(step::points_in_contact(other.state()), 0);
  EXPECT_LE((one.state().motion.u - u).norm(), 1e-10 * u.norm());
  const auto &energy = one.simulation.energy(), &expected = other.simulation.energy();
  EXPECT_LE(std::abs(energy.balance()), 1e-12 * energy.largest());
  for (const auto entry :
       {&step::EnergyLedger::kinetic, &step::EnergyLedger::strain, &step::EnergyLedger::damping,
        &step::EnergyLedger::heat, &step::EnergyLedger::numerical, &step::EnergyLedger::support_work})
    EXPECT_NEAR(energy.*entry, expected.*entry, 1e-9 * energy.largest());
}

/// Balance, and no gain but by rounding, at every instant.
void expect_no_gain(test::Walk& walk) {
  step::EnergyRecord record;
  bool touched = false;
  double gain = 0; // what iterations left unbalanced does not count
  walk.accepted = [&] {
    const auto& ledger = walk.simulation.energy();
    record.note(walk.state().t, ledger);
    gain = std::max(gain, ledger.gain() - ledger.unbalanced);
    touched = touched || step::points_in_contact(walk.state()) > 0;
  };
  ASSERT_TRUE(walk.to_end());
  EXPECT_TRUE(touched);
  EXPECT_EQ(step::points_in_contact(walk.state()), 0) << "it must have bounced off";
  EXPECT_LE(record.largest_balance, 1e-12 * record.largest);
  EXPECT_LE(gain, 1e-12 * record.largest);
  EXPECT_LE(std::abs(walk.simulation.energy().unbalanced), 1e-10 * record.largest);
  EXPECT_GT(walk.simulation.energy().friction, 1e-4 * record.largest);
  EXPECT_EQ(walk.simulation.energy().bulk_scheme, 0);
}

/// A block that falls, slides and turns.
std::string thrown_block(const std::string& material, const std::string& more) {
  return fmt::format(
      R"(mesh:
  generate:
    - {{name: block, rectangle: {{from: [0, 0.2], to: [1, 1.2]}}, divisions: [3, 3], cells: quad4, sides: {{bottom: under}}}}
    - {{name: table, rectangle: {{from: [-2, -1], to: [4, 0]}}, divisions: [12, 2], cells: quad4, sides: {{top: over, bottom: ground}}}}
physics: plane_strain
materials: {{any: {{{}, density: 1}}}}
supports: [{{on: ground, fix: [x, y]}}]
initial: [{{on: block, velocity: {{x: 1, y: -2}}}}]
newton: {{residual: 1e-12}}
{})",
      material, more);
}

const std::vector<std::string> bouncing_materials{
    mooney, "young: 300, poisson: 0.3, strain: logarithmic",
    "young: 300, poisson: 0.3, strain: green_lagrange, formulation: enhanced"};

TEST(BouncingBlock, GainsNothingOnAnObstacle) {
  for (const auto& material : bouncing_materials)
    for (const auto* mass : {"redistributed", "consistent"}) {
      SCOPED_TRACE(material + mass);
      test::Walk walk(thrown_block(
          material,
          fmt::format(
              "contact: {{floor: {{slave: under, obstacle: {{plane: {{point: [0, 0], normal: [0, 1]}}}}, "
              "friction: 0.3}}}}\ntime: {{scheme: energy_momentum, contact_mass: {}, step: 0.01, end: 1}}\n",
              mass)));
      expect_no_gain(walk);
    }
}

TEST(BouncingBlock, GainsNothingOnAnotherBody) {
  for (const auto& material : bouncing_materials)
    for (const auto* integration : {"mortar", "nodes"}) {
      SCOPED_TRACE(material + integration);
      test::Walk walk(thrown_block(
          material, fmt::format("contact: {{floor: {{slave: under, master: over, friction: 0.3, integration: "
                                "{}}}}}\ntime: {{scheme: energy_momentum, step: 0.01, end: 1}}\n",
                                integration)));
      expect_no_gain(walk);
    }
}

/// A beam that is turned by its end, pressed by what follows its face, and damped.
std::string driven_beam(const std::string& time, const std::string& more = "newton: {residual: 1e-12}\n") {
  return fmt::format(
      R"(mesh: {{generate: [{{name: beam, rectangle: {{from: [0, 0], to: [4, 1]}}, divisions: [6, 2], cells: quad4, sides: {{left: left, top: top}}}}]}}
physics: plane_strain
materials: {{any: {{young: 20000, poisson: 0.3, density: 1, strain: green_lagrange, rayleigh: {{stiffness: 1e-4, mass: 0.1}}}}}}
functions: {{ramp: {{ramp: [0, 0.5]}}}}
supports: [{{on: left, rotate: {{about: [0, 0.5], angle: '0.5*pi*t^2'}}}}]
loads: [{{pressure: {{on: top, value: 20, function: ramp, follower: true}}}}, {{gravity: {{y: -3}}}}]
time: {}
{})",
      time, more);
}

TEST(DrivenBeam, ClosesItsLedger) {
  test::Walk walk(driven_beam("{scheme: energy_momentum, step: 0.02, end: 1}"));
  const auto drift = drift_of(walk);
  EXPECT_LE(drift.balance, 1e-12);
  const auto& ledger = walk.simulation.energy();
  EXPECT_GT(std::abs(ledger.support_work), 0);
  EXPECT_GT(std::abs(ledger.external_work), 0);
  EXPECT_GT(ledger.damping, 0);
  EXPECT_EQ(ledger.bulk_scheme, 0);
  EXPECT_LE(std::abs(ledger.numerical), 1e-12 * ledger.largest());
}

/// Steps grow up to what converges, are cut beyond, and nothing is lost by either.
TEST(StepsOfManyLengths, KeepEnergyAndAngularMomentum) {
  test::Walk walk(plane_block(mooney, "{scheme: energy_momentum, step: 0.02, max_step: 0.6, end: 4}"));
  std::vector<double> lengths;
  double last = 0;
  const auto& ledger = walk.simulation.energy();
  const double energy = ledger.stored();
  const Vector3d momentum = angular_momentum(walk);
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    lengths.push_back(walk.state().t - last);
    last = walk.state().t;
    EXPECT_NEAR(ledger.stored(), energy, 1e-12 * energy);
    EXPECT_LE((angular_momentum(walk) - momentum).norm(), 1e-12 * momentum.norm());
  }
  EXPECT_GT(*std::ranges::max_element(lengths), 2 * *std::ranges::min_element(lengths));
}

/// The exact tangent, in `full`, and the symmetric one near it lead to the same answer; the first in fewer
/// iterations.
TEST(TangentsOfTheStep, LeadToTheSameAnswer) {
  const std::string time = "{scheme: energy_momentum, step: 0.05, end: 1}";
  const auto iterations_of = [](test::Walk& walk) {
    int sum = 0;
    EXPECT_TRUE(walk.to_end());
    for (const auto& report : walk.reports)
      sum += report.bulk_iterations;
    return sum;
  };
  test::Walk near(driven_beam(time, "newton: {tangent: full, residual: 1e-12}\n"));
  test::Walk exact(driven_beam(time, "solver: full\nnewton: {residual: 1e-12}\n"));
  const int by_near = iterations_of(near), by_exact = iterations_of(exact);
  EXPECT_LT(by_exact, by_near);
  const auto& u = near.state().motion.u;
  EXPECT_LE((exact.state().motion.u - u).norm(), 1e-9 * u.norm());
}

/// Where iterations with the symmetric one have no end, the exact one follows before the step is cut.
TEST(TangentsOfTheStep, AreExactWhereTheSymmetricOneHasNoEnd) {
  test::Walk walk(plane_block(mooney, "{scheme: energy_momentum, step: 0.1, end: 2}"),
                  {{"newton.max_iterations", "10"}});
  const auto drift = drift_of(walk);
  EXPECT_LE(drift.energy, 1e-12);
  EXPECT_LE(drift.angular_momentum, 1e-12);
  const auto exact = std::ranges::count_if(walk.reports, &step::StepReport::exact_tangent);
  EXPECT_GT(exact, 5);
  EXPECT_EQ(walk.simulation.counters().cuts, 0);
  for (const auto& report : walk.reports)
    EXPECT_FALSE(report.indefinite);
}

} // namespace
} // namespace rubato::simulation::energy_momentum_test
