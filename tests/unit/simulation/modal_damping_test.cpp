// SPDX-License-Identifier: LGPL-3.0-or-later
/// Damping of natural modes against Rayleigh's, where both are the same, and against one mode's closed form.

#include "rubato/constraint/reduction.hpp"
#include "rubato/domain/domain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "support/dense.hpp"
#include "support/faults.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <string>
#include <vector>

namespace rubato::simulation::modal_damping_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A short beam that is let go of from a bent shape; `more` damps it.
std::string beam(const std::string& material, const std::string& more,
                 const std::string& time = "{scheme: newmark, step: 2e-4, end: 0.02}") {
  return fmt::format(
      R"(mesh: {{generate: [{{name: beam, rectangle: {{from: [0, 0], to: [2, 1]}}, divisions: [3, 1], sides: {{left: clamped, right: end}}}}]}}
physics: plane_stress
materials: {{any: {{young: 1e5, poisson: 0.3, density: 1{}}}}}
supports: [{{on: clamped, fix: [x, y]}}]
initial: [{{on: end, velocity: {{x: 1, y: -3}}}}]
newton: {{residual: 1e-12}}
time: {}
{})",
      material, time, more);
}

/// ω of all modes, ascending.
VectorXd angular_frequencies(const test::ModelParts& model) {
  const MatrixXd k(model.reduction.reduced(model.domain.initial_tangent()));
  const MatrixXd m(model.reduction.reduced(model.mass));
  return test::general_modes(k, m).values.cwiseSqrt();
}

TEST(ModalDamping, IsRayleighDampingWhereRatiosFollowItsLaw) {
  test::Walk rayleigh(beam(", rayleigh: {stiffness: 3e-5, mass: 20}", ""));
  const auto omega = angular_frequencies(rayleigh.model);
  std::vector<double> ratios;
  for (const double w : omega)
    ratios.push_back(0.5 * (20 / w + 3e-5 * w));
  test::Walk modal(beam("", fmt::format("modal_damping: {{modes: {}, ratio: [{}]}}\n", ratios.size(),
                                        fmt::join(ratios, ", "))));
  ASSERT_TRUE(rayleigh.to_end());
  ASSERT_TRUE(modal.to_end());
  const auto& u = rayleigh.state().motion.u;
  EXPECT_LE((u - modal.state().motion.u).lpNorm<Eigen::Infinity>(), 1e-9 * u.lpNorm<Eigen::Infinity>());
  const auto energy = modal.simulation.energy();
  EXPECT_NEAR(energy.damping, rayleigh.simulation.energy().damping, 1e-8 * energy.largest());
  EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest());
}

/// Only the first mode is damped: the others keep the energy that they have.
TEST(ModalDamping, LeavesOtherModesAlone) {
  test::Walk walk(
      beam("", "modal_damping: {modes: 1, ratio: 0.05}\n", "{scheme: newmark, step: 5e-5, end: 0.4}"));
  const auto& model = walk.model;
  const MatrixXd k(model.reduction.reduced(model.domain.initial_tangent()));
  const MatrixXd m(model.reduction.reduced(model.mass));
  const auto modes = test::general_modes(k, m);
  const auto energy_of = [&](Eigen::Index mode) {
    const VectorXd shape = model.reduction.scatter(modes.vectors.col(mode));
    const double v = shape.dot(model.mass * walk.state().motion.v);
    const double u = shape.dot(model.mass * walk.state().motion.u);
    return 0.5 * (v * v + modes.values[mode] * u * u);
  };
  const double first = energy_of(0);
  const double third = energy_of(2);
  ASSERT_TRUE(walk.to_end());
  const double omega = std::sqrt(modes.values[0]);
  EXPECT_NEAR(energy_of(0) / first, std::exp(-2 * 0.05 * omega * 0.4),
              0.06 * std::exp(-2 * 0.05 * omega * 0.4));
  EXPECT_NEAR(energy_of(2), third, 1e-8 * third);
}

struct Course {
  std::string name;
  std::string time;
};

class DampedBlock : public testing::TestWithParam<Course> {};

TEST_P(DampedBlock, ClosesItsLedgerInContact) {
  test::Walk walk(fmt::format(R"(mesh:
  generate:
    - {{name: low, rectangle: {{from: [0, -1], to: [4, 0]}}, divisions: [8, 2], sides: {{bottom: ground, top: table}}}}
    - {{name: up, rectangle: {{from: [1, 0], to: [3, 1]}}, divisions: [5, 3], sides: {{bottom: sole, top: roof}}}}
physics: plane_strain
materials: {{any: {{young: 2e5, poisson: 0.3, density: 7.8e-3}}}}
modal_damping: {{modes: 6, ratio: [0.02, 0.02, 0.05, 0.05, 0.1, 0.1]}}
supports: [{{on: ground, fix: [x, y]}}]
springs: [{{on: roof, x: 10, y: 10}}]
initial: [{{on: up, velocity: {{x: 2, y: -1}}}}]
contact: {{c: {{master: table, slave: sole, friction: 0.3}}}}
time: {}
)",
                              GetParam().time));
  ASSERT_TRUE(walk.to_end());
  const auto energy = walk.simulation.energy();
  EXPECT_GT(energy.damping, 1e-4 * energy.largest());
  EXPECT_GT(energy.friction, 0);
  EXPECT_NEAR(energy.balance(), 0, 1e-10 * energy.largest());
  double iterations = 0;
  for (const auto& report : walk.reports)
    iterations += report.iterations;
  EXPECT_LE(iterations, 12. * static_cast<double>(walk.reports.size()));
}

INSTANTIATE_TEST_SUITE_P(Modal, DampedBlock,
                         testing::Values(Course{"Hht", "{scheme: hht, alpha: -0.1, step: 1e-4, end: 5e-3}"},
                                         Course{"MoreauJean",
                                                "{scheme: moreau_jean, step: 1e-4, end: 5e-3}"}),
                         [](const auto& info) { return info.param.name; });

TEST(ModalDamping, IsRefusedWhereItCannotBe) {
  const auto fault = [](const std::string& more,
                        const std::string& time = "{scheme: newmark, step: 1, end: 1}") {
    return test::fault_of([&] { test::Walk(beam("", more, time)); });
  };
  EXPECT_NE(fault("modal_damping: {modes: 100, ratio: 0.1}\n").find("modes"), std::string::npos);
  EXPECT_NE(
      fault("modal_damping: {modes: 2, ratio: [0.1]}\n", "{scheme: static, step: 1, end: 1}").find("static"),
      std::string::npos);
  EXPECT_NE(
      fault("modal_damping: {modes: 2, ratio: 0.1}\n", "{scheme: central_difference, step: 1e-6, end: 1e-5}")
          .find("rayleigh"),
      std::string::npos);
  EXPECT_NE(fault("modal_damping: {modes: 3, ratio: [0.1, 0.2]}\n").find("2 ratios for 3 modes"),
            std::string::npos);
  EXPECT_NE(fault("modal_damping: {modes: 0, ratio: 0.1}\n").find("modes"), std::string::npos);
  EXPECT_NE(fault("modal_damping: {modes: 1, ratio: -1}\n").find("ratio"), std::string::npos);
}

} // namespace
} // namespace rubato::simulation::modal_damping_test
