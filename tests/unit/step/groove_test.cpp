// SPDX-License-Identifier: LGPL-3.0-or-later
/// A roller in a groove, held by two lines of contact with friction and by nothing else. Where both slide, as
/// they do when its weight comes on, nothing but the change of geometry resists its turning.
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/rings.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

namespace rubato::step::groove_test {
namespace {

using test::Walk;

constexpr double flank_angle = 50 * std::numbers::pi / 180; // of the flanks, from the horizontal

/// A tube of outer radius 1; flanks as tall as it, drawn flat at x = 10 and 20, y from −0.5 to 0.
test::BuiltModel roller_in_groove(const std::string& cells, double weight, double aside) {
  const auto study = deck::parse_deck(fmt::format(R"(mesh:
  generate:
    - {{name: roller, rectangle: {{from: [0, 0.4], to: [6.283185307179586, 0.9999]}}, divisions: [28, 3], cells: {0},
       sides: {{top: round}}}}
    - {{name: left, rectangle: {{from: [10, -0.5], to: [12, 0]}}, divisions: [11, 3], cells: {0},
       sides: {{top: left_flank, bottom: left_foot}}}}
    - {{name: right, rectangle: {{from: [20, -0.5], to: [22, 0]}}, divisions: [11, 3], cells: {0},
       sides: {{top: right_flank, bottom: right_foot}}}}
physics: plane_strain
materials: {{steel: {{young: 210e3, poisson: 0.3, density: 1}}}}
supports: [{{on: left_foot, fix: [x, y]}}, {{on: right_foot, fix: [x, y]}}]
functions: {{ramp: {{times: [0, 1, 2], values: [0, 1, 1]}}, side: {{times: [0, 1, 2], values: [0, 0, 1]}}}}
loads:
  - {{gravity: {{on: roller, y: {1:g}, function: ramp}}}}
  - {{gravity: {{on: roller, x: {2:g}, function: side}}}}
contact:
  left: {{master: left_flank, slave: round, friction: 0.3}}
  right: {{master: right_flank, slave: round, friction: 0.3}}
time: {{scheme: static, step: 0.25, end: 2}}
)",
                                                  cells, -weight, aside),
                                      "deck.yaml")
                         .runs.front();
  auto flat = model::load_mesh(study.mesh);
  auto mesh = test::closed_rings(flat);
  const auto onto_flank = [](double along, double out, double side) {
    const double s = along - 1, c = std::cos(flank_angle), n = std::sin(flank_angle);
    // The foot of the perpendicular from the axis lies at unit distance.
    return Eigen::Vector3d(side * (n + s * c - out * n), -c + s * n + out * c, 0);
  };
  for (std::size_t i = 0; i < flat.points.size(); ++i) {
    const auto& place = flat.points[i];
    if (place.x() > 9.5 && place.x() < 15)
      mesh.points[i] = onto_flank(12 - place.x(), place.y(), -1);
    if (place.x() > 19.5)
      mesh.points[i] = onto_flank(place.x() - 20, place.y(), 1);
  }
  return test::BuiltModel(study, mesh);
}

class Groove : public testing::TestWithParam<std::tuple<std::string, double>> {};

/// Whatever friction does, both flanks together carry weight and thrust.
TEST_P(Groove, HoldsARollerByFrictionAlone) {
  const auto& [cells, weight] = GetParam();
  const double aside = 0.25 * weight;
  Walk walk(roller_in_groove(cells, weight, aside));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 8U) << "a step was cut";
  for (const auto& report : walk.reports)
    EXPECT_LE(report.iterations, 25);
  const double area = 0.5 * 28 * std::sin(2 * std::numbers::pi / 28) * (0.9999 * 0.9999 - 0.4 * 0.4);
  const Eigen::Vector3d force = walk.resultants(0).force + walk.resultants(1).force;
  EXPECT_NEAR(force.y(), area * weight, 0.01 * area * weight);
  EXPECT_NEAR(force.x(), -area * aside, 0.01 * area * weight);
}

INSTANTIATE_TEST_SUITE_P(Any, Groove,
                         testing::Combine(testing::Values("quad4", "tria3", "quad8", "tria6"),
                                          testing::Values(3.0, 30.0, 100.0)));

} // namespace
} // namespace rubato::step::groove_test
