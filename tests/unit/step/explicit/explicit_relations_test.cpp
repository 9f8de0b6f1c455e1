// SPDX-License-Identifier: LGPL-3.0-or-later
// Explicit motion with relations between displacements: closed forms, dense matrices, balances.
#include "rubato/constraint/reduction.hpp"
#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"

#include <Eigen/Core>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::explicit_relations_test {
namespace {

using deck::Setting;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Two squares of side 1 that are held at their left sides and stretch along x: oscillators of stiffness 1
/// and 2, of mass 0.5 and 1.5. A unit force pulls the first one.
const std::string oscillators = R"(
mesh:
  generate:
    - {name: a, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [1, 1], sides: {left: held_a, right: end_a}, points: {right_top: top_a}}
    - {name: b, rectangle: {from: [0, 3], to: [1, 4]}, divisions: [1, 1], sides: {left: held_b, right: end_b}, points: {right_top: top_b}}
physics: plane_stress
materials: {soft: {young: 1, poisson: 0, density: 1, cells: a}, stiff: {young: 2, poisson: 0, density: 3, cells: b}}
functions: {parabola: {expression: "t^2"}}
supports: [{on: held_a, fix: x}, {on: held_b, fix: x}, {on: a, fix: y}, {on: b, fix: y}]
loads: [{surface_force: {on: end_a, x: 1}}]
relations:
  flat_a: {equal: {on: end_a, in: x}}
  flat_b: {equal: {on: end_b, in: x}}
  lever: {equation: {terms: [{on: top_b, x: 1}, {on: top_a, x: 2}], value: 0}}
time: {scheme: central_difference, end: 3, record: 3}
)";

double end_of(const test::ModelParts& model, const VectorXd& u, double y) {
  for (const auto node : model.dofs.nodes)
    if ((model.mesh.points[static_cast<std::size_t>(node)] - Eigen::Vector3d(1, y, 0)).norm() < 1e-9)
      return u[model.dofs.dof(node, 0)];
  return NAN;
}

/// Of u_b = −2 u_a + g: (m_a + 4 m_b) u_a″ + (k_a + 4 k_b) u_a = F + 2 (m_b g″ + k_b g).
constexpr double lever_mass = 0.5 + 4 * 1.5;
constexpr double lever_stiffness = 1 + 4 * 2;
const double omega = std::sqrt(lever_stiffness / lever_mass);

TEST(ALever, IsExactToSecondOrder) {
  const auto model = test::model_of(oscillators);
  std::vector<double> errors;
  for (const int steps : {40, 80, 160}) {
    ExplicitMotion motion(model);
    motion.advance(3, steps);
    const auto state = motion.state();
    errors.push_back(
        std::abs(end_of(model, state.motion.u, 1) - (1 - std::cos(3 * omega)) / lever_stiffness));
    EXPECT_NEAR(end_of(model, state.motion.u, 4), -2 * end_of(model, state.motion.u, 1), 1e-15);
    EXPECT_NEAR(end_of(model, state.motion.a, 4), -2 * end_of(model, state.motion.a, 1), 1e-13);
    EXPECT_LT(std::abs(motion.energy().balance()), 1e-13 * motion.energy().largest());
    EXPECT_EQ(motion.energy().support_work, 0);
  }
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.05);
  EXPECT_NEAR(errors[1] / errors[2], 4, 0.02);
}

