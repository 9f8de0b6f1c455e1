// SPDX-License-Identifier: LGPL-3.0-or-later
/// So many points touch at once that what they do to one another is not formed: the contact patch test
/// (contact_blocks.hpp) between two plates whose cells do not match.
#include "rubato/contact/zone.hpp"
#include "rubato/step/interface/interface_newton_system.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <cmath>

namespace rubato::many_points_test {
namespace {

constexpr const char* plates = R"(mesh:
  generate:
    - {name: lower, box: {from: [0, 0, 0], to: [1, 0.1, 1]}, divisions: [43, 1, 43], cells: hexa8,
       sides: {bottom: ground, top: lower_face}}
    - {name: upper, box: {from: [0, 0.1, 0], to: [1, 0.2, 1]}, divisions: [46, 1, 46], cells: hexa8,
       sides: {top: roof, bottom: upper_face}}
physics: solid
materials: {rubber: {young: 2e6, poisson: 0}}
supports:
  - {on: ground, fix: [x, y, z]}
  - {on: roof, fix: [x, z], y: -0.01}
contact: {interface: {master: lower_face, slave: upper_face, friction: 0.3}}
time: {scheme: static, step: 1, end: 1}
newton: {residual: 1e-11}
)";

TEST(ManyPoints, PressedAtOnceCarryTheSamePressure) {
  test::Walk walk(plates);
  const auto count = walk.slave_count();
  ASSERT_GT(3 * count, static_cast<std::size_t>(step::InterfaceNewtonSystem::Limits().formed));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 1U) << "no cut";
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(walk.pressure(i) / 1e5, 1, 1e-8) << i;
    EXPECT_NEAR(walk.displacement(walk.model.zones.front().slave.nodes[i], 1), -0.005, 1e-10) << i;
  }
}

} // namespace
} // namespace rubato::many_points_test
