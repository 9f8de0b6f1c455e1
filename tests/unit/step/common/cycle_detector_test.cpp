// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/advance.hpp"
#include "rubato/step/common/cycle_detector.hpp"
#include "rubato/step/common/nested_loops.hpp"
#include "rubato/step/common/newton.hpp"
#include "rubato/step/full/whole_system.hpp"
#include "rubato/step/interface/condensed.hpp"
#include "rubato/study/study.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <optional>
#include <string>

namespace rubato::step::cycle_detector_test {
namespace {

using contact::Status;

ContactIterate with(Status first, Status second) {
  ContactIterate iterate;
  iterate.status = {{first}, {second}};
  return iterate;
}

TEST(CycleDetector, TellsHowManyIteratesAgoStatusesHadTheSameForces) {
  CycleDetector watch;
  EXPECT_FALSE(watch.length_of_cycle(with(Status::stick, Status::open), 1));
  EXPECT_FALSE(watch.length_of_cycle(with(Status::slip, Status::open), 2));
  EXPECT_EQ(watch.length_of_cycle(with(Status::stick, Status::open), 1 + 1e-12), 2);
  EXPECT_EQ(watch.length_of_cycle(with(Status::slip, Status::open), 2), 1);
}

TEST(CycleDetector, LetsStatusesComeBackWithOtherForces) {
  CycleDetector watch;
  EXPECT_FALSE(watch.length_of_cycle(with(Status::stick, Status::open), 1));
  EXPECT_FALSE(watch.length_of_cycle(with(Status::stick, Status::open), 1.001));
  EXPECT_FALSE(watch.length_of_cycle(with(Status::open, Status::stick), 1));
}

TEST(CycleDetector, ShortensTheCorrectionsOfAWholeCycleEachTimeMoreUntilIteratesComeBackTooOften) {
  CycleDetector watch;
  const auto part = [&](Status first, Status second) { return watch.part_of_next(with(first, second), 1); };
  double shortened = 1;
  for (int cycle = 0; cycle < 3; ++cycle) {
    shortened *= 0.4;
    EXPECT_EQ(part(Status::stick, Status::open), 1.0);
    EXPECT_EQ(part(Status::slip, Status::open), 1.0);
    EXPECT_EQ(part(Status::open, Status::open), 1.0);
    EXPECT_DOUBLE_EQ(*part(Status::stick, Status::open), shortened);
    EXPECT_DOUBLE_EQ(*part(Status::slip, Status::slip), shortened);
    EXPECT_DOUBLE_EQ(*part(Status::slip, Status::slip), shortened);
  }
  EXPECT_EQ(part(Status::stick, Status::open), 1.0);
  EXPECT_EQ(part(Status::stick, Status::open), std::nullopt);
}

/// One node of a square touches a rigid floor, all others are held: two unknowns, so that the iterates can be
/// told by hand. Its stiffness is K = c [[0.45, −0.1625], [−0.1625, 0.45]], c = E/(1 − ν²), and the load
/// pulls it to the left and a little up. Where it sticks the floor would have to hold it down: it opens.
/// Where it is open it moves left and, by ν, down into the floor: it closes, and with a spring as stiff and a
/// c_t as small as these it sticks. So do parts of these corrections. The answer, it slips, has no status
/// that leads to it.
const std::string pulled_corner = R"(
mesh:
  generate:
    - {name: square, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [1, 1], cells: quad4,
       sides: {left: wall, bottom: under}, points: {right_top: top, right_bottom: corner}}
physics: plane_stress
materials: {rubber: {young: 0.91e6, poisson: 0.3}}
supports: [{on: wall, fix: [x, y]}, {on: top, fix: [x, y]}]
loads: [{nodal_force: {on: corner, x: -100, y: 10}}]
contact:
  floor:
    slave: under
    integration: nodes
    obstacle: {plane: {point: [0, 0], normal: [0, 1]}}
    exclude_nodes: [wall]
    friction: 0.3
    initially_active: false
    method: penalty
    friction_method: augmented_lagrangian
    coefficients: {normal: 1e10, tangential: 1e-3}
time: {scheme: static, step: 1, end: 1, on_failure: {levels: 0}}
)";

constexpr double stiffness = 0.45e6;   ///< of the node along x and along y
constexpr double coupling = -0.1625e6; ///< of x and y

template <class Solver> StepReport attempt(test::Walk& walk, Start start) {
  auto system = make_effective_system(walk.model, walk.scheme, 1);
  ContactEvaluator side(walk.model, walk.scheme, system, walk.state(), {.start = start});
  Progress progress;
  Solver solver(walk.model, walk.scheme, system, walk.state(), 1, side, progress);
  auto trial = predict(walk.model, walk.scheme, system, walk.state(), 1);
  return solve_levels(
      walk.model, side,
      [&](State& to, const Frozen& frozen) {
        return run_newton(solver, walk.model.study.newton.max_iterations, progress, to, frozen);
      },
      walk.state(), trial);
}

TEST(Cycles, EndAnAttemptAndNameTheirPoints) {
  test::Walk walk(pulled_corner);
  const auto report = attempt<Condensed>(walk, Start::last_step);
  ASSERT_EQ(report.outcome, Outcome::cycling);
  EXPECT_EQ(report.status_changes, 1);
  ASSERT_EQ(report.changing_points.size(), 1U);
  const auto& point = report.changing_points.front();
  EXPECT_EQ(point.node, walk.node_at(1, 0));
  EXPECT_TRUE((point.before == Status::open && point.now == Status::stick) ||
              (point.before == Status::stick && point.now == Status::open));
}

TEST(Cycles, AreTheSameOfPointsAndOfTheWholeMotion) {
  test::Walk walk(pulled_corner);
  const auto condensed = attempt<Condensed>(walk, Start::last_step);
  const auto whole = attempt<WholeSystem>(walk, Start::last_step);
  EXPECT_EQ(condensed.outcome, Outcome::cycling);
  EXPECT_EQ(whole.outcome, Outcome::cycling);
  EXPECT_EQ(condensed.iterations, whole.iterations);
  ASSERT_EQ(whole.changing_points.size(), 1U);
  EXPECT_EQ(condensed.changing_points.front().node, whole.changing_points.front().node);
}

/// The guess knows that it slips: K₁₁ x = F₁ + μ λ, λ = K₂₁ x − F₂.
TEST(Cycles, AreNoneWhereTheStepStartsFromTheGuess) {
  test::Walk walk(pulled_corner);
  ASSERT_TRUE(walk.advance());
  ASSERT_EQ(walk.reports.size(), 1U);
  EXPECT_EQ(walk.state().zones.front().status.back(), Status::slip);
  const double slid = (-100 - 0.3 * 10) / (stiffness - 0.3 * coupling);
  EXPECT_NEAR(walk.displacement(walk.node_at(1, 0), 0), slid, 1e-3 * std::abs(slid));
  EXPECT_NEAR(walk.resultants().normal, coupling * slid - 10, 1e-3 * coupling * slid);
}

} // namespace
} // namespace rubato::step::cycle_detector_test
