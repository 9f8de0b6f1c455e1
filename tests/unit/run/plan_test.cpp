// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/deck/read.hpp"
#include "rubato/run/plan.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <gtest/gtest.h>

#include "support/two_blocks.hpp"
#include <algorithm>

namespace rubato::run::plan_test {
namespace {

using test::two_blocks;

study::Study study_of(const std::string& text) {
  return deck::parse_deck(text, "deck.yaml").runs.back();
}

TEST(Plan, HasTheSizeOfTheModelAndTheMemoryOfItsFactor) {
  const auto plan = plan_of(study_of(two_blocks));
  EXPECT_EQ(plan.nodes, 30U);
  EXPECT_EQ(plan.unknowns, 48U); // the left is held
  EXPECT_EQ(plan.contact_points, 5U);
  EXPECT_EQ(plan.steps, 4U);
  ASSERT_TRUE(plan.factor_bytes);

  std::size_t told = 0;
  const simulation::Simulation simulation(
      study_of(two_blocks), {.previous = nullptr, .memento = nullptr, .tell_memory = [&](std::size_t bytes) {
                               told = std::max(told, bytes);
                             }});
  EXPECT_EQ(*plan.factor_bytes, told);
}

TEST(Plan, DoesNotKnowTheMemoryOfARunThatStartsFromAnother) {
  EXPECT_FALSE(plan_of(study_of(test::preloaded_blocks("2e-4"))).factor_bytes);
}

TEST(Plan, TellsTheStepsOfAnExplicitRun) {
  const auto plan =
      plan_of(study_of(test::with(test::with(two_blocks, "{scheme: hht, alpha: -0.1, step: 1e-4, end: 4e-4}",
                                             "{scheme: central_difference, end: 4e-4}"),
                                  "friction: 0.2,", "friction: 0.2, method: penalty,")));
  EXPECT_EQ(plan.steps, 0U);
  EXPECT_TRUE(plan.method.starts_with("stable step ")) << plan.method;
  EXPECT_FALSE(plan.factor_bytes);
}

TEST(Plan, RefusesWhatTheModelRefuses) {
  EXPECT_THROW(plan_of(study_of(test::with(two_blocks, "nodal_force: {on: tip", "nodal_force: {on: tap"))),
               InputError);
}

} // namespace
} // namespace rubato::run::plan_test