TEST(ALever, MovesByItsRightSideToSecondOrder) {
  const auto model = test::model_of(
      oscillators, {{"relations.lever.equation.value", "{value: 0.1, function: parabola}"}, {"loads", ""}});
  const double slope = 0.4 / lever_stiffness;
  const double constant = (0.6 - 2 * lever_mass * slope) / lever_stiffness;
  const double expected = constant * (1 - std::cos(3 * omega)) + slope * 9;
  std::vector<double> errors;
  for (const int steps : {40, 80, 160}) {
    ExplicitMotion motion(model);
    motion.advance(3, steps);
    const auto u = motion.state().motion.u;
    errors.push_back(std::abs(end_of(model, u, 1) - expected));
    EXPECT_NEAR(end_of(model, u, 4), -2 * end_of(model, u, 1) + 0.9, 1e-14);
    EXPECT_GT(motion.energy().support_work, 0.1);
    EXPECT_LT(std::abs(motion.energy().balance()), 1e-12 * motion.energy().largest());
  }
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.05);
  EXPECT_NEAR(errors[1] / errors[2], 4, 0.02);
}

/// What the lever puts on both bodies is what moves them: forces in the ratio of its coefficients.
TEST(ALever, ShowsItsForcesAsReactions) {
  const auto model = test::model_of(oscillators);
  ExplicitMotion motion(model);
  motion.advance(1, 100);
  const auto state = motion.state();
  const auto force_on = [&](double y) {
    double sum = 0;
    for (const auto node : model.dofs.nodes) {
      const auto& x = model.mesh.points[static_cast<std::size_t>(node)];
      sum += x[0] > 0.5 && std::abs(x[1] - y) < 0.6 ? state.reaction[model.dofs.dof(node, 0)] : 0.0;
    }
    return sum;
  };
  const double u = end_of(model, state.motion.u, 1);
  const double a = end_of(model, state.motion.a, 1);
  EXPECT_NEAR(force_on(3.5), 1.5 * -2 * a + 2 * -2 * u, 1e-13);
  EXPECT_NEAR(force_on(0.5), 0.5 * a + u - 1, 1e-13);
  EXPECT_NEAR(force_on(0.5), 2 * force_on(3.5), 1e-13);
}

/// A column that is held at its foot and hit at its head.
const std::string column = R"(
mesh:
  generate:
    - {name: low, box: {from: [0, 0, 0], to: [1, 2, 1]}, divisions: [2, 3, 2], sides: {bottom: ground, top: table, left: west, right: east}}
    - {name: up, box: {from: [0.2, 2.5, 0.1], to: [0.9, 3.5, 0.8]}, divisions: [2, 2, 1], sides: {bottom: sole, top: roof}}
physics: solid
materials: {any: {young: 100, poisson: 0.3, density: 1}}
functions: {kick: {times: [0, 0.05, 0.1], values: [0, 1, 0]}, swing: {sine: {frequency: 3}}}
loads: [{surface_force: {on: roof, x: 1, y: -2, function: kick}}]
time: {scheme: central_difference, end: 0.3, record: 0.3}
)";
const std::string held = "supports: [{on: ground, fix: [x, y, z]}]\n";

struct Related {
  std::string name;
  std::string more;
};

