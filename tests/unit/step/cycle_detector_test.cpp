// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/interface/condensed.hpp"
#include "rubato/step/common/cycle_detector.hpp"
#include "rubato/step/common/nested_loops.hpp"
#include "rubato/step/full/whole_system.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <optional>

namespace rubato::step {
namespace {

using contact::Status;

ContactIterate with(Status first, Status second) {
  ContactIterate iterate;
  iterate.status = {{first}, {second}};
  return iterate;
}

TEST(CycleDetector, KnowsStatusesThatComeBackWithTheirForces) {
  CycleDetector watch;
  EXPECT_FALSE(watch.has_met(with(Status::stick, Status::open), 1));
  EXPECT_FALSE(watch.has_met(with(Status::slip, Status::open), 2));
  EXPECT_TRUE(watch.has_met(with(Status::stick, Status::open), 1 + 1e-12));
}

TEST(CycleDetector, LetsStatusesComeBackWithOtherForces) {
  CycleDetector watch;
  EXPECT_FALSE(watch.has_met(with(Status::stick, Status::open), 1));
  EXPECT_FALSE(watch.has_met(with(Status::stick, Status::open), 1.001));
  EXPECT_FALSE(watch.has_met(with(Status::open, Status::stick), 1));
}

TEST(CycleDetector, TakesHalfOfACorrectionWhereIteratesComeBackUntilTheyDoTooOften) {
  CycleDetector watch;
  const auto part = [&](Status status) { return watch.part_of_next(with(status, Status::open), 1); };
  for (int cycle = 0; cycle < 3; ++cycle) {
    EXPECT_EQ(part(Status::stick), 1.0);
    EXPECT_EQ(part(Status::slip), 1.0);
    EXPECT_EQ(part(Status::stick), 0.5);
  }
  EXPECT_EQ(part(Status::stick), 1.0);
  EXPECT_EQ(part(Status::stick), std::nullopt);
}

/// Stiff penalties, much friction and a stiff augmentation of it: a neighbourhood of these numbers cycles.
test::Walk cycling_walk() {
  return test::Walk(test::two_beams, {{"contact.interface.method", "penalty"},
                                      {"contact.interface.friction_method", "augmented_lagrangian"},
                                      {"contact.interface.friction", "1.5"},
                                      {"contact.interface.coefficients", "{normal: 1e11, tangential: 1e11}"},
                                      {"time.start", "at_rest_unloaded"},
                                      {"time.on_failure", "{cut: 2, levels: 1}"}});
}

TEST(Cycles, EndAnAttemptAndNameTheirPoints) {
  auto walk = cycling_walk();
  EXPECT_FALSE(walk.to_end());
  const auto cycling = std::ranges::find(walk.reports, Outcome::cycling, &StepReport::outcome);
  ASSERT_NE(cycling, walk.reports.end());
  EXPECT_GT(cycling->status_changes, 0);
  EXPECT_EQ(cycling->changing_points.size(), static_cast<std::size_t>(cycling->status_changes));
  for (const auto& point : cycling->changing_points)
    EXPECT_NE(point.before, point.now);
}

/// A step of that length from where the last one ended.
template <class Solver> StepReport attempt(test::Walk& walk, double length) {
  const double t = walk.state().t + length;
  auto system = make_effective_system(walk.model, walk.scheme, length);
  const ContactEvaluator side(walk.model, walk.scheme, system, walk.state(), {.start = Start::last_step});
  Pulse pulse;
  Solver solver(walk.model, walk.scheme, system, walk.state(), t, side, pulse);
  auto trial = predict(walk.model, walk.scheme, system, walk.state(), t);
  return solve_levels(
      walk.model, side, [&](State& to, const Frozen& frozen) { return solver.run(to, held); }, walk.state(),
      trial);
}

/// The length of a step that goes round from where the walk is.
std::optional<double> cycling_length(test::Walk& walk) {
  for (const double length : {1e-3, 5e-4, 2e-3})
    if (attempt<Condensed>(walk, length).outcome == Outcome::cycling)
      return length;
  return std::nullopt;
}

/// Halves of corrections too.
TEST(Cycles, AreTheSameOfPointsAndOfTheWholeMotion) {
  auto walk = cycling_walk();
  auto length = cycling_length(walk);
  while (!length && walk.advance())
    length = cycling_length(walk);
  ASSERT_TRUE(length);
  const auto condensed = attempt<Condensed>(walk, *length);
  const auto whole = attempt<Newton>(walk, *length);
  EXPECT_EQ(condensed.outcome, Outcome::cycling);
  EXPECT_EQ(whole.outcome, Outcome::cycling);
  EXPECT_EQ(condensed.iterations, whole.iterations);
  ASSERT_EQ(condensed.changing_points.size(), whole.changing_points.size());
  for (std::size_t i = 0; i < whole.changing_points.size(); ++i)
    EXPECT_EQ(condensed.changing_points[i].node, whole.changing_points[i].node);
}

} // namespace
} // namespace rubato::step
