// SPDX-License-Identifier: LGPL-3.0-or-later
/// Supports that end during a run.
#include "rubato/core/error.hpp"
#include "rubato/study/study.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace rubato::simulation::release_test {
namespace {

/// A bar of one cell, of length and area 1, stretched by 0.01 and let go at t = 0.1: an oscillator.
std::string oscillator(const std::string& time, const std::string& more = "") {
  return fmt::format(
      R"(mesh: {{generate: [{{name: bar, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [1, 1], cells: quad4, sides: {{left: left, right: right}}}}]}}
physics: plane_stress
materials: {{any: {{young: 4, poisson: 0, density: 3}}}}
supports: [{{on: left, fix: [x, y]}}, {{on: right, fix: y}}, {{on: right, x: 0.01, until: 0.1}}]
initial: [{{on: right, displacement: {{x: 0.01}}}}]
newton: {{residual: 1e-13}}
time: {}
{})",
      time, more);
}

constexpr double step = 0.02;
constexpr double released_at = 0.1;

/// What a run has at its right end, of the instants of its results.
struct Swing {
  double off = 0;     ///< largest difference from the amplitude times cos(n θ), n steps after the release
  double balance = 0; ///< largest of the ledger, in parts of its largest term
};

Swing swing(Simulation& simulation, double angle) {
  const test::ModelParts model(simulation.model());
  int dof = -1;
  for (const auto node : model.dofs.nodes)
    if (model.mesh.points[static_cast<std::size_t>(node)].isApprox(Eigen::Vector3d(1, 0, 0)))
      dof = model.dofs.dof(node, 0);
  Swing found;
  while (!simulation.finished()) {
    EXPECT_TRUE(simulation.advance().accepted());
    const auto& state = simulation.state();
    const double steps = std::max(0., std::round((state.t - released_at) / step));
    found.off = std::max(found.off, std::abs(state.motion.u[dof] - 0.01 * std::cos(steps * angle)));
    const auto& energy = simulation.energy();
    found.balance = std::max(found.balance, std::abs(energy.balance()) / energy.largest());
  }
  EXPECT_NEAR(simulation.state().reaction[dof], 0, 1e-12);
  return found;
}

/// Average acceleration and the midpoint rule turn the phase of an oscillator by 2 atan(ωh/2) a step.
TEST(Release, LetsAnOscillatorSwingAsItsSchemeDoesExactly) {
  const double omega = std::sqrt(4. / 1.); // k = E A/L, m = ρ A L/3
  for (const auto* time : {"{scheme: newmark, step: 0.02, end: 4}", "{theta: 0.5, step: 0.02, end: 4}",
                           "{scheme: newmark, step: 0.02, end: 4}\nsolver: full"}) {
    Simulation simulation(test::study_of(oscillator(time)));
    const auto found = swing(simulation, 2 * std::atan(omega * step / 2));
    EXPECT_LE(found.off, 1e-13) << time;
    EXPECT_LE(found.balance, 1e-12) << time;
  }
}

TEST(Release, LeavesStatesAloneThatOthersHold) {
  Simulation simulation(test::study_of(oscillator("{scheme: newmark, step: 0.02, end: 0.2}")));
  std::vector<std::shared_ptr<const step::State>> held;
  std::vector<Eigen::VectorXd> accelerations;
  while (!simulation.finished()) {
    held.push_back(simulation.shared_state());
    accelerations.push_back(simulation.state().motion.a);
    ASSERT_TRUE(simulation.advance().accepted());
  }
  for (std::size_t i = 0; i < held.size(); ++i)
    EXPECT_EQ(held[i]->motion.a, accelerations[i]) << i;
}

/// Central differences by 2 asin(ωh/2), with the lumped mass.
TEST(Release, LetsAnOscillatorSwingExplicitly) {
  const double omega = std::sqrt(4. / 1.5);
  Simulation simulation(
      test::study_of(oscillator("{scheme: central_difference, step: 0.02, record: 0.02, end: 4}")));
  const auto found = swing(simulation, 2 * std::asin(omega * step / 2));
  EXPECT_LE(found.off, 1e-13);
  EXPECT_LE(found.balance, 1e-12);
}

TEST(Release, IsAnInstantThatAStepEndsAt) {
  test::Walk walk(oscillator("{scheme: hht, alpha: -0.1, step: 0.07, end: 1}"));
  ASSERT_TRUE(walk.advance());
  ASSERT_TRUE(walk.advance());
  EXPECT_DOUBLE_EQ(walk.state().t, 0.1);
  const int dof = walk.model.dofs.dof(walk.node_at(1, 0), 0);
  EXPECT_NEAR(walk.state().reaction[dof], 0.02, 1e-12); // half of E A u/L
  ASSERT_TRUE(walk.advance());
  EXPECT_NEAR(walk.state().reaction[dof], 0, 1e-12);
  ASSERT_TRUE(walk.to_end());
  EXPECT_LE(std::abs(walk.simulation.energy().balance()), 1e-12 * walk.simulation.energy().largest());
}

