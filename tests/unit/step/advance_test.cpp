// SPDX-License-Identifier: LGPL-3.0-or-later
// One step tried in several ways until one of them converges.
#include "rubato/deck/read.hpp"
#include "rubato/step/advance.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <string>
#include <vector>

namespace rubato::step::advance_test {
namespace {

using test::Walk;

/// No attempt ends within one iteration: contact needs two to see that its statuses stand.
const std::vector<deck::Setting> hopeless{{"newton.max_iterations", "1"}, {"time.on_failure", "{levels: 0}"}};

StepReport advance(const Walk& walk, State& trial, const GoesOn& goes_on = {}) {
  auto system = make_effective_system(walk.model, walk.scheme, walk.length());
  return step::advance(walk.model, walk.scheme, system, walk.state(), walk.target(), trial, goes_on);
}

TEST(Advance, TriesEveryWayThereIsAndCountsWhatAllOfThemCost) {
  const Walk walk(test::block_on_plane, hopeless);
  State trial;
  const auto report = advance(walk, trial);
  EXPECT_TRUE(report.failed());
  EXPECT_EQ(report.outcome, Outcome::too_many_iterations);
  EXPECT_TRUE(report.friction_continuation) << "the last way there is";
  // The plain attempt, the other start or two other augmentations, the loop over geometry, the first part of
  // friction: an iteration each.
  EXPECT_EQ(report.iterations, 5);
}

TEST(Advance, HasNoFrictionToRaiseWhereThereIsNone) {
  auto changes = hopeless;
  changes.push_back({"contact.foot.friction", "0"});
  const Walk walk(test::block_on_plane, changes);
  State trial;
  const auto report = advance(walk, trial);
  EXPECT_TRUE(report.failed());
  EXPECT_FALSE(report.friction_continuation);
  EXPECT_TRUE(report.geometry_by_loop);
  EXPECT_EQ(report.iterations, 4);
}

TEST(Advance, HasOneWayWithoutContact) {
  auto changes = hopeless;
  changes.push_back({"contact", ""});
  changes.push_back({"supports", "[{on: ground, fix: [x, y]}, {on: under, fix: [x, y]}]"});
  const Walk walk(test::block_on_plane, changes);
  State trial;
  const auto report = advance(walk, trial);
  EXPECT_TRUE(report.converged());
  EXPECT_EQ(report.iterations, 1);
}

TEST(Advance, EndsAtOnceWhenItIsAskedTo) {
  const Walk walk(test::block_on_plane);
  for (const int reports : {0, 1, 2}) {
    State trial;
    int asked = 0;
    const auto report = advance(walk, trial, [&](const ProgressState&) { return asked++ < reports; });
    EXPECT_EQ(report.outcome, Outcome::interrupted);
    EXPECT_FALSE(report.failed()) << "nothing else is to be tried";
    EXPECT_EQ(asked, reports + 1) << "it asks no more";
  }
}

/// Each attempt begins where the step does, whatever the ones before it left in `trial`.
TEST(Advance, GivesTheSameWhateverTheTrialHeld) {
  const Walk walk(test::block_on_plane);
  State fresh;
  ASSERT_TRUE(advance(walk, fresh).converged());
  State used = fresh;
  used.motion.u *= -3;
  used.zones.front().status.assign(used.zones.front().status.size(), contact::Status::open);
  ASSERT_TRUE(advance(walk, used).converged());
  EXPECT_EQ(used.motion.u, fresh.motion.u);
  EXPECT_EQ(used.zones, fresh.zones);
}

} // namespace
} // namespace rubato::step::advance_test