std::vector<Related> related() {
  return {
      {"Rigid", held + "relations: {cap: {rigid: {on: roof}}, plate: {rigid: {on: table}}}\n"
                       "connectors: [{on: plate, to: cap, stiffness: 20, damping: 0.1}]\n"},
      {"RigidWithMass", held +
                            "relations: {cap: {rigid: {on: roof}}}\nmasses: [{on: cap, mass: 0.3, inertia: "
                            "[0.1, 0.2, 0.3]}]\n"},
      {"DistributedWithMass", held + "relations: {cap: {distributed: {on: roof}}}\nmasses: [{on: cap, mass: "
                                     "0.3}]\nloads: [{moment: {on: cap, y: 1, function: kick}}]\n"},
      {"Held", held.substr(0, held.size() - 2) +
                   ", {on: cap, turn: {y: {value: 0.02, function: swing}}, x: {value: 0.1, function: "
                   "swing}}]\nrelations: {cap: {rigid: {on: roof}}}\nmasses: [{on: cap, mass: 0.3}]\n"},
      {"HeldDistributed", held.substr(0, held.size() - 2) +
                              ", {on: cap, x: {value: 0.1, function: swing}}]\nrelations: {cap: "
                              "{distributed: {on: roof}}}\n"},
      {"MovingSupportBehindPairs",
       "supports: [{on: ground, fix: [y, z]}, {on: west, x: {value: 0.1, function: swing}}]\nrelations: "
       "{cell: {pairs: {on: east, with: west, in: x, difference: {x: {value: 0.01, function: swing}}}}}\n"},
      {"Oblique", "supports: [{on: ground, along: [0.1, 1, 0.2]}, {on: west, along: [1, 0.3, 0.2], value: "
                  "{value: 0.05, function: swing}}]\nrelations: {cap: {rigid: {on: roof}}}\n"},
      {"Embedded", held + "relations: {pin: {embedded: {at: [0.4, 0.7, 0.3], in: low}}, foot: {equal: {on: "
                          "sole}}}\nmasses: [{on: pin, mass: 0.2}]\n"},
      {"PreloadByForce", held +
                             "preload: {bolt: {cut: {point: [0.5, 1, 0.5], normal: [0, 1, 0], cells: low}, "
                             "force: 3, function: kick}}\n"},
      {"PreloadByShortening",
       held + "preload: {bolt: {cut: {point: [0.5, 1, 0.5], normal: [0, 1, 0], cells: low}, "
              "displacement: 0.01, function: swing}}\n"},
      {"Damped", held + "relations: {cap: {rigid: {on: roof}}}\n"}};
}

std::vector<Setting> changes_of(const Related& given) {
  return given.name == "Damped"
             ? std::vector<Setting>{{"materials.any.rayleigh", "{stiffness: 1e-3, mass: 1}"}}
             : std::vector<Setting>{};
}

/// YAML has each key once.
std::string deck_of(const Related& given) {
  auto deck = column + given.more;
  if (given.more.find("loads:") != std::string::npos) {
    const auto at = deck.find("loads:");
    deck.erase(at, deck.find('\n', at) - at + 1);
  }
  return deck;
}

MatrixXd t_of(const constraint::Reduction& reduction) {
  MatrixXd t(reduction.dof_count(), reduction.unknown_count());
  for (Eigen::Index i = 0; i < t.cols(); ++i)
    t.col(i) = reduction.scatter(VectorXd::Unit(t.cols(), i));
  return t;
}

/// Central differences of the unknowns by dense matrices.
struct Dense {
  explicit Dense(const test::ModelParts& parts)
      : model(parts.whole), t(t_of(model.reduction)), k(model.domain.initial_tangent()),
        m(MatrixXd(model.lumped_mass.asDiagonal()) + MatrixXd(model::reference_masses(model))),
        c(model.damping.nonZeros() > 0 ? MatrixXd(model.damping) : MatrixXd::Zero(k.rows(), k.cols())) {}

  VectorXd given(double at) const { return model.reduction.imposed(at); }

  VectorXd displacement(double end, int steps) const {
    const double h = end / steps;
    const MatrixXd inverse_of_mass = test::inverse(t.transpose() * m * t);
    const auto acceleration = [&](double at, const VectorXd& u, const VectorXd& v) {
      const VectorXd of_given = (given(at + h) - 2 * given(at) + given(at - h)) / (h * h);
      const VectorXd force = model::external_force(model, at) - k * u - c * v - m * of_given;
      return VectorXd(inverse_of_mass * (t.transpose() * force));
    };
    VectorXd q = VectorXd::Zero(t.cols());
    VectorXd v = -h / 2 * acceleration(0, given(0), VectorXd::Zero(k.rows()));
    for (int i = 0; i < steps; ++i) {
      const VectorXd rate = t * v + (given(i * h) - given((i - 1) * h)) / h;
      v += h * acceleration(i * h, t * q + given(i * h), i == 0 ? VectorXd::Zero(k.rows()) : rate);
      q += h * v;
    }
    return t * q + given(end);
  }