/// A block pressed on another by a support that ends, with friction and a related face.
std::string pressed(const std::string& time, const std::string& more) {
  const auto* method = time.find("central") == std::string::npos ? "integration: nodes" : "method: penalty";
  return fmt::format(R"(mesh:
  generate:
    - {{name: low, rectangle: {{from: [0, -1], to: [4, 0]}}, divisions: [8, 2], cells: quad4, sides: {{bottom: ground, top: table}}}}
    - {{name: up, rectangle: {{from: [1, 0], to: [3, 1]}}, divisions: [5, 3], cells: quad4, sides: {{bottom: sole, top: roof, right: face}}}}
physics: plane_strain
materials: {{any: {{young: 2e5, poisson: 0.3, density: 7.8e-3}}}}
functions: {{press: {{ramp: [0, 1e-3]}}}}
contact: {{c: {{master: table, slave: sole, friction: 0.4, {}}}}}
newton: {{residual: 1e-12}}
time: {}
{})",
                     method, time, more);
}

const std::string pressed_roof =
    "supports: [{on: ground, fix: [x, y]}, {on: roof, y: {value: -1e-3, function: press}, until: 1.1e-3}, "
    "{on: roof, x: {velocity: 1, function: press}, until: 1.5e-3}]\n"
    "connectors: [{on: face, along: [1, 0], stiffness: 1e3, damping: 1e-2}]\n";

class ReleasedBlock : public testing::TestWithParam<std::string> {};

TEST_P(ReleasedBlock, KeepsItsEnergyAcrossReleases) {
  for (const auto* related : {"", "relations: {cap: {rigid: {on: roof}}}\n"}) {
    const bool is_explicit = GetParam().find("central") != std::string::npos;
    if (is_explicit && *related != 0)
      continue;
    Simulation simulation(test::study_of(pressed("{" + GetParam() + "}", pressed_roof + related)));
    double balance = 0;
    while (!simulation.finished()) {
      ASSERT_TRUE(simulation.advance().accepted());
      balance = std::max(balance, std::abs(simulation.energy().balance()));
    }
    EXPECT_LE(balance, 1e-10 * simulation.energy().largest());
    RecordProperty("balance", fmt::format("{:.2e}", balance / simulation.energy().largest()));
  }
}

INSTANTIATE_TEST_SUITE_P(By, ReleasedBlock,
                         testing::Values("scheme: hht, alpha: -0.1, step: 5e-5, end: 3e-3",
                                         "step: 5e-5, end: 3e-3",
                                         "scheme: generalized_alpha, step: 5e-5, end: 3e-3",
                                         "scheme: central_difference, record: 5e-5, end: 3e-3"));

/// The memento may be of the instant itself, before or after the next step has begun.
TEST(Release, GoesOnFromAMementoToTheSameBits) {
  const auto deck = pressed("{scheme: hht, alpha: -0.1, step: 1e-4, end: 2e-3}", pressed_roof);
  Simulation whole(test::study_of(deck));
  std::vector<Memento> mementos;
  while (!whole.finished()) {
    ASSERT_TRUE(whole.advance().accepted());
    mementos.push_back(whole.memento());
  }
  for (const auto& memento : mementos) {
    Simulation rest(test::study_of(deck), {.memento = &memento});
    while (!rest.finished())
      ASSERT_TRUE(rest.advance().accepted());
    EXPECT_EQ(rest.state().motion.u, whole.state().motion.u) << "from t = " << memento.state.t;
    EXPECT_EQ(rest.energy().balance(), whole.energy().balance());
  }
}

TEST(Release, GoesBackInExplicitRuns) {
  const auto deck = pressed("{scheme: central_difference, record: 1e-4, end: 2e-3}", pressed_roof);
  Simulation whole(test::study_of(deck));
  std::vector<Memento> mementos;
  while (!whole.finished()) {
    ASSERT_TRUE(whole.advance().accepted());
    mementos.push_back(whole.memento());
  }
  Simulation again(test::study_of(deck));
  for (auto memento = mementos.rbegin(); memento != mementos.rend(); ++memento) {
    again.restore(*memento);
    while (!again.finished())
      ASSERT_TRUE(again.advance().accepted());
    EXPECT_EQ(again.state().motion.u, whole.state().motion.u) << "from t = " << memento->state.t;
    EXPECT_EQ(again.energy().balance(), whole.energy().balance());
  }
}

/// A strip under tension between two supports, one of which ends: it is slack then.
TEST(Release, LeavesAStaticBodyToWhatStillHoldsIt) {
  const auto deck = [](const std::string& left) {
    return R"(mesh: {generate: [{name: bar, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [2, 1], cells: quad4, sides: {left: left, right: right}}]}
physics: plane_stress
materials: {any: {young: 4, poisson: 0}}
loads: [{surface_force: {on: right, x: 0.1}}]
time: {scheme: static, step: 0.25, end: 1}
supports: [)" +
           left + "{on: right, x: 0.5, until: 0.5}]\n";
  };
  test::Walk walk(deck("{on: left, fix: [x, y]}, "));
  const auto end = walk.node_at(2, 0);
  ASSERT_TRUE(walk.advance() && walk.advance());
  EXPECT_NEAR(walk.displacement(end, 0), 0.5, 1e-14);
  ASSERT_TRUE(walk.to_end());
  EXPECT_NEAR(walk.displacement(end, 0), 0.05, 1e-14);
  try {
    test::model_of(deck("{on: left, fix: y}, "));
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("from t = 0.5 on, where a support ends"), std::string::npos)
        << error.what();
  }
}

} // namespace
} // namespace rubato::simulation::release_test
