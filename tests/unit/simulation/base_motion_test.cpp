// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bases that move: against the solution of the semidiscrete bar, and counted from the base against counted
/// from the place where it was.
#include "rubato/constraint/reduction.hpp"
#include "rubato/core/time_integral.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/model/model_forces.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

namespace rubato::simulation::base_motion_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A bar clamped at its left end, of which `more` says how the ground moves.
std::string bar(const std::string& time, const std::string& more) {
  return fmt::format(
      R"(mesh: {{generate: [{{name: bar, rectangle: {{from: [0, 0], to: [1, 0.25]}}, divisions: [6, 1], cells: quad4, sides: {{left: left, right: right}}}}]}}
physics: plane_strain
materials: {{any: {{young: 1, poisson: 0, density: 1{}}}}}
functions:
  shake: {{sine: {{frequency: 0.4}}}}
  quake: {{times: [0, 0.2, 0.5, 1], values: [0.1, 1, -0.7, 0.2]}}
supports: [{{on: left, fix: [x, y]}}]
newton: {{residual: 1e-13}}
time: {}
{})",
      more.starts_with("# rayleigh") ? ", rayleigh: {mass: 0.3, stiffness: 0.01}" : "", time, more);
}

/// u(t) relative to the base under the acceleration −sin(ωt) along x, mode by mode: what K and M say without
/// an error of time.
class SemidiscreteBar {
public:
  SemidiscreteBar(const test::ModelParts& model, const model::SparseMatrix& mass, double omega)
      : model_(model),
        modes_(test::general_modes(MatrixXd(model.reduction.reduced(model.domain.initial_tangent())),
                                   MatrixXd(model.reduction.reduced(mass)))),
        omega_(omega) {
    VectorXd along = VectorXd::Zero(model.dofs.dof_count);
    for (const auto node : model.dofs.nodes)
      along[model.dofs.dof(node, 0)] = 1;
    part_ = modes_.vectors.transpose() * model.reduction.gather(mass * along);
  }

  VectorXd displacement(double t) const {
    VectorXd q(part_.size());
    for (Eigen::Index k = 0; k < q.size(); ++k) {
      const double own = std::sqrt(modes_.values[k]);
      q[k] = part_[k] * (std::sin(omega_ * t) - omega_ / own * std::sin(own * t)) /
             (own * own - omega_ * omega_);
    }
    return model_.reduction.scatter(modes_.vectors * q);
  }

private:
  test::ModelParts model_;
  test::GeneralModes modes_;
  double omega_;
  VectorXd part_;
};

const std::string shaken = "base_motion: {x: {acceleration: -1, function: shake}}\n";

TEST(BaseMotion, MovesTheSemidiscreteBarAsItsModesSay) {
  test::Walk walk(bar("{scheme: newmark, step: 2.5e-4, end: 4}", shaken));
  const SemidiscreteBar exact(walk.model, walk.model.mass, 0.8 * std::acos(-1.0));
  double off = 0;
  double largest = 0;
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    const auto u = exact.displacement(walk.state().t);
    off = std::max(off, (walk.state().motion.u - u).lpNorm<Eigen::Infinity>());
    largest = std::max(largest, u.lpNorm<Eigen::Infinity>());
  }
  RecordProperty("relative error", fmt::format("{:.2e}", off / largest));
  EXPECT_LE(off, 1e-6 * largest);
  const auto& energy = walk.simulation.energy();
  EXPECT_LE(std::abs(energy.balance()), 1e-10 * energy.largest());
}

/// Lumped masses have forces of inertia, too.
TEST(BaseMotion, MovesTheBarExplicitlyAlike) {
  Simulation simulation(
      test::study_of(bar("{scheme: central_difference, step: 2.5e-4, record: 0.01, end: 4}", shaken)));
  const test::ModelParts model(simulation.model());
  const model::SparseMatrix mass(MatrixXd(model.lumped_mass.asDiagonal()).sparseView());
  const SemidiscreteBar exact(model, mass, 0.8 * std::acos(-1.0));
  double off = 0;
  double largest = 0;
  while (!simulation.finished()) {
    ASSERT_TRUE(simulation.advance().accepted());
    const auto u = exact.displacement(simulation.state().t);
    off = std::max(off, (simulation.state().motion.u - u).lpNorm<Eigen::Infinity>());
    largest = std::max(largest, u.lpNorm<Eigen::Infinity>());
  }
  RecordProperty("relative error", fmt::format("{:.2e}", off / largest));
  EXPECT_LE(off, 1e-6 * largest);
  EXPECT_LE(std::abs(simulation.energy().balance()), 1e-10 * simulation.energy().largest());
}

struct Compared {
  std::string name;
  std::string time;
  std::string motion; ///< of the base along x
  std::string more;
  double tolerance = 1e-9; ///< of the largest relative displacement
};

