// SPDX-License-Identifier: LGPL-3.0-or-later
/// Slave nodes on the edges of master faces, and forces that are small against what rounding makes of them.
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <string>

namespace rubato::step::hopping_test {
namespace {

using test::Walk;

/// A block whose nodes stand on those of the plate below: pressed, each stands in a valley between four
/// faces.
const std::string matching = R"(
mesh:
  generate:
    - {name: block, box: {from: [0, 0, 0], to: [40, 20, 40]}, divisions: [8, 2, 4],
       sides: {bottom: under, top: block_top}}
    - {name: plate, box: {from: [-20, -10, -10], to: [80, 0, 50]}, divisions: [20, 2, 6],
       sides: {top: above, bottom: ground}}
physics: solid
materials: {steel: {young: 210000, poisson: 0.3}}
functions: {press: {times: [0, 1, 2], values: [0, 1, 1]}, drag: {times: [0, 1, 2], values: [0, 0, 1]}}
supports: [{on: ground, fix: [x, y, z]}, {on: block_top, x: {value: 20, function: drag}, z: 0}]
loads: [{pressure: {on: block_top, value: 20, function: press}}]
contact: {slide: {master: above, slave: under, integration: nodes}}
time: {scheme: static, step: 1, end: 1}
)";

int most_iterations(const Walk& walk) {
  return std::ranges::max_element(walk.reports, {}, &StepReport::iterations)->iterations;
}

double mean_iterations(const Walk& walk) {
  double sum = 0;
  for (const auto& report : walk.reports)
    sum += report.iterations;
  return sum / static_cast<double>(walk.reports.size());
}

TEST(NodesOnNodesOfTheMaster, SettleInAFewIterations) {
  for (const char* divisions : {"[8, 2, 4]", "[7, 2, 4]", "[8, 2, 5]", "[9, 2, 4]"})
    for (const char* step : {"1", "0.5", "0.1"}) {
      Walk walk(matching, {{"mesh.generate.0.divisions", divisions}, {"time.step", step}});
      ASSERT_TRUE(walk.to_end()) << divisions << " by " << step;
      EXPECT_LE(most_iterations(walk), 6) << divisions << " by " << step;
      EXPECT_FALSE(walk.reports.back().geometry_by_loop);
    }
}

TEST(NodesOnNodesOfTheMaster, AreDraggedFromFaceToFaceWithFriction) {
  Walk walk(matching, {{"contact.slide.friction", "0.3"},
                       {"mesh.generate.0.divisions", "[8, 2, 2]"},
                       {"mesh.generate.1.divisions", "[20, 2, 3]"},
                       {"time.step", "0.04"},
                       {"time.end", "2"}});
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 50u) << "a step was cut";
  EXPECT_LE(mean_iterations(walk), 6);
  EXPECT_LE(most_iterations(walk), 25);
}

/// Two plates pressed together where they overlap, by loads of any size.
const std::string lap_joint = R"(
mesh:
  generate:
    - {name: low, box: {from: [0, 0, 0], to: [100, 5, 20]}, divisions: [20, 2, 4],
       sides: {top: low_top, bottom: low_bottom, left: left}}
    - {name: high, box: {from: [60, 5, 0], to: [160, 10, 20]}, divisions: [20, 2, 4],
       sides: {top: high_top, bottom: high_bottom, right: right}}
physics: solid
materials: {steel: {young: 210000, poisson: 0.3}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: left, fix: [x, y, z]}, {on: right, fix: [x, y, z]}]
loads:
  - {pressure: {on: high_top, value: 10, function: ramp}}
  - {pressure: {on: low_bottom, value: 10, function: ramp}}
contact: {joint: {master: low_top, slave: high_bottom, integration: nodes, friction: 0.3}}
time: {scheme: static, step: 0.25, end: 1}
)";

TEST(ALapJoint, TakesAsManyIterationsWhateverItsLoad) {
  for (const char* load : {"10", "0.1", "1e-3", "1e-5"}) {
    Walk walk(lap_joint, {{"loads.0.pressure.value", load}, {"loads.1.pressure.value", load}});
    ASSERT_TRUE(walk.to_end()) << load;
    EXPECT_EQ(walk.reports.size(), 4u) << load;
    EXPECT_LE(most_iterations(walk), 6) << load;
  }
}

/// Residuals of free bodies are followed below the tolerance, where rounding is nothing to tell about.
TEST(ALapJoint, TellsOfRoundingOnlyAboveTheToleranceWhereOnlyFrictionHoldsIt) {
  for (const char* integration : {"nodes", "mortar"}) {
    Walk walk(lap_joint, {{"supports.1.fix", "[y, z]"}, {"contact.joint.integration", integration}});
    ASSERT_TRUE(walk.to_end()) << integration;
    EXPECT_LE(most_iterations(walk), 6) << integration;
    for (const auto& report : walk.reports)
      EXPECT_TRUE(report.rounding == 0 || report.rounding > report.tolerance) << integration;
  }
}

/// A block that weighs next to nothing beside its stiffness slides a hundred times its size.
TEST(AStiffBlock, SlidesFarWithoutACut) {
  Walk walk(R"(
mesh:
  generate: [{name: block, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2], sides: {bottom: under}}]
physics: solid
materials: {stiff: {young: 1e15, poisson: 0.3, density: 7800}}
initial: [{on: all, velocity: {x: 100}}]
loads: [{gravity: {y: -9.81}}]
contact: {floor: {slave: under, integration: nodes, friction: 0.3, obstacle: {plane: {point: [0, 0, 0], normal: [0, 1, 0]}}}}
time: {step: 1e-3, end: 1}
)");
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 1000u) << "a step was cut";
  EXPECT_LE(most_iterations(walk), 4);
  const auto ends_at_rounding = [](const StepReport& report) { return report.rounding > 0; };
  EXPECT_TRUE(std::ranges::any_of(walk.reports, ends_at_rounding)) << "the case does not meet rounding";
}

} // namespace
} // namespace rubato::step::hopping_test
