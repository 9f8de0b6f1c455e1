// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/zone.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/step/common/pressed_afar.hpp"

#include <gtest/gtest.h>

#include "support/two_blocks.hpp"
#include "support/walk.hpp"
#include <numbers>
#include <optional>

namespace rubato::step::pressed_afar_test {
namespace {

/// Two blocks by mortar before the first step, one slave node of which presses.
class APressingNode : public testing::Test {
protected:
  APressingNode()
      : walk_(test::two_blocks, {{"contact.interface.integration", "mortar"}}), state_(walk_.state()) {
    state_.zones[0].outcomes.resize(walk_.slave_count());
    state_.zones[0].outcomes[1].pressure = 1;
  }

  std::optional<Unmet> found_at(double away) {
    const auto node = walk_.model.zones[0].slave.nodes[1];
    state_.motion.u[walk_.model.dofs.dof(node, 1)] = -away;
    return pressed_afar(walk_.model, state_);
  }
  double faces() const {
    const auto& zone = walk_.model.zones[0];
    return zone.mortar->longest_face + std::numbers::sqrt2 * zone.master.longest_edge;
  }

  test::Walk walk_;
  State state_;
};

TEST_F(APressingNode, IsFoundMoreThanTheFacesOfBothSidesAway) {
  EXPECT_FALSE(found_at(0));
  EXPECT_FALSE(found_at(0.5 * faces()));
  const auto found = found_at(1.5 * faces());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->criterion, Criterion::distance);
  EXPECT_EQ(found->zone, 0);
  EXPECT_EQ(found->node, walk_.model.zones[0].slave.nodes[1]);
  EXPECT_GE(found->value, 1.5 * faces());
  EXPECT_NEAR(found->allowed, faces(), 1e-15);
}

TEST_F(APressingNode, MayBeAsFarAsItsGap) {
  state_.zones[0].outcomes[1].gap = -faces();
  EXPECT_FALSE(found_at(1.5 * faces()));
}

TEST_F(APressingNode, IsOfNoConcernWhereItDoesNotPress) {
  state_.zones[0].outcomes[1].pressure = 0;
  EXPECT_FALSE(found_at(1.5 * faces()));
}

} // namespace
} // namespace rubato::step::pressed_afar_test
