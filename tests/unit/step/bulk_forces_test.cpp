// SPDX-License-Identifier: LGPL-3.0-or-later
/// What the state carries of internal forces, M v and M a instead of computing them again, and of what
/// materials remember.
#include "rubato/deck/read.hpp"
#include "rubato/domain/domain.hpp"
#include "rubato/step/explicit/explicit_motion.hpp"
#include "rubato/step/start.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <string>

namespace rubato::step::bulk_forces_test {
namespace {

class CarriedBulkForces : public testing::TestWithParam<const char*> {};

TEST_P(CarriedBulkForces, StayThoseOfTheMotionOverManySteps) {
  const std::string scheme = GetParam();
  test::Walk walk(test::two_beams, {{"time.end", "0.2"},
                                    {"time.scheme", scheme},
                                    {"time.alpha", scheme == "generalized_alpha" ? "~" : "-0.3"}});
  ASSERT_TRUE(walk.to_end());
  ASSERT_GE(walk.reports.size(), 100U);
  const auto fresh = bulk_forces(walk.model, walk.state());
  const auto& carried = walk.state().bulk;
  EXPECT_LE((carried.internal - fresh.internal).norm(), 1e-13 * fresh.internal.norm());
  EXPECT_LE((carried.momentum - fresh.momentum).norm(), 1e-10 * fresh.momentum.norm());
  EXPECT_LE((carried.inertia - fresh.inertia).norm(), 1e-10 * fresh.inertia.norm());
}

INSTANTIATE_TEST_SUITE_P(Schemes, CarriedBulkForces,
                         testing::Values("hht", "generalized_alpha", "modified_average_acceleration"));

/// A linear domain hands on what it is given: it shows the way that states take.
const domain::QuadratureStates marked{{1.5, -2}};

/// The state a walk stands at, its materials marked.
State marked_state(const test::Walk& walk) {
  auto state = walk.state();
  state.bulk_points = marked;
  return state;
}

TEST(StatesOfMaterials, GoFromStepToStep) {
  test::Walk walk(test::two_beams);
  walk.stand_at(marked_state(walk));
  ASSERT_TRUE(walk.advance());
  ASSERT_TRUE(walk.advance());
  EXPECT_GT(walk.state().t, 0);
  EXPECT_EQ(walk.state().bulk_points, marked);
}

TEST(StatesOfMaterials, GoIntoTheRunThatGoesOn) {
  test::Walk walk(test::two_beams);
  EXPECT_EQ(walk.state().bulk_points, walk.model.domain.initial_states());
  walk.stand_at(marked_state(walk));
  ASSERT_TRUE(walk.advance());
  EXPECT_EQ(continued_state(walk.model, walk.scheme, walk.state(), 0).bulk_points, marked);
}

TEST(StatesOfMaterials, GoFromExplicitStepToStep) {
  const std::vector<deck::Setting> changes{{"contact.interface.method", "penalty"},
                                           {"time.scheme", "central_difference"},
                                           {"time.alpha", ""},
                                           {"time.step", ""}};
  const test::BuiltModel model(deck::parse_deck(test::two_beams, "deck.yaml", changes).runs.front());
  ExplicitMotion motion(model);
  auto memory = motion.memory();
  memory.bulk_points = marked;
  motion.restore(memory);
  motion.advance(2 * 0.5 * motion.spectrum().stable_step(), 2);
  EXPECT_EQ(motion.steps(), 2);
  EXPECT_EQ(motion.memory().bulk_points, marked);
  EXPECT_EQ(motion.state().bulk_points, marked);
  EXPECT_GE(motion.energy().strain, 0);
  EXPECT_EQ(motion.memory().bulk_points, marked);
}

} // namespace
} // namespace rubato::step::bulk_forces_test
