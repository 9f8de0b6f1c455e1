// SPDX-License-Identifier: LGPL-3.0-or-later
// A slave surface with edges of 90°: a node there is a mortar point on each side of the edge.
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/faults.hpp"
#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <string>

namespace rubato::step::sharp_edges_test {
namespace {

/// A block of side 1 in the corner of bodies that are held whole, on meshes that do not match it; pressed by
/// 1e6 on each of its free sides.
std::string block_in_a_corner(bool solid, const std::string& cells) {
  if (!solid)
    return fmt::format(R"(
mesh:
  generate:
    - {{name: block, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [5, 4], cells: {0},
       sides: {{bottom: skin, left: skin, top: roof, right: flank}}}}
    - {{name: floor, rectangle: {{from: [0, -1], to: [2, 0]}}, divisions: [7, 2], cells: {0}, sides: {{top: pocket}}}}
    - {{name: wall, rectangle: {{from: [-1, 0], to: [0, 2]}}, divisions: [2, 7], cells: {0}, sides: {{right: pocket}}}}
physics: plane_strain
materials: {{steel: {{young: 1e9, poisson: 0.3, density: 1000}}}}
supports: [{{on: floor, fix: [x, y]}}, {{on: wall, fix: [x, y]}}]
loads: [{{surface_force: {{on: roof, y: -1e6}}}}, {{surface_force: {{on: flank, x: -1e6}}}}]
contact: {{nest: {{master: pocket, slave: skin}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                       cells);
  return fmt::format(R"(
mesh:
  generate:
    - {{name: block, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [3, 4, 3], cells: {0},
       sides: {{bottom: skin, left: skin, back: skin, top: roof, right: flank, front: face}}}}
    - {{name: floor, box: {{from: [0, -1, 0], to: [2, 0, 2]}}, divisions: [5, 1, 5], cells: {0}, sides: {{top: pocket}}}}
    - {{name: wall, box: {{from: [-1, 0, 0], to: [0, 2, 2]}}, divisions: [1, 5, 5], cells: {0}, sides: {{right: pocket}}}}
    - {{name: rear, box: {{from: [0, 0, -1], to: [2, 2, 0]}}, divisions: [5, 5, 1], cells: {0}, sides: {{front: pocket}}}}
physics: solid
materials: {{steel: {{young: 1e9, poisson: 0.3, density: 1000}}}}
supports: [{{on: floor, fix: [x, y, z]}}, {{on: wall, fix: [x, y, z]}}, {{on: rear, fix: [x, y, z]}}]
loads: [{{surface_force: {{on: roof, y: -1e6}}}}, {{surface_force: {{on: flank, x: -1e6}}}}, {{surface_force: {{on: face, z: -1e6}}}}]
contact: {{nest: {{master: pocket, slave: skin}}}}
time: {{scheme: static, step: 1, end: 1}}
)",
                     cells);
}

/// Every point, those of both sides of the edge included, bears the pressure; the block stays a block.
void expect_uniform(const std::string& deck, std::size_t points) {
  test::Walk walk(deck);
  ASSERT_EQ(walk.slave_count(), points);
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.resultants().in_contact, static_cast<int>(points));
  for (std::size_t i = 0; i < points; ++i)
    EXPECT_NEAR(walk.pressure(i), 1e6, 1e-3) << walk.slave_point(i).transpose();
}

TEST(SharpEdges, BearThePressureOfEachSide) {
  expect_uniform(block_in_a_corner(false, "quad4"), 6 + 5);
  expect_uniform(block_in_a_corner(false, "quad8"), 11 + 9);
  expect_uniform(block_in_a_corner(false, "tria3"), 6 + 5);
  expect_uniform(block_in_a_corner(true, "hexa8"), 20 + 16 + 20);
  expect_uniform(block_in_a_corner(true, "tetra4"), 20 + 16 + 20);
}

TEST(SharpEdges, HoldStillByFriction) {
  for (const bool solid : {false, true}) {
    test::Walk walk(block_in_a_corner(solid, solid ? "hexa8" : "quad4"), {{"contact.nest.friction", "0.3"}});
    ASSERT_TRUE(walk.to_end());
    EXPECT_GT(walk.resultants().friction, 0);
    EXPECT_LT(walk.resultants().smallest_gap, 1e-12);
    for (const auto& outcome : walk.state().zones.front().outcomes)
      EXPECT_GT(outcome.gap, -1e-3 * 1e6 / 1e9);
  }
}

/// The skin of a whole block may be a slave: what faces nothing bears nothing.
TEST(SharpEdges, OfABlockOnAFloorBearOnItsSideOnly) {
  test::Walk walk(R"(
mesh:
  generate:
    - {name: block, rectangle: {from: [0.3, 0], to: [1.3, 1]}, divisions: [5, 4], cells: quad4,
       sides: {bottom: skin, left: skin, right: skin, top: roof}}
    - {name: floor, rectangle: {from: [0, -1], to: [2, 0]}, divisions: [7, 2], cells: quad4, sides: {top: over}}
physics: plane_strain
materials: {steel: {young: 1e9, poisson: 0, density: 1000}}
supports: [{on: floor, fix: [x, y]}, {on: roof, fix: x}]
loads: [{surface_force: {on: roof, y: -1e6}}]
contact: {rest: {master: over, slave: skin}}
time: {scheme: static, step: 1, end: 1}
)");
  ASSERT_EQ(walk.slave_count(), 6U + 5 + 5);
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.resultants().in_contact, 6);
  EXPECT_NEAR(walk.resultants().normal, 1e6, 1e-3);
  for (std::size_t i = 0; i < walk.slave_count(); ++i)
    if (walk.pressure(i) != 0) {
      EXPECT_NEAR(walk.pressure(i), 1e6, 1e-3) << walk.slave_point(i).transpose();
    }
}

TEST(SharpEdges, AreNotTied) {
  const auto fault = test::fault_of([] {
    test::model_of(block_in_a_corner(false, "quad4"), {{"contact.nest.tie", "true"}});
  });
  EXPECT_NE(
      fault.find("of slave 'skin' make an edge of more than 60 degrees, whose nodes a tie cannot hold on "
                 "both sides; expected a tie for each side of it"),
      std::string::npos)
      << fault;
}

} // namespace
} // namespace rubato::step::sharp_edges_test
