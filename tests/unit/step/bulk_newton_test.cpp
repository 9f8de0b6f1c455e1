// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps of bodies that yield, turn and stretch.
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/mesh/names.hpp"
#include "rubato/step/advance.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::bulk_newton_test {
namespace {

using test::Walk;

/// A quarter of a rubber pad that sticks to a plate, which comes down by two fifths of its height.
const std::string pad = R"(
mesh: {generate: [{name: pad, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [8, 8], cells: quad4,
  sides: {left: middle, bottom: ground, top: plate}, points: {right_bottom: corner}}]}
physics: plane_strain
materials: {rubber: {law: hyperelastic, c10: 0.5, bulk: 200}}
functions: {down: {ramp: {begin: 0, end: 1}}}
supports: [{on: middle, fix: [x]}, {on: ground, fix: [y]}, {on: plate, fix: [x]},
  {on: plate, y: {value: -0.4, function: down}}]
time: {scheme: static, step: 0.05, end: 1}
)";

/// Half a billet between dies that it sticks to, which press it by 60 %: its side rolls onto them.
const std::string billet = R"(
mesh:
  generate: [{name: billet, rectangle: {from: [0, 0], to: [10, 15]}, divisions: [8, 12], cells: quad4,
    sides: {left: axis, bottom: middle, right: side, top: top}, points: {right_bottom: waist}}]
  groups: {skin: {union: [side, top]}}
physics: axisymmetric
materials: {metal: {law: plastic, young: 200e3, poisson: 0.3, strain: logarithmic,
  hardening: {linear: {yield_stress: 700, modulus: 300}}}}
functions: {down: {ramp: {begin: 0, end: 1}}}
supports: [{on: axis, fix: [x]}, {on: middle, fix: [y]}]
contact: {die: {slave: skin, friction: 10,
  obstacle: {plane: {point: [0, 15], normal: [0, -1]}, move: {y: {value: -9, function: down}}}}}
time: {scheme: static, step: 0.0166666666666666667, end: 1}
)";

/// A ball is pressed into ground that flows, in steps that are far too long.
const std::string dent = R"(
mesh: {generate: [{name: ground, rectangle: {from: [0, -400], to: [400, 0]}, divisions: [8, 8],
  sides: {left: axis, bottom: base, top: top}}]}
physics: axisymmetric
materials: {metal: {law: plastic, young: 210e3, poisson: 0.3, hardening: {linear: {yield_stress: 50}}}}
functions: {down: {ramp: {begin: 0, end: 1}}}
supports: [{on: axis, fix: [x]}, {on: base, fix: [x, y]}]
contact: {ball: {slave: top,
  obstacle: {sphere: {point: [0, 500], radius: 500}, move: {y: {value: -5, function: down}}}}}
time: {scheme: static, step: 1, end: 1}
)";
/// A rubber column that would buckle without the plate that presses it by three tenths of its height.
const std::string column = R"(
mesh: {generate: [{name: column, rectangle: {from: [-5, 0], to: [5, 12]}, divisions: [5, 6], cells: quad4,
  sides: {bottom: foot, top: head}, points: {right_top: corner}}]}
physics: plane_strain
materials: {rubber: {law: hyperelastic, c10: 0.5, bulk: 50}}
functions: {down: {ramp: {begin: 0, end: 1}}, aside: {ramp: {begin: 1, end: 1.5}}}
supports: [{on: foot, fix: [x, y]}]
contact: {plate: {slave: head, friction: 2, obstacle: {plane: {point: [0, 12], normal: [0, -1]},
  move: {x: {value: 2, function: aside}, y: {value: -3.6, function: down}}}}}
time: {scheme: static, step: 0.05, end: 1}
)";
/// A block of metal that flows from the first step on, sheared and stretched by as much as itself.
const std::string sheared = R"(
mesh: {generate: [{name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [8, 8], cells: quad4,
  sides: {top: top, bottom: held}}]}
physics: plane_strain
materials: {metal: {law: plastic, young: 200e9, poisson: 0.3,
  hardening: {linear: {yield_stress: 400e6, modulus: 1e9}}}}