  double largest_eigenvalue() const {
    const MatrixXd bare = t.transpose() * model.lumped_mass.asDiagonal() * t;
    return test::general_modes(t.transpose() * k * t, bare).values.maxCoeff();
  }

  const model::Model& model;
  MatrixXd t, k, m, c;
};

class ExplicitRelations : public testing::TestWithParam<Related> {};

TEST_P(ExplicitRelations, MoveAsByDenseMatrices) {
  const auto model = test::model_of(deck_of(GetParam()), changes_of(GetParam()));
  ExplicitMotion motion(model);
  const int steps = static_cast<int>(std::ceil(0.3 / (0.9 * motion.spectrum().stable_step())));
  motion.advance(0.3, steps);
  const VectorXd expected = Dense(model).displacement(0.3, steps);
  EXPECT_GT(expected.lpNorm<Eigen::Infinity>(), 1e-3);
  EXPECT_LT((motion.state().motion.u - expected).lpNorm<Eigen::Infinity>(),
            1e-10 * expected.lpNorm<Eigen::Infinity>());
}

TEST_P(ExplicitRelations, HoldAndCloseTheirEnergy) {
  const auto model = test::model_of(deck_of(GetParam()), changes_of(GetParam()));
  ExplicitMotion motion(model);
  const double h = 0.9 * motion.spectrum().stable_step();
  double most = 0;
  double end = 0;
  for (int i = 1; i <= 12; ++i) {
    end += 5 * h * (i > 6 ? 0.8 : 1);
    motion.advance(end, 5);
    const auto energy = motion.energy();
    most = std::max(most, energy.largest());
    EXPECT_LT(std::abs(energy.balance()), 1e-11 * most) << i;
    const auto u = motion.state().motion.u;
    EXPECT_LT(model.reduction.correction(end, u).lpNorm<Eigen::Infinity>(),
              1e-14 * u.lpNorm<Eigen::Infinity>());
  }
  EXPECT_GT(most, 1e-6);
  const auto state = motion.state();
  EXPECT_LE(model.reduction.gather(state.reaction).lpNorm<Eigen::Infinity>(),
            1e-11 * state.reaction.lpNorm<Eigen::Infinity>());
}

/// The largest eigenvalue of the unknowns is bounded from above, within the 1 % of Lanczos' method.
TEST_P(ExplicitRelations, HaveABoundOfTheirStableStep) {
  const auto model = test::model_of(deck_of(GetParam()), changes_of(GetParam()));
  const double exact = Dense(model).largest_eigenvalue();
  const double found = ExplicitMotion(model).spectrum().stiffness;
  RecordProperty("bound_over_exact", fmt::format("{:.5f}", found / exact));
  EXPECT_GE(found, exact * (1 - 1e-10));
  EXPECT_LE(found, exact / 0.99 * (1 + 1e-10));
}

TEST_P(ExplicitRelations, GoOnFromTheirMemoryToTheLastBit) {
  const auto model = test::model_of(deck_of(GetParam()), changes_of(GetParam()));
  ExplicitMotion motion(model);
  const double h = 0.8 * motion.spectrum().stable_step();
  motion.advance(20 * h, 20);
  const auto start = motion.memory();
  ExplicitMotion resumed(model);
  resumed.restore(start);
  for (auto* each : {&motion, &resumed}) {
    each->advance(50 * h, 30);
    each->advance(70 * h, 30);
  }
  EXPECT_EQ(resumed.state().motion.u, motion.state().motion.u);
  EXPECT_EQ(resumed.state().reaction, motion.state().reaction);
  EXPECT_EQ(resumed.energy().support_work, motion.energy().support_work);
  EXPECT_EQ(resumed.energy().kinetic, motion.energy().kinetic);
}

INSTANTIATE_TEST_SUITE_P(Kinds, ExplicitRelations, testing::ValuesIn(related()),
                         [](const auto& of) { return of.param.name; });

