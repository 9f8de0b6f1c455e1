// SPDX-License-Identifier: LGPL-3.0-or-later
/// The three nested levels by Newton or by loops, and every method they carry, must end at one answer.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/common/nested_loops.hpp"
#include "rubato/step/common/newton.hpp"
#include "rubato/step/full/whole_system.hpp"
#include "rubato/study/study.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <limits>
#include <string>

namespace rubato::step::nested_loops_test {
namespace {

using test::Walk;
using Changes = std::vector<deck::Setting>;

const Changes short_run{{"time.end", "0.004"}};

Changes with(Changes changes) {
  changes.insert(changes.end(), short_run.begin(), short_run.end());
  return changes;
}

std::string loop(const std::string& tolerance) {
  return "{by: fixed_point, tolerance: " + tolerance + ", max_loops: 60}";
}

Eigen::VectorXd end_of(const Changes& changes) {
  Walk walk(test::two_beams, with(changes));
  EXPECT_TRUE(walk.to_end());
  return walk.state().motion.u;
}

double apart(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).lpNorm<Eigen::Infinity>() / b.lpNorm<Eigen::Infinity>();
}

struct Method {
  const char* name;
  const char* method;
  const char* friction_method;
};

class EveryMethod : public testing::TestWithParam<Method> {
protected:
  Changes changes(const std::string& levels) const {
    return {{"contact.interface.method", GetParam().method},
            {"contact.interface.friction_method", GetParam().friction_method},
            {"contact.interface.iterate", levels}};
  }
};

TEST_P(EveryMethod, EndsAtTheSameAnswerWhicheverLevelsLoop) {
  const auto tight = loop("1e-9");
  const bool nodal = std::string(GetParam().method).starts_with("nodal");
  const auto reference = end_of(changes(nodal ? "{geometry: " + tight + "}" : "{geometry: newton}"));
  for (const std::string& levels :
       std::vector<std::string>{"{geometry: " + tight + ", friction: " + tight + "}",
                                "{geometry: " + tight + ", status: fixed_point}",
                                "{geometry: " + tight + ", friction: " + tight + ", status: fixed_point}"})
    EXPECT_LT(apart(end_of(changes(levels)), reference), 1e-7) << levels;
}

INSTANTIATE_TEST_SUITE_P(
    Methods, EveryMethod,
    testing::Values(Method{"Exact", "augmented_lagrangian", "augmented_lagrangian"},
                    Method{"ExactWithPenalizedFriction", "augmented_lagrangian", "penalty"},
                    Method{"Penalty", "penalty", "penalty"},
                    Method{"PenaltyWithExactFriction", "penalty", "augmented_lagrangian"},
                    Method{"NodalLagrange", "nodal_lagrange", "nodal_penalty"},
                    Method{"NodalPenalty", "nodal_penalty", "nodal_penalty"}),
    [](const auto& method) { return std::string(method.param.name); });

TEST(Penalties, ComeCloserToTheExactAnswerAsTheyGrow) {
  const auto exact = end_of({});
  const auto with_penalty = [](const std::string& normal, const std::string& tangential) {
    return end_of(
        {{"contact.interface.method", "penalty"},
         {"contact.interface.coefficients", "{normal: " + normal + ", tangential: " + tangential + "}"}});
  };
  const double soft = apart(with_penalty("1e11", "1e6"), exact);
  const double stiff = apart(with_penalty("1e13", "1e6"), exact);
  EXPECT_LT(stiff, 3e-2 * soft);
  EXPECT_LT(stiff, 1e-3);
}

TEST(TheGeometryLoop, TakesTwoRoundsAtLeastAndIsReported) {
  Walk walk(test::two_beams, with({{"contact.interface.iterate", "{geometry: fixed_point}"}}));
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    const auto& rounds = walk.reports.back().rounds;
    ASSERT_GE(rounds.size(), 2U);
    int iterations = 0;
    for (std::size_t i = 0; i < rounds.size(); ++i) {
      EXPECT_EQ(rounds[i].level, LoopLevel::geometry);
      EXPECT_EQ(rounds[i].round, static_cast<int>(i) + 1);
      EXPECT_EQ(rounds[i].settled, i + 1 == rounds.size());
      iterations += rounds[i].iterations;
    }
    EXPECT_LE(rounds.back().change, 1e-2);
    EXPECT_EQ(iterations, walk.reports.back().iterations);
  }
}

