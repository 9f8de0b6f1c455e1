// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bolts that are tightened, against hand calculations with bars.
#include "rubato/core/error.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/domain/cut.hpp"
#include "rubato/model/preloads.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::simulation::preload_test {
namespace {

/// A bolt between two plates, each of them one above another that it touches, all of width 1 and length 4 in
/// all, with common heads: the ground and one height of all tops.
std::string joint(const std::string& preload, const std::string& more,
                  const std::string& time = "{scheme: static, step: 0.25, end: 2}") {
  return fmt::format(R"(mesh:
  generate:
    - {{name: bolt, rectangle: {{from: [0, 0], to: [1, 4]}}, divisions: [2, 8], cells: quad4, sides: {{bottom: ground, top: heads}}}}
    - {{name: low_left, rectangle: {{from: [-2, 0], to: [-1, 2]}}, divisions: [1, 2], cells: quad4, sides: {{bottom: ground, top: over}}}}
    - {{name: high_left, rectangle: {{from: [-2, 2], to: [-1, 4]}}, divisions: [1, 2], cells: quad4, sides: {{bottom: under, top: heads}}}}
    - {{name: low_right, rectangle: {{from: [2, 0], to: [3, 2]}}, divisions: [1, 2], cells: quad4, sides: {{bottom: ground, top: over}}}}
    - {{name: high_right, rectangle: {{from: [2, 2], to: [3, 4]}}, divisions: [1, 2], cells: quad4, sides: {{bottom: under, top: heads}}}}
physics: plane_stress
materials:
  steel: {{young: 2e5, poisson: 0, density: 1e-3, cells: bolt}}
  soft: {{young: 3e4, poisson: 0, density: 1e-3, cells: [low_left, high_left, low_right, high_right]}}
functions: {{tighten: {{ramp: [0, 1]}}, work: {{ramp: [1, 2]}}}}
supports: [{{on: ground, fix: [x, y]}}, {{on: heads, fix: x}}]
relations: {{cap: {{equal: {{on: heads, in: y}}}}}}
contact: {{joint: {{master: over, slave: under, integration: nodes}}}}
newton: {{residual: 1e-12}}
preload: {{m1: {{cut: {{point: [0, 1.6], normal: [0, 1], cells: bolt}}, {}}}}}
probes: {{at_cut: {{section: {{point: [0.5, 1.6], normal: [0, 1], cells: bolt}}}}, above: {{section: {{point: [0.5, 3.1], normal: [0, 1], cells: bolt}}}}}}
time: {}
{})",
                     preload, time, more);
}

/// [force/length]
constexpr double bolt = 2e5 / 4;
constexpr double plates = 2 * 3e4 / 4;

double force_in(const Simulation& simulation, std::size_t probe) {
  return domain::forces_at(test::ModelParts(simulation.model()).probe_cuts[probe],
                           simulation.state().motion.u)[1];
}

double height(const Simulation& simulation) {
  const test::ModelParts model(simulation.model());
  for (const auto node : model.dofs.nodes)
    if (model.mesh.points[static_cast<std::size_t>(node)].isApprox(Eigen::Vector3d(1, 4, 0)))
      return simulation.state().motion.u[model.dofs.dof(node, 1)];
  return NAN;
}

double shortening(const Simulation& simulation) {
  const test::ModelParts model(simulation.model());
  const auto& pair = model.preloads.at(0).pairs.front();
  const auto& u = simulation.state().motion.u;
  return u[model.dofs.dof(pair.behind, 1)] - u[model.dofs.dof(pair.in_front, 1)];
}

void go_to(Simulation& simulation, double t) {
  while (!simulation.finished() && simulation.state().t < t - 1e-9)
    ASSERT_TRUE(simulation.advance().accepted());
}

/// P on the heads, all of it in the second half.
std::string pulled(double p) {
  return fmt::format("loads: [{{surface_force: {{on: heads, y: {}, function: work}}}}]\n", p / 3);
}

TEST(Preload, ByAForceIsWhatTheCutTransmits) {
  Simulation simulation(test::study_of(joint("force: 100, function: tighten", pulled(60))));
  go_to(simulation, 1);
  EXPECT_NEAR(force_in(simulation, 0), 100, 1e-9);
  EXPECT_NEAR(force_in(simulation, 1), 100, 1e-9);
  EXPECT_NEAR(height(simulation), -100 / plates, 1e-10);
  EXPECT_NEAR(shortening(simulation), 100 / plates + 100 / bolt, 1e-10);
  const auto& energy = simulation.energy();
  EXPECT_NEAR(energy.external_work, 50 * (100 / plates + 100 / bolt), 1e-7);
  EXPECT_NEAR(energy.strain, energy.external_work, 1e-9);
  // without a lock it is 100 whatever pulls: the plates give way alone
  go_to(simulation, 2);
  EXPECT_NEAR(force_in(simulation, 0), 100, 1e-9);
  EXPECT_NEAR(height(simulation), -40 / plates, 1e-10);
  EXPECT_LE(std::abs(energy.balance()), 1e-10 * energy.largest());
}

TEST(Preload, ThatIsLockedLetsBoltAndPlatesShareLoads) {
  Simulation simulation(test::study_of(joint("force: 100, function: tighten, lock: 1", pulled(60))));
  go_to(simulation, 2);
  EXPECT_NEAR(force_in(simulation, 0), 100 + 60 * bolt / (bolt + plates), 1e-9);
  EXPECT_NEAR(height(simulation), -100 / plates + 60 / (bolt + plates), 1e-10);
  EXPECT_NEAR(shortening(simulation), 100 / plates + 100 / bolt, 1e-10);
  EXPECT_LE(std::abs(simulation.energy().balance()), 1e-10 * simulation.energy().largest());
}

