// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/study/study.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <ostream>
#include <string>

namespace rubato::verification {

/// A block of 1 × 3 on a rough floor.
struct Tower {
  std::string cells;
  int layers = 0;
};

void PrintTo(const Tower& tower, std::ostream* out) {
  *out << tower.layers << " layers of " << tower.cells;
}

namespace {

class TowerInAnEarthquake : public testing::TestWithParam<Tower> {
protected:
  /// How far the side lifts that the acceleration unloads, when the acceleration has grown for 1 s.
  static double uplift(double acceleration) {
    const auto& [cells, layers] = GetParam();
    const bool solid = cells == "hexa8";
    const auto study =
        test::study_of(fmt::format(R"(
mesh: {{generate: [{{name: b, {}, cells: {}, sides: {{bottom: under}}}}]}}
physics: {}
materials: {{c: {{young: 3e10, poisson: 0.2, density: 2400}}}}
functions: {{weight: {{ramp: [0, 0.09]}}, shake: {{ramp: [0.1, 1.1]}}}}
loads: [{{gravity: {{y: -10, function: weight}}}}]
contact: {{f: {{slave: under, obstacle: {{plane: {{point: {}, normal: {}}}}}, friction: 0.9}}}}
base_motion: {{x: {{acceleration: {}, function: shake}}}}
time: {{step: 1e-3, end: 1.1}}
)",
                                   solid ? fmt::format("box: {{from: [0, 0, 0], to: [1, 3, 1]}}, "
                                                       "divisions: [2, {}, 1]",
                                                       layers)
                                         : fmt::format("rectangle: {{from: [0, 0], to: [1, 3]}}, "
                                                       "divisions: [2, {}]",
                                                       layers),
                                   cells, solid ? "solid" : "plane_strain", solid ? "[0, 0, 0]" : "[0, 0]",
                                   solid ? "[0, 1, 0]" : "[0, 1]", acceleration));
    test::Walk walk(study);
    walk.to_end();
    return walk.displacement(walk.node_at(1, 0), 1);
  }
};

/// It begins to tip at a third of its weight, 1/6 s before the end: 0.3 τ³ of a rigid block.
TEST_P(TowerInAnEarthquake, LiftsItsSideLikeARigidBlock) {
  EXPECT_NEAR(uplift(4), 1.39e-3, 0.02 * 1.39e-3);
}

TEST_P(TowerInAnEarthquake, StandsBelowAThirdOfItsWeight) {
  EXPECT_LT(uplift(3.1), 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Of, TowerInAnEarthquake,
                         testing::Values(Tower{"quad4", 1}, Tower{"quad4", 2}, Tower{"quad4", 3},
                                         Tower{"quad4", 6}, Tower{"quad8", 1}, Tower{"quad8", 2},
                                         Tower{"tria6", 1}, Tower{"tria6", 2}, Tower{"hexa8", 1},
                                         Tower{"hexa8", 3}));

} // namespace
} // namespace rubato::verification
