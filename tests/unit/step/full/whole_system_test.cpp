// SPDX-License-Identifier: LGPL-3.0-or-later
// One iteration after another on all unknowns. How they converge: common/newton_test.cpp.
#include "rubato/contact/zone.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/step/advance.hpp"
#include "rubato/step/common/newton.hpp"
#include "rubato/step/full/whole_system.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include "unit/step/any_state.hpp"
#include <algorithm>
#include <limits>

namespace rubato::step::whole_system_test {
namespace {

using contact::Status;
using test::Walk;
using Changes = std::vector<deck::Setting>;

/// At the first step of a deck.
struct Attempt {
  explicit Attempt(const std::string& deck, const Changes& changes = {}) : walk(deck, changes) {}

  void evaluate(int iteration) { whole.evaluate(trial, frozen, iteration); }
  std::optional<Outcome> correct(double part = 1) { return whole.correct(trial, frozen, part); }
  /// The statuses of all points.
  void let_all_be(Status status) { std::ranges::fill(trial.zones.front().status, status); }

  Walk walk;
  EffectiveSystem system = make_effective_system(walk.model, walk.scheme, walk.length());
  double t = walk.target();
  State trial = predict(walk.model, walk.scheme, system, walk.state(), t);
  ContactEvaluator side{walk.model, walk.scheme, system, walk.state(), {.start = Start::last_step}};
  Progress progress;
  WholeSystem whole{walk.model, walk.scheme, system, walk.state(), t, side, progress};
  Frozen frozen = Frozen(walk.model.zones.size());
};

/// The block's top goes down, too.
Changes pressed_down() {
  return {{"supports.1.y", "{value: -1e-6}"}};
}

TEST(AWholeSystemWithoutContact, IsSolvedByOneCorrection) {
  Attempt attempt(test::pulled_block, {{"time.scheme", "static"}});
  EXPECT_FALSE(attempt.whole.start(attempt.trial, attempt.frozen));
  attempt.evaluate(0);
  EXPECT_EQ(attempt.whole.points_in_contact(), 0);
  EXPECT_EQ(attempt.whole.force_norm(), 0);
  EXPECT_GT(attempt.whole.report().residual, 1e-3);
  EXPECT_FALSE(attempt.correct());
  attempt.evaluate(1);
  EXPECT_LT(attempt.whole.report().residual, 1e-12);
  EXPECT_TRUE(attempt.whole.is_settled(attempt.trial, attempt.frozen));
  EXPECT_EQ(attempt.whole.close(attempt.trial, attempt.frozen), Outcome::converged);
  EXPECT_GT(attempt.trial.reaction.norm(), 0.01);
}

/// Which is done once for all steps.
TEST(AWholeSystemWithoutContact, IsSolvedByTheFactoredMatrix) {
  Attempt attempt(test::pulled_block, {{"time.scheme", "static"}});
  ASSERT_TRUE(attempt.walk.model.zones.empty());
  attempt.system.matrix.setZero();
  EXPECT_FALSE(attempt.whole.start(attempt.trial, attempt.frozen));
  attempt.evaluate(0);
  EXPECT_FALSE(attempt.correct());
  attempt.evaluate(1);
  EXPECT_LT(attempt.whole.report().residual, 1e-12);
}

TEST(AWholeSystem, MovesByThePartOfTheCorrectionThatItIsTold) {
  Attempt all(test::block_on_plane), half(test::block_on_plane);
  const State before = all.trial;
  for (auto* attempt : {&all, &half}) {
    attempt->whole.start(attempt->trial, attempt->frozen);
    attempt->evaluate(0);
    EXPECT_FALSE(attempt->correct(attempt == &all ? 1 : 0.5));
  }
  const Eigen::VectorXd moved = all.trial.motion.u - before.motion.u;
  const Eigen::VectorXd pressed = all.trial.zones[0].multipliers - before.zones[0].multipliers;
  ASSERT_GT(moved.norm(), 0);
  ASSERT_GT(pressed.norm(), 0);
  EXPECT_LE((half.trial.motion.u - before.motion.u - 0.5 * moved).norm(), 1e-14 * moved.norm());
  EXPECT_LE((half.trial.zones[0].multipliers - before.zones[0].multipliers - 0.5 * pressed).norm(),
            1e-14 * pressed.norm());
}

/// The block bears 1000 N; what it gets the plane gives.
TEST(AWholeSystem, HasContactForcesInBalance) {
  Attempt attempt(test::block_on_plane);
  ASSERT_TRUE(run_newton(attempt.whole, 20, attempt.progress, attempt.trial, attempt.frozen).converged());
  EXPECT_GT(attempt.whole.points_in_contact(), 0);
  const auto& force = attempt.trial.contact_force;
  EXPECT_EQ(attempt.whole.force_norm(), force.norm());
  Eigen::Vector2d on_block = Eigen::Vector2d::Zero(), on_plane = Eigen::Vector2d::Zero();
  const auto& zone = attempt.walk.model.zones.front();
  for (const auto node : attempt.walk.model.dofs.nodes) {
    const Eigen::Vector2d of_node = force.segment<2>(attempt.walk.model.dofs.dof(node, 0));
    if (zone.slave.position_of(node) >= 0)
      on_block += of_node;
    else if (zone.master.position_of(node) >= 0)
      on_plane += of_node;
    else
      EXPECT_EQ(of_node.norm(), 0);
  }
  EXPECT_NEAR(on_block.y(), -1000, 1e-6) << "internal side";
  EXPECT_GT(std::abs(on_block.x()), 1) << "friction";
  EXPECT_LE((on_block + on_plane).norm(), 1e-9);
}

TEST(AWholeSystem, CountsThePointsThatAreNotOpen) {
  Attempt attempt(test::block_on_plane);
  attempt.whole.start(attempt.trial, attempt.frozen);
  attempt.let_all_be(Status::open);
  attempt.trial.zones[0].status[1] = Status::stick;
  attempt.trial.zones[0].status[3] = Status::slip;
  attempt.evaluate(0);
  EXPECT_EQ(attempt.whole.points_in_contact(), 2);
  attempt.let_all_be(Status::open);
  attempt.evaluate(0);
  EXPECT_EQ(attempt.whole.points_in_contact(), 0);
  EXPECT_EQ(attempt.whole.force_norm(), 0);
}

TEST(AWholeSystem, IsNotSettledWhereAStatusHasChanged) {
  Attempt attempt(test::block_on_plane, pressed_down());
  attempt.whole.start(attempt.trial, attempt.frozen);
  attempt.let_all_be(Status::open);
  attempt.evaluate(0);
  EXPECT_FALSE(attempt.correct());
  attempt.evaluate(1);
  EXPECT_GT(attempt.whole.points_in_contact(), 0) << "the block has sunk into the plane";
  EXPECT_FALSE(attempt.whole.is_settled(attempt.trial, attempt.frozen));
  EXPECT_EQ(attempt.whole.report().status_changes, attempt.whole.points_in_contact());
}

/// Two zones between the same surfaces: how much of the pressure each bears is anybody's choice.
TEST(AWholeSystem, HasNoSolutionWhereTwoZonesHoldTheSame) {
  Attempt attempt(test::block_on_plane, {{"contact.again", "{master: over, slave: under}"}});
  attempt.whole.start(attempt.trial, attempt.frozen);
  attempt.evaluate(0);
  ASSERT_EQ(attempt.whole.points_in_contact(), 10) << "five nodes, twice";
  const State before = attempt.trial;
  EXPECT_EQ(attempt.correct(), Outcome::singular_matrix);
  EXPECT_EQ(attempt.trial.motion.u, before.motion.u);
}

TEST(AWholeSystem, SaysWhenAnIterateIsNotFinite) {
  Attempt attempt(test::block_on_plane);
  attempt.whole.start(attempt.trial, attempt.frozen);
  attempt.evaluate(0);
  EXPECT_TRUE(attempt.whole.is_finite());
  const auto inside = attempt.walk.node_at(0.5, 0.5);
  ASSERT_GE(inside, 0);
  attempt.trial.motion.u[attempt.walk.model.dofs.dof(inside, 0)] = std::numeric_limits<double>::quiet_NaN();
  attempt.evaluate(0);
  EXPECT_FALSE(attempt.whole.is_finite());
  const auto report = attempt.whole.ended(Outcome::not_finite, attempt.frozen);
  EXPECT_EQ(report.outcome, Outcome::not_finite);
  ASSERT_FALSE(report.worst.empty());
  EXPECT_FALSE(report.converged());
}

TEST(AWholeSystem, TellsWhatIsNotMetWhereItEndsTooSoon) {
  Attempt attempt(test::block_on_plane, pressed_down());
  attempt.let_all_be(Status::open);
  const auto report = run_newton(attempt.whole, 1, attempt.progress, attempt.trial, attempt.frozen);
  EXPECT_EQ(report.outcome, Outcome::too_many_iterations);
  EXPECT_EQ(report.iterations, 1);
  EXPECT_FALSE(report.worst.empty());
  EXPECT_TRUE(std::ranges::any_of(report.unmet,
                                  [](const auto& unmet) { return unmet.criterion == Criterion::status; }));
}

} // namespace
} // namespace rubato::step::whole_system_test