/// A body that relations make rigid has no stiffness of its own left: the step is that of the soft rest.
TEST(ARigidBody, DoesNotShortenTheStep) {
  const auto changes = [](const std::string& young) {
    return std::vector<Setting>{
        {"materials.any.cells", "low"},
        {"materials.stiff", "{young: " + young + ", poisson: 0.3, density: 1, cells: up}"}};
  };
  const std::string deck = column + held + "relations: {block: {rigid: {on: up}}}\n";
  const auto soft = test::model_of(deck, changes("100"));
  const auto stiff = test::model_of(deck, changes("1e6"));
  const double expected = ExplicitMotion(soft).spectrum().stiffness;
  EXPECT_NEAR(ExplicitMotion(stiff).spectrum().stiffness, expected, 1e-3 * expected);
  EXPECT_GT(ExplicitMotion(test::model_of(column + held, changes("1e6"))).spectrum().stiffness,
            100 * expected);
}

/// Without a stiffness of the bodies left the springs of contact still have one: that of the material.
TEST(ARigidBody, BouncesOffATable) {
  const auto model = test::model_of(R"(
mesh: {generate: [{name: block, rectangle: {from: [0, 0.01], to: [1, 1.01]}, divisions: [2, 2], sides: {bottom: sole}}]}
physics: plane_strain
materials: {any: {young: 100, poisson: 0.3, density: 1}}
initial: [{on: block, velocity: {y: -0.2}}]
relations: {whole: {rigid: {on: block}}}
contact: {floor: {obstacle: {plane: {point: [0, 0], normal: [0, 1]}}, slave: sole, method: penalty}}
time: {scheme: central_difference, end: 1, record: 1}
)");
  ExplicitMotion motion(model);
  const double h = 0.2 * motion.spectrum().stable_step();
  const int steps = static_cast<int>(std::ceil(1 / h));
  motion.advance(1, steps);
  const auto state = motion.state();
  for (const auto node : model.dofs.nodes) {
    EXPECT_NEAR(state.motion.v[model.dofs.dof(node, 0)], 0, 1e-10);
    EXPECT_NEAR(state.motion.v[model.dofs.dof(node, 1)], 0.2, 0.004);
  }
  EXPECT_LT(std::abs(motion.energy().balance()), 1e-12 * motion.energy().largest());
}

/// A support on related nodes ends: the motion goes on without a jump, the balance stays closed.
TEST(AReleasedSupport, LeavesItsRelationsInPlace) {
  const auto model =
      test::model_of(column + "supports: [{on: ground, fix: [y, z]}, {on: west, x: {value: 0.1, function: "
                              "swing}, until: 0.1}]\nrelations: {cell: {pairs: {on: east, with: west}}}\n");
  ExplicitMotion motion(model);
  const auto steps = [&](double length) {
    return static_cast<int>(std::ceil(length / (0.9 * motion.spectrum().stable_step())));
  };
  motion.advance(0.1, steps(0.1));
  const VectorXd before = motion.state().motion.v;
  const auto stage = model::build_stage(model.whole, 0.1, {});
  motion.take_supports(stage);
  EXPECT_LT((motion.state().motion.v - before).lpNorm<Eigen::Infinity>(),
            1e-12 * before.lpNorm<Eigen::Infinity>());
  motion.advance(0.3, steps(0.2));
  const auto u = motion.state().motion.u;
  EXPECT_LT(stage.reduction.correction(0.3, u).lpNorm<Eigen::Infinity>(), 1e-14);
  EXPECT_GT(std::abs(motion.energy().support_work), 1e-3);
  EXPECT_LT(std::abs(motion.energy().balance()), 1e-12 * motion.energy().largest());
}

TEST(ExplicitRelation, NeedsMassesOfDependentNodes) {
  EXPECT_THROW(ExplicitMotion(test::model_of(oscillators, {{"materials.stiff.density", "0"}})), InputError);
}

} // namespace
} // namespace rubato::step::explicit_relations_test
