// SPDX-License-Identifier: LGPL-3.0-or-later
/// Studies whose Newton iterations go slowly along a few directions, since operators are held in each: a
/// ring's section that turns on its facets, a roller that dents its race in one node.
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/rings.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <string>

namespace rubato::step::slow_iterations_test {
namespace {

using test::Walk;

/// A tube of outer radius 1 between two plates, 1 wide on each side of it, around x = `middle`. The upper one
/// comes down by `press` in the first second and goes aside by `aside` in the second.
struct Squeezed {
  std::string cells = "quad4", physics = "plane_strain";
  double friction = 0, middle = 0, press = 0.1, aside = 0, young = 210e3;
  int faces = 28;
};

test::BuiltModel tube_between_plates(const Squeezed& with) {
  const auto study =
      deck::parse_deck(fmt::format(R"(mesh:
  generate:
    - {{name: tube, rectangle: {{from: [0, 0.4], to: [6.283185307179586, 0.9999]}}, divisions: [{6}, 3], cells: {0},
       sides: {{top: round}}}}
    - {{name: floor, rectangle: {{from: [10, -0.5], to: [12, 0]}}, divisions: [11, 3], cells: {0},
       sides: {{top: under, bottom: foot}}}}
    - {{name: lid, rectangle: {{from: [20, 0], to: [22, 0.5]}}, divisions: [11, 3], cells: {0},
       sides: {{bottom: over, top: head}}}}
physics: {1}
materials:
  steel: {{young: 210e3, poisson: 0.3, cells: [floor, lid]}}
  soft: {{young: {2:g}, poisson: 0.4, cells: tube}}
functions: {{down: {{times: [0, 1, 2], values: [0, 1, 1]}}, side: {{times: [0, 1, 2], values: [0, 0, 1]}}}}
supports:
  - {{on: foot, fix: [x, y]}}
  - {{on: head, y: {{value: {3:g}, function: down}}, x: {{value: {4:g}, function: side}}}}
contact:
  below: {{master: under, slave: round, friction: {5:g}}}
  above: {{master: over, slave: round, friction: {5:g}}}
time: {{scheme: static, step: 0.1, end: {7}}}
)",
                                   with.cells, with.physics, with.young, -with.press, with.aside,
                                   with.friction, with.faces, with.aside == 0 ? 1 : 2),
                       "deck.yaml")
          .runs.front();
  const auto flat = model::load_mesh(study.mesh);
  auto mesh = test::closed_rings(flat);
  for (std::size_t i = 0; i < flat.points.size(); ++i) {
    const auto& place = flat.points[i];
    if (place.x() > 19.5)
      mesh.points[i] = {place.x() - 21, 1 + place.y(), 0};
    else if (place.x() > 9.5)
      mesh.points[i] = {place.x() - 11, place.y() - 1, 0};
    mesh.points[i].x() += with.middle;
  }
  return test::BuiltModel(study, mesh);
}

class SqueezedRing : public testing::TestWithParam<std::string> {};

/// Nothing but its hoop stiffness and its facets resists the turning of its section.
TEST_P(SqueezedRing, TurnsItsSectionWithoutFriction) {
  Walk walk(tube_between_plates(
      {.cells = GetParam(), .physics = "axisymmetric", .middle = 12, .press = 0.2, .young = 8}));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 10U) << "a step was cut";
  for (const auto& report : walk.reports)
    EXPECT_LE(report.iterations, 40);
  const double below = walk.resultants(0).force.y();
  EXPECT_GT(std::abs(below), 1);
  EXPECT_NEAR(walk.resultants(1).force.y(), -below, 1e-6 * std::abs(below));
}

INSTANTIATE_TEST_SUITE_P(Any, SqueezedRing, testing::Values("quad4", "tria3", "quad8", "tria6"));

class Roller : public testing::TestWithParam<std::string> {};

/// Its load rests on one node of the tube on each side.
TEST_P(Roller, DentsItsRaces) {
  for (const int faces : {24, 26, 28, 30})
    for (const double press : {0.001, 0.01}) {
      Walk walk(tube_between_plates(
          {.cells = GetParam(), .friction = 0.1, .press = press, .aside = 0.02, .faces = faces}));
      ASSERT_TRUE(walk.to_end());
      EXPECT_EQ(walk.reports.size(), 20U) << "a step was cut";
      for (const auto& report : walk.reports)
        EXPECT_LE(report.iterations, 12);
    }
}

INSTANTIATE_TEST_SUITE_P(Any, Roller, testing::Values("quad4", "tria3", "quad8", "tria6"));

} // namespace
} // namespace rubato::step::slow_iterations_test
