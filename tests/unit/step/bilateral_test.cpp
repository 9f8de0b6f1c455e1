// SPDX-License-Identifier: LGPL-3.0-or-later
// Bilateral contact: surfaces that have touched slide on each other, and do not part any more.
#include "rubato/deck/read.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/simulated_blocks.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <string>
#include <vector>

namespace rubato::step::bilateral_test {
namespace {

/// A block on another one, pressed down, then pulled up and aside by its roof. A gap of 0.01 is between them.
const std::string stack = R"(
mesh:
  generate:
    - {name: lower, rectangle: {from: [0, 0], to: [3, 1]}, divisions: [6, 2], sides: {bottom: ground, top: under}}
    - {name: upper, rectangle: {from: [1, 1.01], to: [2, 2.01]}, divisions: [3, 3], sides: {top: roof, bottom: over}}
physics: plane_strain
materials: {steel: {young: 100, poisson: 0.2, density: 1}}
functions:
  down_then_up: {times: [0, 1, 2], values: [0, -0.03, 0.03]}
  aside: {times: [1, 2], values: [0, 0.1]}
supports: [{on: ground, fix: [x, y]}, {on: roof, x: {value: 1, function: aside}, y: {value: 1, function: down_then_up}}]
contact: {seam: {master: under, slave: over}}
time: {scheme: static, step: 0.25, end: 2}
)";

class OnEveryKindOfPoint : public testing::TestWithParam<const char*> {
protected:
  std::vector<deck::Setting> zone(const std::string& more) const {
    return {{"contact.seam", std::string("{master: under, slave: over, ") + GetParam() + more + "}"}};
  }
};

TEST_P(OnEveryKindOfPoint, BilateralContactPullsAndSlidesFreely) {
  test::Walk walk(stack, zone(", bilateral: true"));
  ASSERT_TRUE(walk.advance());
  EXPECT_EQ(walk.resultants().in_contact, 0) << "the gap is not closed yet";
  while (walk.state().t < 1)
    ASSERT_TRUE(walk.advance());
  EXPECT_EQ(walk.resultants().in_contact, 4);
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.resultants().in_contact, 4);
  double pull = 0;
  for (const auto& outcome : walk.state().zones.front().outcomes) {
    EXPECT_LT(outcome.pressure, 0);
    EXPECT_NEAR(outcome.gap, 0, std::string(GetParam()).find("penalty") == std::string::npos ? 1e-9 : 2e-3);
    EXPECT_TRUE(outcome.tangential.isZero(1e-12));
    pull += outcome.normal[1];
  }
  EXPECT_LT(pull, -0.5);
  EXPECT_GT(std::abs(walk.state().zones.front().outcomes.front().slip[0]), 0.02);
}

TEST_P(OnEveryKindOfPoint, ContactThatIsNotBilateralOpens) {
  test::Walk walk(stack, zone(""));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.resultants().in_contact, 0);
}

/// What a run remembers of who has touched is in its state.
TEST_P(OnEveryKindOfPoint, BilateralRunsGoOnToTheSameBits) {
  test::Walk whole(stack, zone(", bilateral: true"));
  while (whole.state().t < 1.5)
    ASSERT_TRUE(whole.advance());
  const auto memento = whole.simulation.memento();
  ASSERT_TRUE(whole.to_end());
  test::Walk resumed(stack, zone(", bilateral: true"));
  resumed.simulation.restore(memento);
  ASSERT_TRUE(resumed.to_end());
  test::expect_same(resumed.simulation, whole.simulation);
}

INSTANTIATE_TEST_SUITE_P(Points, OnEveryKindOfPoint,
                         testing::Values("integration: nodes", "integration: mortar",
                                         "method: nodal_lagrange",
                                         "method: penalty, friction_method: penalty"),
                         [](const auto& kind) { return "Kind" + std::to_string(kind.index); });

TEST(BilateralContact, HoldsFromTheStartWhatTheDeckSaysIsInContact) {
  for (const char* active : {"true", "false"}) {
    test::Walk walk(stack, {{"functions.down_then_up", "{times: [0, 2], values: [0, 0.01]}"},
                            {"mesh.generate.1.rectangle", "{from: [1, 1], to: [2, 2]}"},
                            {"contact.seam.bilateral", "true"},
                            {"contact.seam.initially_active", active}});
    ASSERT_TRUE(walk.to_end());
    EXPECT_EQ(walk.resultants().in_contact, std::string(active) == "true" ? 4 : 0) << active;
  }
}

/// A body thrown at a wall stays there, and nothing is gained.
TEST(BilateralContact, CatchesABodyInMotion) {
  for (const char* scheme : {"{scheme: moreau_jean, step: 0.02, end: 3}",
                             "{scheme: moreau_jean, contact_mass: consistent, step: 0.02, end: 3}",
                             "{scheme: generalized_alpha, step: 0.02, end: 3}"})
    for (const char* integration : {"nodes", "mortar"}) {
      test::Walk walk(stack,
                      {{"time", scheme},
                       {"supports", "[{on: ground, fix: [x, y]}, {on: over, fix: x}]"},
                       {"initial", "[{on: over, velocity: {y: -0.1}}, {on: roof, velocity: {y: -0.1}}]"},
                       {"contact.seam.bilateral", "true"},
                       {"contact.seam.integration", integration}});
      EnergyAccount account(walk.model, walk.scheme, walk.state());
      walk.accepted = [&] { account.enter(walk.before, walk.state()); };
      ASSERT_TRUE(walk.to_end()) << scheme << integration;
      EXPECT_EQ(walk.resultants().in_contact, 4) << scheme << integration;
      for (const auto& outcome : walk.state().zones.front().outcomes)
        EXPECT_NEAR(outcome.gap, 0, 2e-3) << scheme << integration;
      EXPECT_NEAR(account.ledger().balance(), 0, 1e-10 * account.ledger().largest()) << scheme;
    }
}

} // namespace
} // namespace rubato::step::bilateral_test
