// SPDX-License-Identifier: LGPL-3.0-or-later
/// Studies with relations: condensed steps against whole ones, turned models against upright ones, resultants
/// and energies.
#include "rubato/constraint/reduction.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>

namespace rubato::simulation::relations_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

study::Study study_of(const std::string& deck) {
  return deck::parse_deck(deck, "deck.yaml").runs.front();
}

/// A block of another mesh on a table, pressed and dragged, on springs that keep it from being lost; `more`
/// relates.
std::string block_on_table(const std::string& more, const std::string& time, const std::string& solver) {
  return fmt::format(R"(mesh:
  generate:
    - {{name: low, box: {{from: [0, -1, 0], to: [4, 0, 2]}}, divisions: [6, 2, 3], cells: hexa8, sides: {{bottom: ground, top: table, left: west, right: east}}}}
    - {{name: up, box: {{from: [1, 0, 0.5], to: [3, 1, 1.5]}}, divisions: [3, 2, 2], cells: hexa8, sides: {{bottom: sole, top: roof, left: back, right: face}}}}
physics: solid
materials: {{any: {{young: 2e5, poisson: 0.3, density: 7.8e-3}}}}
functions: {{press: {{times: [0, 1e-3, 2e-3], values: [0, 1, 1]}}, push: {{times: [0, 1e-3, 2e-3], values: [0, 0, 1]}}}}
springs: [{{on: face, x: 2e3, y: 2e3, z: 2e3}}]
contact: {{c: {{master: table, slave: sole, friction: 0.4, integration: nodes}}}}
newton: {{residual: 1e-13}}
solver: {}
time: {}
{})",
                     solver, time, more);
}

const std::string held = "supports: [{on: ground, fix: [x, y, z]}]\n";
const std::string pulled =
    "loads: [{nodal_force: {on: cap, y: -100, function: press}}, {nodal_force: {on: cap, x: "
    "25, function: push}}, {moment: {on: cap, y: 5, function: push}}]\n";

struct Related {
  std::string name;
  std::string deck;
};

std::vector<Related> related() {
  return {
      {"RigidRoof", held + pulled + "relations: {cap: {rigid: {on: roof}}}\n"},
      {"RigidTable", held + pulled + "relations: {cap: {rigid: {on: roof}}, top: {rigid: {on: table}}}\n"},
      {"DistributedRoof", held + pulled + "relations: {cap: {distributed: {on: roof}}}\n"},
      {"TurnedRoof",
       "supports: [{on: ground, fix: [x, y, z]}, {on: cap, turn: {y: {value: 0.01, function: push}}, "
       "y: {value: -1e-4, function: press}}]\nrelations: {cap: {rigid: {on: roof}}}\n"},
      {"PeriodicTable",
       held + pulled + "relations: {cap: {rigid: {on: roof}}, cell: {pairs: {on: east, with: west}}}\n"},
      {"ObliqueTable",
       "supports: [{on: ground, along: [0.1, 1, 0.2]}, {on: west, along: [1, 0.3, 0.2]}, {on: west, "
       "along: [0, -0.5, 1]}]\n" +
           pulled + "relations: {cap: {rigid: {on: roof}}}\n"},
      {"EmbeddedPlace",
       "supports: [{on: ground, fix: [x, y, z]}]\nloads: [{nodal_force: {on: cap, y: -100, x: 10, "
       "function: press}}]\nrelations: {cap: {embedded: {at: [2.2, 0.7, 1.1], in: up}}}\nconnectors: "
       "[{on: cap, along: [1, 0, 0.2], stiffness: 3e3}]\nmasses: [{on: cap, mass: 1e-3}]\n"},
      {"Connectors",
       "supports: [{on: ground, fix: [x, y, z]}]\n" + pulled +
           "relations: {cap: {rigid: {on: roof}}}\nconnectors: [{on: cap, along: [1, 0, 0.2], "
           "stiffness: 3e3, damping: 2}, {on: N5, to: cap, stiffness: 1e3}]\nmasses: [{on: roof, "
           "mass: 1e-3}]\n"}};
}

struct Course {
  std::string name;
  std::string time;
};

std::vector<Course> courses() {
  return {{"Static", "{scheme: static, step: 5e-4, end: 2e-3}"},
          {"Hht", "{scheme: hht, alpha: -0.1, step: 1.25e-4, end: 2e-3}"},
          {"MoreauJean", "{step: 1.25e-4, end: 2e-3}"}};
}

