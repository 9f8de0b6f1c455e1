// SPDX-License-Identifier: LGPL-3.0-or-later
/// A block pressed into the corner of a floor and a wall: the node in the corner is a slave of both.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <cstddef>
#include <string>
#include <tuple>
#include <vector>

namespace rubato::step::corner_test {
namespace {

using test::Walk;

const std::string block_in_a_corner = R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [7, 7],
       sides: {bottom: under, left: beside, top: roof, right: side}}
    - {name: floor, rectangle: {from: [-0.5, -0.4], to: [1.8, 0]}, divisions: [15, 3], sides: {top: ground, bottom: base}}
    - {name: wall, rectangle: {from: [-0.5, 0.02], to: [0, 1.3]}, divisions: [3, 9], sides: {right: face, left: back}}
physics: plane_strain
materials: {steel: {young: 2.1e11, poisson: 0.3}}
supports: [{on: base, fix: [x, y]}, {on: back, fix: [x, y]}]
loads: [{pressure: {on: roof, value: 2e7}}, {pressure: {on: side, value: 1e7}}]
contact:
  below: {master: ground, slave: under, friction: 0.2}
  aside: {master: face, slave: beside, friction: 0.2}
time: {scheme: static, step: 0.1, end: 1}
)";

std::vector<deck::Setting> of_cells(const std::string& cells) {
  return {
      {"mesh.generate.0.cells", cells}, {"mesh.generate.1.cells", cells}, {"mesh.generate.2.cells", cells}};
}

std::size_t corner_point(const Walk& walk, std::size_t zone) {
  std::size_t i = 0;
  while (walk.slave_point(i, zone).norm() > 1e-9)
    ++i;
  return i;
}

class InACorner : public testing::TestWithParam<std::tuple<const char*, const char*>> {
protected:
  static std::vector<deck::Setting> settings() {
    auto all = of_cells(std::get<0>(GetParam()));
    all.push_back({"contact.below.friction", std::get<1>(GetParam())});
    all.push_back({"contact.aside.friction", std::get<1>(GetParam())});
    return all;
  }
};

/// Loads stay as they are: after the first step points that have slipped are held by friction at its limit,
/// and whether they slip or stick is rounding.
TEST_P(InACorner, ABlockUnderConstantLoadsStaysWhereItIs) {
  Walk walk(block_in_a_corner, settings());
  ASSERT_TRUE(walk.advance());
  const Eigen::VectorXd first = walk.state().motion.u;
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 10U) << "a step was cut";
  for (const auto& report : walk.reports)
    EXPECT_LE(report.iterations, 6);
  EXPECT_LE((walk.state().motion.u - first).lpNorm<Eigen::Infinity>(),
            1e-2 * first.lpNorm<Eigen::Infinity>());
}

/// Where both gaps hold the node friction has nothing left to hold. A rougher floor carries what would press
/// it against the wall.
TEST_P(InACorner, TheNodeInItHasNoFrictionWhereBothPress) {
  Walk walk(block_in_a_corner, settings());
  ASSERT_TRUE(walk.to_end());
  const auto outcome = [&](std::size_t zone) {
    return walk.state().zones[zone].outcomes[corner_point(walk, zone)];
  };
  const bool both = !outcome(0).normal.isZero(0) && !outcome(1).normal.isZero(0);
  EXPECT_EQ(both, walk.model.zones.front().settings.friction == 0.2);
  for (const std::size_t zone : {0U, 1U})
    EXPECT_TRUE(!both || outcome(zone).tangential.isZero(0)) << zone;
}

INSTANTIATE_TEST_SUITE_P(Blocks, InACorner,
                         testing::Combine(testing::Values("quad4", "tria3", "quad8", "tria6"),
                                          testing::Values("0.2", "0.4", "0.7")),
                         [](const auto& chosen) {
                           return std::string(std::get<0>(chosen.param)) + "Friction" +
                                  std::string(std::get<1>(chosen.param)).substr(2);
                         });

/// Along the edge of floor and wall a block that is pushed along it rubs with its edge as well.
TEST(ABlockPushedAlongACorner, RubsWithItsEdgeToo) {
  Walk walk(R"(
mesh:
  generate:
    - {name: block, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2], cells: hexa8,
       sides: {bottom: under, left: beside, top: roof, right: side, back: rear}}
    - {name: floor, box: {from: [-0.5, -0.5, -0.5], to: [1.5, 0, 2]}, divisions: [4, 1, 5], cells: hexa8, sides: {top: ground, bottom: base}}
    - {name: wall, box: {from: [-0.5, 0, -0.5], to: [0, 1.5, 2]}, divisions: [1, 3, 5], cells: hexa8, sides: {right: face, left: foot}}
physics: solid
materials: {steel: {young: 2e11, poisson: 0.3}}
functions: {along: {times: [0, 1, 2], values: [0, 0, 1]}}
supports: [{on: base, fix: [x, y, z]}, {on: foot, fix: [x, y, z]}, {on: rear, z: {value: 1e-3, function: along}}]
loads: [{pressure: {on: roof, value: 2e7}}, {pressure: {on: side, value: 1e7}}]
contact:
  below: {master: ground, slave: under, friction: 0.2}
  aside: {master: face, slave: beside, friction: 0.2}
time: {scheme: static, step: 0.5, end: 2}
)");
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 4U) << "a step was cut";
  double normal = 0;
  double along = 0;
  for (std::size_t z = 0; z < 2; ++z)
    for (std::size_t i = 0; i < walk.slave_count(z); ++i) {
      const auto& outcome = walk.state().zones[z].outcomes[i];
      normal += outcome.normal.norm();
      along += outcome.tangential.z();
      if (walk.slave_point(i, z).head<2>().norm() < 1e-9) {
        // The edge leans by the strain.
        EXPECT_LT(outcome.tangential.head<2>().norm(), 1e-4 * outcome.normal.norm());
        EXPECT_NEAR(std::abs(outcome.tangential.z()), 0.2 * outcome.normal.norm(),
                    1e-6 * outcome.normal.norm());
      }
    }
  EXPECT_NEAR(std::abs(along), 0.2 * normal, 1e-6 * normal);
}

} // namespace
} // namespace rubato::step::corner_test