/// Schemes integrate an acceleration that does not change without an error: then both frames give the same
/// numbers. Else they differ by the error of the scheme.
std::vector<Compared> compared() {
  const std::string average = "{scheme: newmark, step: 0.01, end: 1}";
  return {
      {"Quake", average, "{acceleration: 0.3, function: quake}", "", 1e-2},
      {"QuakeInFinerSteps", "{scheme: newmark, step: 1e-3, end: 1}", "{acceleration: 0.3, function: quake}",
       "", 1e-4},
      {"AnExpression", average, "{acceleration: '0.3+t'}", "", 1e-2},
      {"AMass", average, "{acceleration: 0.3}", "masses: [{on: right, mass: 0.2}]\n"},
      {"ADashpot", average, "{acceleration: 0.3}",
       "connectors: [{on: N2, to: N9, damping: 0.1, stiffness: 0.1}]\n"},
      {"ConstantAcceleration", average, "{acceleration: 0.3}",
       "loads: [{surface_force: {on: right, x: 0.01, y: 0.02}}]\n"},
      {"SpringsAndDashpotsToTheGround", average, "{acceleration: 0.3}",
       "springs: [{on: right, x: 0.2, y: 0.1}]\n"
       "connectors: [{on: N3, along: [1, 1], damping: 0.1, stiffness: 0.1}]\n"},
      {"DampingByTheMass", average, "{acceleration: 0.3}", "# rayleigh\n"},
      {"MoreauJean", "{theta: 0.5, step: 0.01, end: 1}", "{acceleration: 0.3}", ""},
      {"MoreauJeanOnAnObstacle", "{theta: 0.5, step: 0.01, end: 1}", "{acceleration: -0.3}",
       "contact: {wall: {obstacle: {plane: {point: [1.001, 0], normal: [-1, 0]}}, slave: right}}\n"},
      {"RelatedDisplacements", average, "{acceleration: 0.3}",
       "relations: {end: {rigid: {on: right}}, lever: {equation: {terms: [{on: N3, x: 1}, {on: N4, x: "
       "-2}]}}}\n"},
      {"CentralDifference", "{scheme: central_difference, step: 0.005, record: 0.01, end: 1}",
       "{acceleration: 0.3}", "masses: [{on: right, mass: 0.2}]\n"},
  };
}

void PrintTo(const Compared& tested, std::ostream* out) {
  *out << tested.name;
}

class BothFrames : public testing::TestWithParam<Compared> {};

/// s of the motions above.
double base_at(const std::string& motion, double t) {
  if (motion == "{acceleration: 0.3}" || motion == "{acceleration: -0.3}")
    return (motion.find('-') == std::string::npos ? 0.15 : -0.15) * t * t;
  if (motion == "{acceleration: '0.3+t'}")
    return 0.15 * t * t + t * t * t / 6;
  const TimeIntegral quake(Function({0, 0.2, 0.5, 1}, {0.1, 1, -0.7, 0.2}), std::nullopt, 2, 0, 1);
  return 0.3 * quake.at(t);
}

TEST_P(BothFrames, GiveTheSameMotion) {
  const auto& [name, time, motion, more, tolerance] = GetParam();
  const auto in_frame = [&, &time = time, &motion = motion, &more = more](const std::string& frame) {
    return test::study_of(bar(time, more + "base_motion: {x: " + motion + ", frame: " + frame + "}\n"));
  };
  Simulation relative(in_frame("relative"));
  Simulation absolute(in_frame("absolute"));
  const auto& dofs = test::ModelParts(relative.model()).dofs;
  double off = 0;
  double largest = 0;
  while (!relative.finished()) {
    ASSERT_TRUE(relative.advance().accepted());
    ASSERT_TRUE(absolute.advance().accepted());
    VectorXd u = relative.state().motion.u;
    largest = std::max(largest, u.lpNorm<Eigen::Infinity>());
    for (const auto node : dofs.nodes)
      u[dofs.dof(node, 0)] += base_at(motion, relative.state().t);
    off = std::max(off, (absolute.state().motion.u - u).lpNorm<Eigen::Infinity>());
  }
  RecordProperty("relative difference", fmt::format("{:.2e}", off / largest));
  EXPECT_LE(off, tolerance * largest);
  for (const auto* simulation : {&relative, &absolute})
    EXPECT_LE(std::abs(simulation->energy().balance()), 1e-10 * simulation->energy().largest());
}

INSTANTIATE_TEST_SUITE_P(Of, BothFrames, testing::ValuesIn(compared()),
                         [](const auto& tested) { return tested.param.name; });

/// All that the mass weighs comes out at the clamp, at the first instant.
TEST(BaseMotion, ActsOnEveryMass) {
  const auto model = test::model_of(
      bar("{theta: 0.5, step: 0.01, end: 1}",
          "base_motion: {x: {acceleration: -2}}\nmasses: [{on: left, mass: 3}]\n"
          "contact: {wall: {obstacle: {plane: {point: [0, -1], normal: [0, 1]}}, slave: right}}\n"));
  const auto force = model::external_force(model, 0);
  double sum = 0;
  for (const auto node : model.dofs.nodes)
    sum += force[model.dofs.dof(node, 0)];
  EXPECT_NEAR(sum, 2 * (0.25 + 6), 1e-13);
}

/// Nothing is strained where all that is held moves as the base.
TEST(BaseMotion, CarriesAStaticBodyWithoutStrain) {
  test::Walk walk(bar("{scheme: static, step: 0.25, end: 1}",
                      "base_motion: {x: 0.1*t, y: {velocity: 0.2}, frame: absolute}\n"));
  ASSERT_TRUE(walk.to_end());
  for (const auto node : walk.model.dofs.nodes) {
    EXPECT_NEAR(walk.displacement(node, 0), 0.1, 1e-14);
    EXPECT_NEAR(walk.displacement(node, 1), 0.2, 1e-14);
  }
}

} // namespace
} // namespace rubato::simulation::base_motion_test