/// More than 100 (1 + bolt/plates) opens the joint: the bolt alone carries what pulls.
TEST(Preload, ThatIsOvercomeLeavesAllToTheBolt) {
  Simulation simulation(test::study_of(
      joint("force: 100, function: tighten, lock: 1", pulled(500) + "springs: [{on: under, y: 1e-3}]\n")));
  go_to(simulation, 2);
  EXPECT_NEAR(force_in(simulation, 0), 500, 1e-3);
}

TEST(Preload, ByAShorteningIsDoneBySupports) {
  Simulation simulation(test::study_of(joint("displacement: 1e-2, function: tighten", "")));
  go_to(simulation, 1);
  const double force = 1e-2 / (1 / plates + 1 / bolt);
  EXPECT_NEAR(shortening(simulation), 1e-2, 1e-16);
  EXPECT_NEAR(force_in(simulation, 0), force, 1e-9 * force);
  EXPECT_NEAR(simulation.energy().support_work, force * 1e-2 / 2, 1e-10);
  EXPECT_LE(std::abs(simulation.energy().balance()), 1e-10 * simulation.energy().largest());
}

TEST(Preload, IsLockedInDynamicRuns) {
  for (const auto* time : {"{scheme: hht, alpha: -0.1, step: 0.02, end: 2}", "{step: 0.02, end: 2}"}) {
    Simulation simulation(test::study_of(joint("force: 100, function: tighten, lock: 1", pulled(60), time)));
    double balance = 0;
    while (!simulation.finished()) {
      ASSERT_TRUE(simulation.advance().accepted());
      balance = std::max(balance, std::abs(simulation.energy().balance()));
    }
    EXPECT_LE(balance, 1e-10 * simulation.energy().largest()) << time;
    EXPECT_NEAR(force_in(simulation, 0), 100 + 60 * bolt / (bolt + plates), 0.05) << time;
  }
}

TEST(Preload, GoesOnFromAMementoToTheSameBits) {
  const auto deck = joint("force: 100, function: tighten, lock: 1", pulled(60));
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
  }
}

/// A run that starts from the end of another one may lock at its begin.
TEST(Preload, IsLockedAtTheBeginOfARunThatGoesOn) {
  Simulation first(test::study_of(joint("force: 100", "", "{scheme: static, step: 1, end: 1}")));
  go_to(first, 1);
  const auto runs =
      deck::parse_deck(joint("force: 100", pulled(60), "{scheme: static, step: 1, end: 1}") +
                           "runs:\n  one: {}\n  two: {time: {begin: 1, end: 2, start: {from: one}}, "
                           "preload: {m1: {lock: 1}}}\n",
                       "deck.yaml");
  Simulation second(runs.runs.at(1), {.previous = &first.state()});
  go_to(second, 2);
  EXPECT_NEAR(force_in(second, 0), 100 + 60 * bolt / (bolt + plates), 1e-9);
}

/// A bar in space that an oblique plane cuts: the force along the normal is what was asked.
TEST(Preload, CutsSolidsAlongAnyNormal) {
  test::Walk walk(
      R"(mesh: {generate: [{name: bar, box: {from: [0, 0, 0], to: [1, 1, 4]}, divisions: [2, 2, 8], cells: hexa20, sides: {front: far, back: near}}]}
physics: solid
materials: {steel: {young: 2e5, poisson: 0.3}}
supports: [{on: far, fix: [x, y, z]}, {on: near, fix: [x, y, z]}]
preload: {m1: {cut: {point: [0.5, 0.5, 1.6], normal: [0.1, 0.2, 1]}, force: 50}}
probes: {cut: {section: {point: [0.5, 0.5, 1.6], normal: [0.1, 0.2, 1]}}, back: {section: {point: [0.5, 0.5, 1.6], normal: [-0.1, -0.2, -1]}}}
time: {scheme: static, step: 1, end: 1}
)");
  ASSERT_TRUE(walk.to_end());
  const Eigen::Vector3d normal = Eigen::Vector3d(0.1, 0.2, 1).normalized();
  const auto& u = walk.state().motion.u;
  const Eigen::VectorXd forward = domain::forces_at(walk.model.probe_cuts[0], u);
  const Eigen::VectorXd backward = domain::forces_at(walk.model.probe_cuts[1], u);
  EXPECT_NEAR(normal.dot(forward.head<3>()), 50, 1e-9 * 50);
  EXPECT_LE((forward + backward).lpNorm<Eigen::Infinity>(), 1e-9 * 50);
}

TEST(Preload, RefusesWhatItCannotCut) {
  const auto told = [](const std::string& from, const std::string& to) {
    auto deck = joint("force: 100", "");
    deck.replace(deck.find(from), from.size(), to);
    try {
      test::model_of(deck);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("nothing");
  };
  const std::string cut = "{point: [0, 1.6], normal: [0, 1], cells: bolt}, ";
  EXPECT_NE(told(cut, "{point: [0, 9], normal: [0, 1], cells: bolt}, ").find("the plane cuts nothing"),
            std::string::npos);
  EXPECT_NE(told(cut, "{point: [0, 1.6], normal: [0, 1], cells: bolts}, ").find("did you mean 'bolt'"),
            std::string::npos);
}

} // namespace
} // namespace rubato::simulation::preload_test