TEST(ALoopThatDoesNotSettle, SaysWhichOneItIs) {
  const auto outcome = [](const std::string& levels) {
    Walk walk(test::two_beams,
              with({{"contact.interface.iterate", levels}, {"time.on_failure.levels", "0"}}));
    EXPECT_FALSE(walk.to_end());
    return walk.reports.back().outcome;
  };
  EXPECT_EQ(outcome("{geometry: {by: fixed_point, max_loops: 1}}"), Outcome::geometry_unsettled);
  EXPECT_EQ(outcome("{friction: {by: fixed_point, max_loops: 1}}"), Outcome::friction_unsettled);
}

const Changes single_status_round{{"contact.interface.iterate", "{status: {by: fixed_point, max_loops: 1}}"},
                                  {"time.on_failure.levels", "0"}};

TEST(ALoopOfTheStatusThatDoesNotSettle, SaysSo) {
  Walk walk(test::two_beams, with(single_status_round));
  auto system = make_effective_system(walk.model, walk.scheme, walk.length());
  const double t = walk.target();
  State trial = predict(walk.model, walk.scheme, system, walk.state(), t);
  ContactEvaluator side(walk.model, walk.scheme, system, walk.state(), {});
  Progress progress;
  WholeSystem whole(walk.model, walk.scheme, system, walk.state(), t, side, progress);
  const auto report = solve_levels(
      walk.model, side,
      [&](State& to, const Frozen& frozen) {
        return run_newton(whole, walk.model.study.newton.max_iterations, progress, to, frozen);
      },
      walk.state(), trial);
  EXPECT_EQ(report.outcome, Outcome::status_unsettled);
}

TEST(ALoopOfTheStatusThatDoesNotSettle, IsLeftToNewton) {
  EXPECT_LT(apart(end_of(single_status_round), end_of({})), 1e-9);
}

TEST(FurtherChanges, AreThoseOfAGeometricSeries) {
  EXPECT_EQ(further_changes(0, 1), 0);
  EXPECT_NEAR(further_changes(0.5, 1), 0.5, 1e-15);
  EXPECT_NEAR(further_changes(1e-3, 1e-3 / 0.996), 0.249, 1e-12);
  EXPECT_EQ(further_changes(1, 1), std::numeric_limits<double>::infinity());
}

/// A slave node that stands on the corner of two curved master faces belongs to neither while all moves: it
/// hops from one to the other in every iteration, unless it is held on one of them.
TEST(ANodeBetweenTwoCurvedFaces, IsSettledByNewton) {
  Walk walk(R"(
mesh:
  generate:
    - {name: low, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [2, 2], cells: quad9, sides: {left: left, bottom: ground, top: low_face}}
    - {name: high, rectangle: {from: [0, 1], to: [1, 2]}, divisions: [3, 3], cells: quad9, sides: {left: left, top: roof, bottom: high_face}}
physics: plane_strain
materials: {rubber: {young: 2e6, poisson: 0}}
supports: [{on: ground, fix: y}, {on: roof, y: -0.1}, {on: left, fix: x}]
contact: {interface: {master: low_face, slave: high_face, integration: nodes}}
time: {scheme: static, step: 1, end: 1, on_failure: {levels: 0}}
)");
  ASSERT_TRUE(walk.to_end());
  EXPECT_FALSE(walk.reports.back().geometry_by_loop);
  EXPECT_LE(walk.reports.back().iterations, 15);
  EXPECT_EQ(walk.resultants().in_contact, 7);
  EXPECT_NEAR(walk.resultants().force[1], 1e5, 2e3);
}

TEST(HistoryForce, OnlyMattersWhereTheSchemeWeighsTheStartOfAStep) {
  const Changes forgetful{{"contact.interface.history_force", "false"}};
  EXPECT_GT(apart(end_of(forgetful), end_of({})), 1e-4);
  const Changes newmark{{"time.scheme", "newmark"}, {"time.alpha", "~"}};
  auto both = newmark;
  both.push_back(forgetful.front());
  EXPECT_EQ(end_of(both), end_of(newmark));
}

TEST(NodalMethods, PutOneUnweightedRelationOnEverySlaveNode) {
  const Walk walk(test::two_beams, {{"contact.interface.method", "nodal_penalty"},
                                    {"mesh.generate.0.cells", "quad9"},
                                    {"mesh.generate.1.cells", "quad9"}});
  const auto& zone = walk.model.zones.front();
  ASSERT_EQ(zone.points.size(), zone.slave.nodes.size());
  double area = 0;
  for (const auto& point : zone.points) {
    EXPECT_EQ(point.weight, 1);
    EXPECT_GE(point.node_position, 0);
    area += point.area;
  }
  EXPECT_NEAR(area, 1, 1e-12);
}

} // namespace
} // namespace rubato::step::nested_loops_test
