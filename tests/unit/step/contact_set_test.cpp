// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which points are in contact: those that must be, and no others.
#include "rubato/contact/zone.hpp"

#include <gtest/gtest.h>

#include "support/decks.hpp"
#include "support/walk.hpp"

namespace rubato::step::contact_set_test {
namespace {

using contact::Status;
using test::Walk;

/// Two blocks of side 1, the upper one `gap` above the lower and pressed down by `push` at its top. Both are
/// squeezed from the side, so that there are forces to measure residuals by even where nothing touches.
std::string blocks_apart(double gap, double push, const std::string& more = "") {
  return R"(
mesh:
  generate:
    - {name: low, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [2, 2], sides: {bottom: ground, left: left, right: right, top: low_top}}
    - {name: high, rectangle: {from: [0, )" +
         std::to_string(1 + gap) + "], to: [1, " + std::to_string(2 + gap) + R"(]}, divisions: [2, 2],
       sides: {bottom: high_bottom, left: left, right: right, top: roof}}
physics: plane_stress
materials: {rubber: {young: 2e6, poisson: 0, density: 1000}}
supports:
  - {on: ground, fix: y}
  - {on: left, fix: x}
  - {on: right, x: -0.001}
  - {on: roof, y: )" +
         std::to_string(-push) + R"(}
contact: {between: {master: low_top, slave: high_bottom, integration: nodes)" +
         more + R"(}}
time: {scheme: static, step: 1, end: 1}
)";
}

TEST(AGap, ClosesWhenTheBodyIsPushedThroughItAndNotBefore) {
  for (const char* first_guess : {"true", "false"}) {
    const auto guess = std::string(", initially_active: ") + first_guess;
    Walk short_of_it(blocks_apart(0.02, 0.01, guess));
    ASSERT_TRUE(short_of_it.to_end());
    EXPECT_EQ(short_of_it.resultants().in_contact, 0);
    EXPECT_NEAR(short_of_it.displacement(short_of_it.node_at(0, 1.02), 1), -0.01, 1e-12);

    Walk beyond(blocks_apart(0.02, 0.04, guess));
    ASSERT_TRUE(beyond.to_end());
    EXPECT_EQ(beyond.resultants().in_contact, 3);
    EXPECT_NEAR(beyond.pressure(0), 2e6 * 0.02 / 2, 1e-6);
    EXPECT_NEAR(beyond.displacement(beyond.node_at(0, 1), 1), -0.01, 1e-12);
  }
}

TEST(AGap, OpensWhenTheBodyIsPulled) {
  Walk walk(blocks_apart(0, -0.01));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.resultants().in_contact, 0);
  EXPECT_NEAR(walk.displacement(walk.node_at(0, 1), 1) + walk.displacement(walk.node_at(0, 2), 1), 0.01,
              1e-12);
}

TEST(ExcludedNodes, NeverTouch) {
  Walk walk(test::two_beams);
  while (!walk.finished()) {
    ASSERT_TRUE(walk.advance());
    const auto& zone = walk.model.zones.front();
    int excluded = 0;
    for (std::size_t i = 0; i < zone.points.size(); ++i)
      if (zone.points[i].excluded) {
        ++excluded;
        EXPECT_EQ(walk.state().zones.front().status[i], Status::open);
      }
    EXPECT_EQ(excluded, 1);
    for (std::size_t i = 0; i < walk.slave_count(); ++i)
      if (walk.slave_point(i)[0] < 1e-9) {
        EXPECT_EQ(walk.pressure(i), 0);
      }
  }
}

/// The plane is the slave here and reaches beyond the block: what faces nothing carries nothing.
TEST(PointsThatFaceNothing, CarryNothing) {
  Walk walk(test::block_on_plane,
            {{"contact.foot.master", "under"}, {"contact.foot.slave", "over"}, {"supports.1.x.value", "0"}});
  ASSERT_TRUE(walk.to_end());
  double carried = 0;
  for (std::size_t i = 0; i < walk.slave_count(); ++i) {
    const double x = walk.slave_point(i)[0];
    if (x < -0.13 || x > 1.13) { // half a face of the block beyond its ends
      EXPECT_EQ(walk.pressure(i), 0) << "x = " << x;
    }
    carried += walk.pressure(i);
  }
  EXPECT_GT(carried, 0);
  EXPECT_NEAR(walk.resultants().force[1], -1000, 1e-5);
}

TEST(SeveralZones, EachCarryTheLoad) {
  Walk walk(test::three_blocks);
  ASSERT_TRUE(walk.to_end());
  for (const std::size_t zone : {0u, 1u})
    for (std::size_t i = 0; i < walk.slave_count(zone); ++i)
      EXPECT_NEAR(walk.pressure(i, zone), 2e4, 1e-6) << "zone " << zone;
  EXPECT_NEAR(walk.displacement(walk.node_at(1, 1), 1), -0.01, 1e-12);
  EXPECT_NEAR(walk.displacement(walk.node_at(1, 2), 1), walk.displacement(walk.node_at(0, 2), 1), 1e-12);
}

TEST(QuadraticFaces, AreInContactAtCornersAndMiddles) {
  Walk walk(test::two_beams, {{"mesh.generate.0.cells", "quad9"}, {"mesh.generate.1.cells", "quad9"}});
  EXPECT_EQ(walk.slave_count(), 41u);
  while (!walk.finished())
    ASSERT_TRUE(walk.advance()) << "t = " << walk.state().t;
  EXPECT_GT(walk.resultants().in_contact, 0);
  EXPECT_LT(walk.displacement(walk.node_at(1, 0.1), 1), 0);
}

} // namespace
} // namespace rubato::step::contact_set_test