class RelatedStudy : public testing::TestWithParam<std::tuple<Related, Course>> {};

TEST_P(RelatedStudy, IsTheSameCondensedAndWhole) {
  const auto& [relation, course] = GetParam();
  test::Walk condensed(block_on_table(relation.deck, course.time, "condensed"));
  test::Walk whole(block_on_table(relation.deck, course.time, "full"));
  double off = 0;
  double largest = 0;
  while (!condensed.finished()) {
    ASSERT_TRUE(condensed.advance());
    ASSERT_TRUE(whole.advance());
    const auto& u = condensed.state().motion.u;
    off = std::max(off, (u - whole.state().motion.u).lpNorm<Eigen::Infinity>());
    largest = std::max(largest, u.lpNorm<Eigen::Infinity>());
  }
  EXPECT_LE(off, 1e-10 * largest);
  const auto& energy = condensed.simulation.energy();
  EXPECT_LE(std::abs(energy.balance()), 1e-12 * energy.largest());
}

TEST_P(RelatedStudy, KeepsItsRelationsAndBalancesAllForces) {
  const auto& [relation, course] = GetParam();
  test::Walk walk(block_on_table(relation.deck, course.time, "auto"));
  ASSERT_TRUE(walk.to_end());
  const auto& model = walk.model;
  const auto& u = walk.state().motion.u;
  VectorXd kept = u;
  model.reduction.impose(walk.state().t, kept);
  EXPECT_LE((kept - u).lpNorm<Eigen::Infinity>(), 1e-13 * u.lpNorm<Eigen::Infinity>());
  const VectorXd reaction = walk.state().reaction;
  EXPECT_LE(model.reduction.gather(reaction).lpNorm<Eigen::Infinity>(),
            1e-8 * reaction.lpNorm<Eigen::Infinity>());
}

/// The study with everything turned: supports along axes become supports along directions.
study::Study turned(study::Study study, const Matrix3d& q) {
  std::vector<study::Support> supports;
  for (const auto& support : study.supports)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (const auto& value = support.components[axis]) {
        study::Support oblique{support.on, {}};
        const Vector3d along = q.col(static_cast<Eigen::Index>(axis));
        oblique.along = study::ObliqueSupport{false, {along[0], along[1], along[2]}, *value};
        supports.push_back(oblique);
      }
  study.supports = supports;
  for (auto& load : study.loads) {
    Vector3d force;
    for (std::size_t axis = 0; axis < 3; ++axis)
      force[static_cast<Eigen::Index>(axis)] = *load.components[axis].number();
    const Vector3d to = q * force;
    for (std::size_t axis = 0; axis < 3; ++axis)
      load.components[axis] = to[static_cast<Eigen::Index>(axis)];
  }
  return study;
}

