// SPDX-License-Identifier: LGPL-3.0-or-later
// What is named when a step meets a value that is not finite.
#include "rubato/contact/zone.hpp"
#include "rubato/domain/dof_map.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/model/node_label.hpp"
#include "rubato/step/finiteness.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"
#include <limits>

namespace rubato::step::finiteness_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

class NotFinite : public testing::Test {
protected:
  std::string found() const { return first_not_finite(walk_.model, 1e-3, state_, report_); }
  int dof_at(double x, double y) const { return walk_.model.dofs.dof(walk_.node_at(x, y), 1); }

  test::Walk walk_{test::two_beams};
  State state_ = walk_.state();
  StepReport report_;
};

TEST_F(NotFinite, IsNothingInASoundStep) {
  EXPECT_EQ(found(), "");
}

TEST_F(NotFinite, IsTheMotionOfANode) {
  state_.motion.a[dof_at(1, 0.1)] = infinity;
  EXPECT_EQ(found().substr(0, 27), "the acceleration of node N6");
  state_.motion.u[dof_at(0.5, 0)] = nan;
  EXPECT_NE(found().find("the displacement of node "), std::string::npos);
  EXPECT_NE(found().find("(0.5, 0)"), std::string::npos) << "what comes first is named: " << found();
}

TEST_F(NotFinite, IsTheMultiplierOfAContactPoint) {
  const auto& zone = walk_.model.zones.front();
  state_.zones.front().multipliers[3 * zone.multipliers_per_node()] = nan;
  EXPECT_EQ(found(), "the multiplier of contact '" + zone.settings.name + "' at node " +
                         model::node_label(walk_.model.mesh, zone.slave.nodes[3]));
}

TEST_F(NotFinite, IsTheLoadBeforeWhatComesOfIt) {
  test::Walk walk(test::two_beams, {{"loads.0.nodal_force.function", "burst"},
                                    {"functions.burst", "{times: [0, 1e-3], values: [0, 1e302]}"}});
  auto spoilt = walk.state();
  spoilt.motion.u[0] = nan;
  EXPECT_EQ(first_not_finite(walk.model, 1e-3, spoilt, {}),
            "the load on node " + model::node_label(walk.model.mesh, walk.node_at(1, 0.1)));
}

TEST_F(NotFinite, IsTheResidualWhereNothingElseIs) {
  report_.worst.push_back({walk_.node_at(1, 0.1), infinity});
  EXPECT_EQ(found(), "the residual at node " + model::node_label(walk_.model.mesh, walk_.node_at(1, 0.1)));
}

} // namespace
} // namespace rubato::step::finiteness_test