functions: {ramp: {ramp: {begin: 0, end: 1}}}
supports: [{on: held, fix: [x, y]}, {on: top, x: {value: 2, function: ramp}, y: {value: 2, function: ramp}}]
time: {scheme: static, step: 0.01, end: 0.1}
)";
/// A block of metal that flows at a constant stress, between two plates of which the upper one comes down and
/// then goes aside.
const std::string slipping = R"(
mesh: {generate: [{name: block, rectangle: {from: [-10, 0], to: [10, 15]}, divisions: [4, 3], cells: quad8,
  sides: {bottom: foot, top: head}}]}
physics: plane_strain
materials: {metal: {law: plastic, young: 70e3, poisson: 0.3, strain: logarithmic,
  hardening: {linear: {yield_stress: 207}}}}
functions: {down: {ramp: {begin: 0, end: 1}}, aside: {ramp: {begin: 1, end: 2}}}
contact:
  above: {slave: head, friction: 0.2, method: penalty, obstacle: {plane: {point: [0, 15], normal: [0, -1]},
    move: {x: {value: 2, function: aside}, y: {value: -2, function: down}}}}
  below: {slave: foot, friction: 0.2, method: penalty, obstacle: {plane: {point: [0, 0], normal: [0, 1]}}}
time: {scheme: static, step: 0.1, end: 2}
)";
const std::string held_column = R"([{on: foot, fix: [x, y]}, {on: head, fix: x,
  y: {value: -3.6, function: down}}])";

double moved(const Walk& walk, const std::string& node, int axis) {
  const auto& model = walk.model;
  return walk.state().motion.u[model.dofs.dof(mesh::find_nodes(model.mesh, node).nodes.front(), axis)];
}

double reaction(const Walk& walk, const std::string& group, int axis) {
  double sum = 0;
  for (const auto node : mesh::find_nodes(walk.model.mesh, group).nodes)
    sum += walk.state().reaction[walk.model.dofs.dof(node, axis)];
  return sum;
}

int factorisations(const Walk& walk) {
  int sum = 0;
  for (const auto& report : walk.reports)
    sum += report.factorisations;
  return sum;
}

TEST(BulkNewton, PressesRubberWithoutACutWhateverTheTangent) {
  std::vector<double> forces;
  std::vector<int> factors;
  for (const auto* tangent : {"full", "kept", "auto"}) {
    Walk walk(pad, {{"newton.tangent", tangent}, {"newton.residual", "1.0e-11"}});
    ASSERT_TRUE(walk.to_end()) << tangent;
    EXPECT_EQ(walk.simulation.counters().cuts, 0) << tangent;
    forces.push_back(reaction(walk, "plate", 1));
    factors.push_back(factorisations(walk));
  }
  EXPECT_NEAR(forces[1], forces[0], 1e-9 * std::abs(forces[0]));
  EXPECT_NEAR(forces[2], forces[0], 1e-9 * std::abs(forces[0]));
  EXPECT_LT(factors[1], factors[0]);
}

/// L. M. Taylor and E. B. Becker's billet (CMAME 39 (1983) 251–277); the radius is that of two other meshes
/// within 1 %.
TEST(BulkNewton, UpsetsABilletWhoseSideRollsOntoTheDie) {
  Walk walk(billet);
  ASSERT_TRUE(walk.to_end());
  EXPECT_NEAR(10 + moved(walk, "waist", 0), 16.53, 0.01 * 16.53);
  EXPECT_LE(walk.deepest_cut, 4);
  EXPECT_GE(points_in_contact(walk.state()), 11);
  EXPECT_LE(std::abs(walk.simulation.energy().balance()), 1e-10 * walk.simulation.energy().largest());
}

/// Iterations may run away, to where any force would be rounding of the stiffness times the displacements.
TEST(BulkNewton, EndsNoStepWhereBodiesHaveRunAway) {
  Walk walk(dent);
  walk.accepted = [&] { EXPECT_LT(walk.state().motion.u.lpNorm<Eigen::Infinity>(), 10); };
  EXPECT_TRUE(walk.to_end());
}

