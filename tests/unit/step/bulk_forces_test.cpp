// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the state carries of K u, M v and M a instead of computing them again.
#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <string>

namespace rubato::step {
namespace {

class CarriedBulkForces : public testing::TestWithParam<const char*> {};

TEST_P(CarriedBulkForces, StayThoseOfTheMotionOverManySteps) {
  const std::string scheme = GetParam();
  test::Walk walk(test::two_beams, {{"time.end", "0.2"},
                                    {"time.scheme", scheme},
                                    {"time.alpha", scheme == "generalized_alpha" ? "~" : "-0.3"}});
  ASSERT_TRUE(walk.to_end());
  ASSERT_GE(walk.reports.size(), 100U);
  const auto fresh = bulk_forces(walk.model, walk.state().motion);
  const auto& carried = walk.state().bulk;
  EXPECT_LE((carried.internal - fresh.internal).norm(), 1e-13 * fresh.internal.norm());
  EXPECT_LE((carried.momentum - fresh.momentum).norm(), 1e-10 * fresh.momentum.norm());
  EXPECT_LE((carried.inertia - fresh.inertia).norm(), 1e-10 * fresh.inertia.norm());
}

INSTANTIATE_TEST_SUITE_P(Schemes, CarriedBulkForces,
                         testing::Values("hht", "generalized_alpha", "modified_average_acceleration"));

} // namespace
} // namespace rubato::step