/// A block that friction drags over a clamped table, by every kind of scheme.
TEST(ATurnedModel, HasTheAnswerOfTheUprightOneTurned) {
  const Matrix3d q = Eigen::AngleAxisd(0.7, Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  for (const auto& course : courses()) {
    auto study = study_of(
        block_on_table("supports: [{on: ground, fix: [x, y, z]}, {on: roof, y: {value: -1e-3, function: "
                       "press}, x: {value: 2e-3, "
                       "function: push}, z: 0}]\nloads: [{nodal_force: {on: face, x: 1, y: 0.5, z: -2}}]\n",
                       course.time, "auto"));
    study.newton.residual = 1e-14; // what it leaves would count as a difference
    auto mesh = model::load_mesh(study.mesh);
    test::Walk upright(study, mesh);
    for (auto& point : mesh.points)
      point = q * point;
    test::Walk oblique(turned(study, q), mesh);
    ASSERT_TRUE(upright.to_end());
    ASSERT_TRUE(oblique.to_end());
    const auto& u = upright.state().motion.u;
    const auto& other = oblique.state().motion.u;
    double off = 0;
    for (Eigen::Index i = 0; i < u.size(); i += 3)
      off = std::max(off, (q * u.segment<3>(i) - other.segment<3>(i)).norm());
    EXPECT_LE(off, 1e-12 * u.lpNorm<Eigen::Infinity>()) << course.name;
    const auto& energy = upright.simulation.energy();
    EXPECT_NEAR(oblique.simulation.energy().support_work, energy.support_work, 1e-10 * energy.largest());
  }
}

/// It falls by 0.1, hits and stops: what it falls by goes into the impact, its way along the floor into
/// friction. Nothing of it is massless.
TEST(ARigidBlock, ComesToRestOnAFloor) {
  const std::string deck =
      R"(mesh: {generate: [{name: box, box: {from: [0, 0.1, 0], to: [1, 1.1, 1]}, divisions: [3, 3, 3], cells: hexa8, sides: {bottom: sole}}]}
physics: solid
materials: {any: {young: 1e7, poisson: 0.3, density: 1000}}
relations: {body: {rigid: {on: box}}}
loads: [{gravity: {y: -10}}]
initial: [{on: all, velocity: {x: 0.3}}]
contact: {floor: {slave: sole, obstacle: {plane: {point: [0, 0, 0], normal: [0, 1, 0]}}, friction: 0.3}}
)";
  // The residual bounds the error of friction: with the default, its last digits depend on the BLAS kernel.
  test::Walk walk(deck +
                  "time: {contact_mass: consistent, step: 1e-3, end: 0.3}\nnewton: {residual: 1e-12}\n");
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.model.reduction.unknown_count(), 6);
  const auto& energy = walk.simulation.energy();
  EXPECT_NEAR(energy.external_work, 1000, 2) << "a step early or late";
  EXPECT_NEAR(energy.friction, 45, 1e-8);
  EXPECT_NEAR(energy.impact, energy.external_work, 1e-8);
  EXPECT_LE(energy.kinetic, 1e-15);
  EXPECT_LE(std::abs(energy.balance()), 1e-12 * energy.largest());
  try {
    test::Walk(deck + "time: {step: 1e-3, end: 0.3}\n");
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("moves by a relation with nodes that have mass"),
              std::string::npos)
        << error.what();
  }
}

/// Two halves of different stiffness side by side along y, periodic, stretched along x: the stiffer carries
/// its share, E = ½ (E₁ + E₂); along y they are in series, 1/E = ½ (1/E₁ + 1/E₂). Without Poisson's effect
/// both are exact.
TEST(APeriodicCell, HasTheModuliOfLayers) {
  for (const auto* axis : {"x", "y"}) {
    const auto deck =
        fmt::format(R"(mesh:
  generate:
    - {{name: soft, rectangle: {{from: [0, 0], to: [1, 0.5]}}, divisions: [4, 2], cells: quad4, sides: {{bottom: floor, left: l1, right: r1, top: soft_top}}, points: {{left_bottom: origin}}}}
    - {{name: stiff, rectangle: {{from: [0, 0.5], to: [1, 1]}}, divisions: [4, 2], cells: quad4, sides: {{top: roof, left: l2, right: r2, bottom: stiff_bottom}}}}
physics: plane_stress
materials: {{a: {{young: 10, poisson: 0, cells: soft}}, b: {{young: 30, poisson: 0, cells: stiff}}}}
time: {{scheme: static, step: 1, end: 1}}
supports: [{{on: origin, fix: [x, y]}}]
relations:
  glue: {{pairs: {{on: stiff_bottom, with: soft_top}}}}
  x1: {{pairs: {{on: r1, with: l1, difference: {{x: {}}}}}}}
  x2: {{pairs: {{on: r2, with: l2, difference: {{x: {}}}}}}}
  y: {{pairs: {{on: roof, with: floor, difference: {{y: {}}}}}}}
)",
                    *axis == 'x' ? 0.01 : 0.0, *axis == 'x' ? 0.01 : 0.0, *axis == 'y' ? 0.01 : 0.0);
    test::Walk walk(deck);
    ASSERT_TRUE(walk.to_end());
    const double modulus = 2 * walk.simulation.energy().strain / 1e-4;
    EXPECT_NEAR(modulus, *axis == 'x' ? 20.0 : 15.0, 1e-10) << axis;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, RelatedStudy,
                         testing::Combine(testing::ValuesIn(related()), testing::ValuesIn(courses())),
                         [](const auto& chosen) {
                           return std::get<0>(chosen.param).name + std::get<1>(chosen.param).name;
                         });

} // namespace
} // namespace rubato::simulation::relations_test
