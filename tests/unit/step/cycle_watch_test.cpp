// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/cycle_watch.hpp"

#include <gtest/gtest.h>

#include "unit/step/decks.hpp"
#include "unit/step/walk.hpp"
#include <algorithm>

namespace rubato::step {
namespace {

using contact::Status;

ContactIterate with(Status first, Status second) {
  ContactIterate iterate;
  iterate.status = {{first}, {second}};
  return iterate;
}

TEST(CycleWatch, KnowsStatusesThatComeBackWithTheirForces) {
  CycleWatch watch;
  EXPECT_FALSE(watch.has_met(with(Status::stick, Status::open), 1));
  EXPECT_FALSE(watch.has_met(with(Status::slip, Status::open), 2));
  EXPECT_TRUE(watch.has_met(with(Status::stick, Status::open), 1 + 1e-12));
}

TEST(CycleWatch, LetsStatusesComeBackWithOtherForces) {
  CycleWatch watch;
  EXPECT_FALSE(watch.has_met(with(Status::stick, Status::open), 1));
  EXPECT_FALSE(watch.has_met(with(Status::stick, Status::open), 1.001));
  EXPECT_FALSE(watch.has_met(with(Status::open, Status::stick), 1));
}

TEST(Cycles, EndAnAttemptAndNameTheirPoints) {
  // Stiff penalties and much friction: a neighbourhood of these numbers cycles.
  test::Walk walk(test::two_beams, {{"contact.interface.method", "penalty"},
                                    {"contact.interface.friction", "1.5"},
                                    {"contact.interface.coefficients", "{normal: 1e13, tangential: 1e12}"},
                                    {"time.start", "at_rest_unloaded"},
                                    {"time.on_failure", "{cut: 2, levels: 1}"}});
  EXPECT_FALSE(walk.to_end());
  const auto cycling = std::ranges::find(walk.reports, Outcome::cycling, &StepReport::outcome);
  ASSERT_NE(cycling, walk.reports.end());
  EXPECT_GT(cycling->status_changes, 0);
  EXPECT_EQ(cycling->restless.size(), static_cast<std::size_t>(cycling->status_changes));
  for (const auto& point : cycling->restless)
    EXPECT_NE(point.before, point.now);
}

} // namespace
} // namespace rubato::step
