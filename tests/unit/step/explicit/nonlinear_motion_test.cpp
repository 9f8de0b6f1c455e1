// SPDX-License-Identifier: LGPL-3.0-or-later
// Explicit motion of bodies that yield, creep and stretch.
#include "rubato/constraint/reduction.hpp"
#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/cell_rates.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/dense.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

namespace rubato::step::nonlinear_motion_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

test::BuiltModel model_of(const std::string& deck) {
  return test::BuiltModel(deck::parse_deck(deck, "deck.yaml").runs.front());
}

/// A block of cells of side 1/2 and density 1, three of them high, held at its left end.
std::string block(const std::string& material, const std::string& physics = "plane_strain", int along = 2) {
  return R"(
mesh: {generate: [{name: block, rectangle: {from: [1, 0], to: [)" +
         std::to_string(1 + 0.5 * along) + ", 1.5]}, divisions: [" + std::to_string(along) + R"(, 3],
                   sides: {left: held, right: end, bottom: under}}],
       groups: {moving: {box: {from: [1.1, -1], to: [9, 9]}}}}
materials: {body: {density: 1, )" +
         material + "}}\nphysics: " + physics + R"(
supports: [{on: held, fix: [x, y]}]
time: {scheme: central_difference, end: 1, record: 1}
)";
}

const std::string steel = "law: plastic, young: 1, poisson: 0.3, "
                          "hardening: {linear: {yield_stress: 0.01, modulus: 0.1}}";
const std::string moving_steel = steel + ", kinematic: [{modulus: 0.3, recall: 20}, {modulus: 0.05}]";
const std::string polymer =
    "law: prony, young: 1, poisson: 0.3, terms: [{shear: 0.5, time: 0.3}, {shear: 0.2, time: 3}]";
const std::string rubber = "law: hyperelastic, c10: 0.2, c01: 0.05, bulk: 4";
const std::string spring_steel = "young: 1, poisson: 0.3, strain: green_lagrange";
const std::string logarithmic = ", strain: logarithmic";
const std::string reduced = ", formulation: reduced";

/// Steps of nine tenths of the stable one, surveys between them, to the end.
domain::Failed go(
    ExplicitMotion& motion, double end, const std::function<void()>& after_each = [] {}) {
  while (motion.t() < end) {
    motion.survey();
    const double h = 0.9 * motion.spectrum().stable_step();
    const int steps = static_cast<int>(std::ceil((end - motion.t()) / h));
    const int part = std::min(steps, motion.steps_between_surveys());
    const double to = part == steps ? end : motion.t() + (end - motion.t()) * part / steps;
    if (const auto failed = motion.advance(to, part))
      return failed;
    after_each();
  }
  return {};
}

struct Body {
  std::string name;
  std::string material;
  std::string physics = "plane_strain";
  bool finite = true;
};

void PrintTo(const Body& body, std::ostream* out) {
  *out << body.name;
}

class ExplicitBody : public testing::TestWithParam<Body> {};

/// Thrown against its support, fast enough to flow.
TEST_P(ExplicitBody, ClosesItsLedger) {
  const auto model = model_of(block(GetParam().material, GetParam().physics) +
                              "initial: [{on: moving, velocity: {x: -0.2, y: 0.1}}]\n"
                              "loads: [{surface_force: {on: end, y: 0.005}}]\n");
  ExplicitMotion motion(model);
  double most = 0, largest = 0;
  EXPECT_FALSE(go(motion, 8, [&] {
    const auto energy = motion.energy();
    most = std::max(most, std::abs(energy.balance()));
    largest = std::max(largest, energy.largest());
  }));
  EXPECT_LE(most, 1e-12 * largest);
  EXPECT_GT(motion.steps(), 20);
  const auto energy = motion.energy();
  if (GetParam().finite) {
    EXPECT_NE(energy.bulk_scheme, 0);
    EXPECT_LE(std::abs(energy.bulk_scheme), 0.15 * largest); // steps are as long as they may be
  } else {
    EXPECT_EQ(energy.bulk_scheme, 0);
  }
}

/// The sums along the path are those between records of both ends of each step.
TEST_P(ExplicitBody, HasTheWorksOfItsPointsWithoutRecords) {
  const auto model = model_of(block(GetParam().material, GetParam().physics) +
                              "initial: [{on: moving, velocity: {x: -0.2, y: 0.1}}]\n");
  ExplicitMotion motion(model);
  const auto& domain = model.domain;
  auto recorded = domain.initial_states();
  domain::QuadratureStates next;
  const VectorXd undeformed = VectorXd::Zero(model.dofs.dof_count);
  ASSERT_FALSE(
      domain.evaluate({undeformed, undeformed}, domain.initial_states(), recorded, {.records = true}));
  domain::Balance sum;
  const double h = 0.9 * motion.spectrum().stable_step();
  for (int i = 1; i <= 25; ++i) {
    const double before = motion.t();
    ASSERT_FALSE(motion.advance(i * h, 1));
    const auto u = motion.state().motion.u;
    ASSERT_FALSE(domain.evaluate({u, u, before, motion.t()}, recorded, next, {.records = true}));
    const auto step = domain.balance(recorded, next);
    sum.plastic += step.plastic;
    sum.back_stress += step.back_stress;
    sum.viscous += step.viscous;
    sum.scheme += step.scheme;
    std::swap(recorded, next);
  }
  const auto energy = motion.energy();
  const double rounding = 1e-13 * energy.largest();
  EXPECT_NEAR(energy.plastic, sum.plastic, rounding);
  EXPECT_NEAR(energy.back_stress, sum.back_stress, rounding);
  EXPECT_NEAR(energy.viscous, sum.viscous, rounding);
  EXPECT_NEAR(energy.bulk_scheme, sum.scheme, rounding);
  const auto states = motion.state().bulk_points;
  ASSERT_EQ(states.values.size(), recorded.values.size());
  for (std::size_t i = 0; i < states.values.size(); ++i)
    EXPECT_NEAR(states.values[i], recorded.values[i], 1e-14);
  EXPECT_TRUE(states.records.empty());
}

TEST_P(ExplicitBody, HasNoMemoryBesideTheOneItTells) {
  const auto model = model_of(block(GetParam().material, GetParam().physics) +
                              "initial: [{on: moving, velocity: {x: -0.2, y: 0.1}}]\n");
  ExplicitMotion motion(model);
  ASSERT_FALSE(go(motion, 1));
  const auto memory = motion.memory();
  ASSERT_FALSE(go(motion, 2));
  ExplicitMotion other(model);
  other.restore(memory);
  ASSERT_FALSE(go(other, 2));
  EXPECT_EQ(motion.steps(), other.steps());
  EXPECT_EQ(motion.state().motion.u, other.state().motion.u);
  EXPECT_EQ(motion.state().motion.v, other.state().motion.v);
  EXPECT_EQ(motion.state().bulk_points, other.state().bulk_points);
  EXPECT_EQ(motion.energy().plastic, other.energy().plastic);
  EXPECT_EQ(motion.energy().bulk_scheme, other.energy().bulk_scheme);
  EXPECT_EQ(motion.energy().strain, other.energy().strain);
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, ExplicitBody,
    testing::Values(Body{"Plastic", moving_steel, "plane_strain", false},
                    Body{"PlasticFull", moving_steel + ", formulation: full", "axisymmetric", false},
                    Body{"PlasticLogarithmic", moving_steel + logarithmic},
                    Body{"PlasticLogarithmicRing", moving_steel + logarithmic, "axisymmetric"},
                    Body{"PlasticPlate", steel + logarithmic, "plane_stress"},
                    Body{"Prony", polymer, "plane_strain", false},
                    Body{"PronyLogarithmic", polymer + logarithmic},
                    Body{"Hencky", "young: 1, poisson: 0.3, strain: logarithmic"}, Body{"Rubber", rubber},
                    Body{"RubberRing", rubber, "axisymmetric"}, Body{"RubberPlate", rubber, "plane_stress"},
                    Body{"SpringSteel", spring_steel}, Body{"SpringSteelPlate", spring_steel, "plane_stress"},
                    Body{"Reduced", "young: 1, poisson: 0.4" + reduced, "plane_strain", false},
                    Body{"PronyReduced", polymer + reduced, "axisymmetric", false},
                    Body{"RubberReduced", rubber + reduced},
                    Body{"RubberRingReduced", rubber + reduced, "axisymmetric"},
                    Body{"SpringSteelReduced", spring_steel + reduced}),
    [](const auto& each) { return each.param.name; });

TEST(ExplicitNonlinear, MovesAsALinearBodyBelowItsYieldStress) {
  const std::string motion = "loads: [{surface_force: {on: end, y: 1e-5}}]\n";
  const auto linear = model_of(block("young: 1, poisson: 0.3") + motion);
  const auto plastic = model_of(block(steel + ", formulation: full") + motion);
  ExplicitMotion one(linear), other(plastic);
  EXPECT_NEAR(other.spectrum().stiffness, one.spectrum().stiffness, 1e-10 * one.spectrum().stiffness);
  ASSERT_FALSE(one.advance(5, 100));
  ASSERT_FALSE(other.advance(5, 100));
  const auto u = one.state().motion.u;
  EXPECT_LE((u - other.state().motion.u).norm(), 1e-12 * u.norm());
  EXPECT_NEAR(one.energy().strain, other.energy().strain, 1e-12 * one.energy().strain);
  EXPECT_EQ(other.energy().plastic, 0);
}

TEST(ExplicitNonlinear, HoldsNoStiffnessOfTheWhole) {
  const auto model = model_of(block(rubber));
  EXPECT_THROW(model.domain.initial_tangent(), InputError);
  EXPECT_EQ(model_of(block("young: 1, poisson: 0.3")).domain.initial_tangent().rows(), model.dofs.dof_count);
}

/// Hourglasses of what yields give way: their work over a step is not what they store more.
TEST(ExplicitNonlinear, CountsWhatHourglassesOfSteelTake) {
  for (const auto& material : {moving_steel + reduced, moving_steel + reduced + logarithmic}) {
    const auto model = model_of(block(material) + "initial: [{on: moving, velocity: {x: -0.2, y: 0.1}}]\n");
    ExplicitMotion motion(model);
    double balance = 0, largest = 0, hourglass = 0;
    ASSERT_FALSE(go(motion, 8, [&] {
      const auto energy = motion.energy();
      balance = std::max(balance, std::abs(energy.balance()));
      largest = std::max(largest, energy.largest());
      hourglass = std::max(hourglass, energy.hourglass);
    }));
    EXPECT_LE(balance, 1e-12 * largest);
    EXPECT_GT(hourglass, 1e-4 * largest);
    EXPECT_NE(motion.energy().bulk_scheme, 0);
  }
}

/// λ_K of the first tangent is that of the matrix which an implicit run has.
TEST(ExplicitNonlinear, HasTheStableStepOfItsFirstTangent) {
  for (const auto& material : {steel, polymer, rubber, spring_steel, steel + logarithmic, rubber + reduced,
                               spring_steel + reduced}) {
    const auto model = model_of(block(material) + "springs: [{on: end, x: 0.3, y: 0.1}]\n");
    auto study = model.study;
    study.time = {};
    study.time.scheme = study::SchemeKind::newmark;
    study.time.contact_mass = study::ContactMass::consistent;
    study.time.step = study.time.end = 1;
    const test::BuiltModel implicit(study);
    VectorXd root = VectorXd::Zero(model.dofs.dof_count);
    for (const int dof : model.reduction.free_dofs())
      root[dof] = 1 / std::sqrt(model.lumped_mass[dof]);
    const MatrixXd scaled =
        root.asDiagonal() * MatrixXd(implicit.domain.initial_tangent()) * root.asDiagonal();
    const double true_one = test::symmetric_eigenvalues(scaled).maxCoeff();
    const double found = ExplicitMotion(model).spectrum().stiffness;
    EXPECT_GE(found, true_one * (1 - 1e-12)) << material;
    EXPECT_LE(found, true_one / 0.98) << material;
  }
}

/// The largest eigenvalue of the tangent as bodies stand, found by differences of forces.
double true_rate(const test::ModelParts& model, const State& state) {
  const auto& free = model.reduction.free_dofs();
  const auto size = static_cast<Eigen::Index>(free.size());
  MatrixXd scaled(size, size);
  domain::QuadratureStates unused;
  const auto forces = [&](const VectorXd& u) {
    VectorXd f;
    model.domain.evaluate({u, u, state.t, state.t}, state.bulk_points, unused, {.forces = &f});
    return f;
  };
  constexpr double small = 1e-6;
  for (Eigen::Index j = 0; j < size; ++j) {
    VectorXd more = state.motion.u, less = more;
    more[free[static_cast<std::size_t>(j)]] += small;
    less[free[static_cast<std::size_t>(j)]] -= small;
    const VectorXd column = (forces(more) - forces(less)) / (2 * small);
    for (Eigen::Index i = 0; i < size; ++i) {
      const int dof = free[static_cast<std::size_t>(i)];
      scaled(i, j) = column[dof] /
                     std::sqrt(model.lumped_mass[dof] * model.lumped_mass[free[static_cast<std::size_t>(j)]]);
    }
  }
  return test::symmetric_eigenvalues(0.5 * (scaled + scaled.transpose())).maxCoeff();
}

/// By t = 20 the largest eigenvalue is at least `growth` times that of the start, and the motion knows it.
void expect_followed_rates(const test::ModelParts& model, double growth) {
  ExplicitMotion motion(model);
  const double first = motion.spectrum().stiffness;
  EXPECT_FALSE(go(motion, 20));
  motion.survey();
  const double believed = motion.spectrum().stiffness;
  const double right = true_rate(model, motion.state());
  EXPECT_GT(right, growth * first);
  EXPECT_GE(believed, 0.95 * right);
  EXPECT_LE(believed, 2 * right);
  EXPECT_LE(std::abs(motion.energy().balance()), 1e-10 * motion.energy().largest());
}

/// Squeezed flat, or drawn, between smooth ends.
std::string driven_block(const std::string& material, double strain) {
  return block(material, "plane_strain", 4) + "functions: {drive: {times: [0, 20], values: [0, " +
         std::to_string(2 * strain) + "]}}\n" +
         "runs: {one: {time: {end: 20}, supports: [{on: held, fix: x}, {on: under, fix: y}, "
         "{on: end, x: {value: 1, function: drive}}]}}\n";
}

TEST(ExplicitNonlinear, StepsBecomeShortWhereCellsAreSqueezed) {
  for (const auto& [material, strain] : {std::pair{steel + logarithmic, -0.6},
                                         {rubber, -0.6},
                                         {rubber, 1.5},
                                         {spring_steel, 0.8},
                                         {"young: 1, poisson: 0.3, strain: logarithmic", -0.5}}) {
    const auto model = model_of(driven_block(material, strain));
    SCOPED_TRACE(material + " " + std::to_string(strain));
    expect_followed_rates(model, 1.5);
  }
}

/// A block between fixed ends that is cooled has the stresses of its free strain, and the stiffness of these.
TEST(ExplicitNonlinear, StepsBecomeShortWhereHeldBodiesAreCooled) {
  for (const auto& material : {spring_steel + ", expansion: 0.4", rubber + ", expansion: 0.4"}) {
    const auto model = model_of(block(material, "plane_strain", 4) + R"(
functions: {cool: {times: [0, 20], values: [0, -1]}}
temperature: [{on: all, value: 1, function: cool}]
runs: {one: {time: {end: 20}, supports: [{on: held, fix: [x, y]}, {on: end, fix: [x, y]}]}}
)");
    SCOPED_TRACE(material);
    expect_followed_rates(model, 1.3);
  }
}

TEST(ExplicitNonlinear, EndsWhereACellIsTurnedInsideOut) {
  const auto model = model_of(block(rubber) + "initial: [{on: end, velocity: {x: -100}}]\n");
  ExplicitMotion motion(model);
  const auto failed = motion.advance(1, 50);
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->reason, element::Failure::inverted);
  EXPECT_LT(motion.t(), 0.1);
}

TEST(ExplicitNonlinear, RefusesAStartInsideOut) {
  const auto model = model_of(block(rubber) + "initial: [{on: end, displacement: {x: -1.5}}]\n");
  try {
    ExplicitMotion{model};
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 5), "cell ");
    EXPECT_NE(std::string(error.what()).find("in the initial displacements"), std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace rubato::step::nonlinear_motion_test
