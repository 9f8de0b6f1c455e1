// SPDX-License-Identifier: LGPL-3.0-or-later
// Cumulated slip and work of friction at the contact points, beside the energy ledger.
#include "rubato/contact/friction_history.hpp"
#include "rubato/deck/read.hpp"
#include "rubato/simulation/time_integration.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include <algorithm>
#include <string>
#include <vector>

namespace rubato::simulation::friction_history_test {
namespace {

struct Kind {
  const char* name;
  const std::string& deck;
  std::vector<deck::Setting> settings;
};

std::string name_of(const testing::TestParamInfo<Kind>& info) {
  return info.param.name;
}

std::vector<Kind> implicit_ways() {
  return {
      Kind{"Hht", test::two_beams, {}},
      Kind{"HhtByMortar", test::two_beams, {{"contact.interface.integration", "mortar"}}},
      Kind{"MoreauJean", test::two_beams, {{"time.scheme", "moreau_jean"}, {"time.alpha", "~"}}},
      Kind{
          "MoreauJeanByMortar",
          test::two_beams,
          {{"time.scheme", "moreau_jean"}, {"time.alpha", "~"}, {"contact.interface.integration", "mortar"}}},
      Kind{"Penalty", test::two_beams, {{"contact.interface.method", "penalty"}}},
      Kind{"GaussPoints", test::two_beams, {{"contact.interface.integration", "{gauss: 2}"}}},
      Kind{"FixedPoint",
           test::two_beams,
           {{"contact.interface.iterate", "{geometry: fixed_point, friction: fixed_point}"}}},
      Kind{"NodalLagrange", test::two_beams, {{"contact.interface.method", "nodal_lagrange"}}},
      Kind{"Static", test::block_on_plane, {{"supports.1.x.value", "1e-4"}}},
      Kind{"Obstacle", test::block_on_obstacle, {}},
      Kind{"MovingObstacle",
           test::block_on_obstacle,
           {{"supports.0.x", "0"}, {"contact.foot.obstacle.move", "{x: {value: 0.03, function: ramp}}"}}}};
}

study::Study study_of(const Kind& kind) {
  return deck::parse_deck(kind.deck, "deck.yaml", kind.settings).runs.front();
}

class FrictionHistories : public testing::TestWithParam<Kind> {};

double works_of_points(const step::State& state) {
  double sum = 0;
  for (const auto& zone : state.zones)
    for (const auto& point : zone.friction_history)
      sum += point.work;
  return sum;
}

TEST_P(FrictionHistories, WorksOfThePointsAddUpToTheLedgers) {
  Simulation bodies(study_of(GetParam()));
  while (!bodies.finished()) {
    ASSERT_TRUE(bodies.advance().accepted());
    EXPECT_NEAR(works_of_points(bodies.state()), bodies.energy().friction, 1e-12 * bodies.energy().largest());
  }
  EXPECT_GT(bodies.energy().friction, 1e-6 * bodies.energy().largest()) << "no friction";
}

/// Of implicit steps: those between the records of explicit ones are not seen from here.
class FrictionHistoryStepByStep : public FrictionHistories {};

TEST_P(FrictionHistoryStepByStep, SlipGrowsByThatOfEveryStepThatEndsClosed) {
  Simulation bodies(study_of(GetParam()));
  std::vector<double> sums(bodies.state().zones.front().outcomes.size(), 0.0);
  while (!bodies.finished()) {
    ASSERT_TRUE(bodies.advance().accepted());
    const auto& zone = bodies.state().zones.front();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (zone.status[i] != contact::Status::open)
        sums[i] += zone.outcomes[i].slip.norm();
      EXPECT_EQ(zone.friction_history[i].slip, sums[i]);
    }
  }
  EXPECT_GT(*std::ranges::max_element(sums), 0);
}

INSTANTIATE_TEST_SUITE_P(Ways, FrictionHistories, testing::ValuesIn(implicit_ways()), name_of);
INSTANTIATE_TEST_SUITE_P(Explicit, FrictionHistories,
                         testing::Values(Kind{"Explicit",
                                              test::two_beams,
                                              {{"time.scheme", "central_difference"},
                                               {"time.alpha", "~"},
                                               {"time.step", "auto"},
                                               {"time.record", "1e-3"},
                                               {"contact.interface.method", "penalty"}}}),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Ways, FrictionHistoryStepByStep, testing::ValuesIn(implicit_ways()), name_of);

/// The foot of a stiff block follows its top once it slides; in the first of four steps friction grows from
/// 0.
TEST(FrictionHistory, OfADraggedBlockIsItsTravelAndFrictionTimesIt) {
  constexpr double travel = 1e-2;
  constexpr double friction = 0.3 * 1000;
  Simulation block(study_of({"", test::block_on_plane, {{"supports.1.x.value", "1e-2"}}}));
  while (!block.finished())
    ASSERT_TRUE(block.advance().accepted());
  const auto& foot = block.state().zones.front();
  for (std::size_t i = 0; i < foot.friction_history.size(); ++i)
    if (foot.status[i] != contact::Status::open) {
      EXPECT_NEAR(foot.friction_history[i].slip, travel, 1e-2 * travel);
    }
  EXPECT_NEAR(works_of_points(block.state()), friction * (travel - 0.5 * travel / 4),
              1e-3 * friction * travel);
}

TEST(FrictionHistory, BeginsAnewInARunThatStartsFromAnother) {
  const auto pressed = study_of({"", test::block_on_plane, {{"supports.1.x.value", "1e-4"}}});
  Simulation first(pressed);
  while (!first.finished())
    ASSERT_TRUE(first.advance().accepted());
  ASSERT_GT(works_of_points(first.state()), 0);
  auto further = pressed;
  further.time.start = study::StartKind::from_run;
  further.time.start_run = "first";
  further.time.begin = 1;
  further.time.end = 2;
  const Simulation second(further, {.previous = &first.state()});
  EXPECT_EQ(works_of_points(second.state()), 0);
}

} // namespace
} // namespace rubato::simulation::friction_history_test