TEST(BulkNewton, CutsStepsInWhichPlasticStrainGrowsTooMuch) {
  Walk free(billet, {{"time.end", "0.1"}});
  Walk held(billet, {{"time.end", "0.1"}, {"time.max_plastic_step", "0.01"}});
  while (!free.finished())
    ASSERT_TRUE(free.advance());
  while (!held.finished())
    ASSERT_TRUE(held.advance());
  EXPECT_GT(held.simulation.counters().cuts, 0);
  EXPECT_EQ(free.simulation.counters().cuts, 0);
  EXPECT_NEAR(moved(held, "waist", 0), moved(free, "waist", 0), 0.05 * moved(free, "waist", 0));
}

bool was_indefinite(const Walk& walk) {
  return std::ranges::any_of(walk.reports, &StepReport::indefinite);
}

TEST(BulkNewton, HoldsByContactWhatIsNotStableWithoutIt) {
  Walk pressed(column);
  Walk held(column, {{"contact", "~"}, {"supports", held_column}});
  while (!pressed.finished())
    ASSERT_TRUE(pressed.advance());
  while (!held.finished())
    ASSERT_TRUE(held.advance());
  EXPECT_TRUE(was_indefinite(pressed));
  EXPECT_FALSE(was_indefinite(held));
  EXPECT_EQ(pressed.simulation.counters().cuts, 0);
  EXPECT_NEAR(reaction(pressed, "foot", 1), reaction(held, "foot", 1),
              1e-6 * std::abs(reaction(held, "foot", 1)));
}

/// The springs that hold it there are in the way of points that slip, and of none in the end.
TEST(BulkNewton, FollowsWhatSlidesAndIsNotStableWithoutContact) {
  Walk walk(column, {{"time.end", "1.5"}, {"contact.plate.friction", "0.3"}});
  while (!walk.finished())
    ASSERT_TRUE(walk.advance());
  EXPECT_TRUE(was_indefinite(walk));
  EXPECT_LE(std::abs(walk.simulation.energy().balance()), 1e-10 * walk.simulation.energy().largest());
}

/// With contact in the matrix of every iteration nothing is saved by an old tangent.
TEST(BulkNewton, TakesEachTangentAnewWhereContactStandsInTheMatrix) {
  std::vector<std::vector<double>> residuals;
  for (const auto* tangent : {"full", "auto"}) {
    Walk walk(column, {{"solver", "full"}, {"newton.tangent", tangent}, {"time.end", "0.1"}});
    ASSERT_TRUE(walk.to_end());
    residuals.push_back(walk.reports.back().bulk_residuals);
  }
  EXPECT_EQ(residuals[0], residuals[1]);
  EXPECT_LE(residuals[0].size(), 6U);
}

/// It slips along both plates, wherever it is between them: its matrix is nearly singular, and the springs
/// that make it positive definite without contact are in the way.
TEST(BulkNewton, FindsAPlaceForABlockThatSlipsAlongBothOfItsPlates) {
  Walk walk(slipping);
  ASSERT_TRUE(walk.to_end());
  EXPECT_TRUE(was_indefinite(walk));
  EXPECT_EQ(walk.simulation.counters().cuts, 0);
  EXPECT_LE(std::abs(walk.simulation.energy().balance()), 1e-10 * walk.simulation.energy().largest());
}

TEST(BulkNewton, IsSearchedAlongItsMovesWhereNothingTouches) {
  Walk walk(sheared);
  while (!walk.finished())
    ASSERT_TRUE(walk.advance());
  EXPECT_EQ(walk.simulation.counters().cuts, 0);
  for (const auto& report : walk.reports)
    EXPECT_LE(report.iterations, report.bulk_iterations + 1) << "one attempt, which goes on with the search";
  EXPECT_LE(std::abs(walk.simulation.energy().balance()), 1e-10 * walk.simulation.energy().largest());
}

TEST(BulkNewton, VariesTheLengthOfSteps) {
  Walk walk(pad, {{"time.max_step", "0.2"}, {"time.step", "0.01"}});
  int steps = 0;
  while (!walk.finished()) {
    ASSERT_TRUE(walk.simulation.advance().accepted());
    ++steps;
  }
  EXPECT_LT(steps, 40);
  EXPECT_DOUBLE_EQ(walk.state().t, 1);
  EXPECT_NEAR(
      reaction(walk, "plate", 1),
      [] {
        Walk even(pad);
        while (!even.finished())
          even.advance();
        return reaction(even, "plate", 1);
      }(),
      1e-6);
}

} // namespace
} // namespace rubato::step::bulk_newton_test
