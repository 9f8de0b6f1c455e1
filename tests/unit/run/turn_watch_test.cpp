// SPDX-License-Identifier: LGPL-3.0-or-later
// Groups of rigid and distributed relations that turn too far for linear equations are told, once each.
#include "rubato/run/turn_watch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <string>
#include <vector>

namespace rubato::run::turn_watch_test {
namespace {

/// A bar whose right end a relation holds, and whose reference something turns.
std::vector<std::string> warnings_of(const std::string& relation, const std::string& support,
                                     const std::string& strain, const std::string& load = "") {
  test::Walk walk(R"(
mesh: {generate: [{name: bar, rectangle: {from: [0, 0], to: [4, 1]}, divisions: [8, 2], cells: quad4, sides: {left: left, right: right}}]}
physics: plane_stress
materials: {steel: {young: 1000, poisson: 0.3, strain: )" +
                  strain + R"(}}
relations: {hub: {)" +
                  relation + R"(: {on: right}}}
supports: [{on: left, fix: [x, y]})" +
                  support + R"(]
)" + load + R"(
functions: {f: {times: [0, 1], values: [0, 1]}}
time: {scheme: static, end: 1, step: 0.25}
)");
  std::vector<std::string> warned;
  Watch watch;
  watch.warn = [&](const std::string& text) { warned.push_back(text); };
  TurnWatch turns(walk.model, watch);
  walk.accepted = [&] { turns.note(walk.state()); };
  EXPECT_TRUE(walk.to_end());
  return warned;
}

std::string turned(const std::string& by) {
  return ", {on: hub, turn: {z: {value: " + by + ", function: f}}}";
}

TEST(Turns, OfARigidGroupAreToldOnceBeyondSmallOnes) {
  const auto warned = warnings_of("rigid", turned("-0.1"), "green_lagrange");
  ASSERT_EQ(warned.size(), 1U);
  EXPECT_EQ(
      warned[0],
      "run: at t = 0.75 the rigid relation 'hub' has turned by 0.075 radians, more than 0.05: it holds for "
      "small "
      "rotations and stretches its group by 0.0028; expected a group that 'supports: rotate' turns where the "
      "rotation is given, or a stiff meshed body of a material with strain: green_lagrange in the relation's "
      "place");
}

TEST(Turns, WithSmallStrainAreToldWithWhatStretchesBodiesToo) {
  const auto warned = warnings_of("rigid", turned("0.1"), "small");
  ASSERT_EQ(warned.size(), 1U);
  EXPECT_NE(warned[0].find("expected a material with strain: green_lagrange or logarithmic"),
            std::string::npos)
      << warned[0];
}

TEST(Turns, AreNotToldWhereTheyAreSmall) {
  EXPECT_TRUE(warnings_of("rigid", turned("0.049"), "green_lagrange").empty());
}

/// Where something acts on its reference; else it only looks at its group.
TEST(Turns, OfADistributedGroupAreToldWhereItsReferenceCounts) {
  const auto warned = warnings_of("distributed", turned("0.1"), "green_lagrange");
  ASSERT_EQ(warned.size(), 1U);
  EXPECT_NE(warned[0].find("the distributed relation 'hub' has turned by 0.075"), std::string::npos)
      << warned[0];
  EXPECT_TRUE(warnings_of("distributed", "", "green_lagrange",
                          "loads: [{surface_force: {on: right, y: -1, function: f}}]")
                  .empty());
}

/// A connector of length 10 between two blocks, one of which is moved aside.
std::vector<std::string> warnings_of_a_connector(const std::string& connector, double aside) {
  test::Walk walk(fmt::format(R"(
mesh: {{generate: [{{name: bob, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [1, 1], cells: quad4, sides: {{bottom: low}}, points: {{left_top: end}}}},
  {{name: hook, rectangle: {{from: [0, 11], to: [1, 12]}}, divisions: [1, 1], cells: quad4, sides: {{top: high}}, points: {{left_bottom: eye}}}}]}}
physics: plane_stress
materials: {{steel: {{young: 1000, poisson: 0.3}}}}
supports: [{{on: high, fix: [x, y]}}, {{on: low, y: 0, x: {{value: {}, function: f}}}}]
connectors: [{{on: end, to: eye, stiffness: 1{}}}]
functions: {{f: {{times: [0, 1], values: [0, 1]}}}}
time: {{scheme: static, end: 1, step: 0.25}}
)",
                              aside, connector));
  std::vector<std::string> warned;
  Watch watch;
  watch.warn = [&](const std::string& text) { warned.push_back(text); };
  TurnWatch turns(walk.model, watch);
  walk.accepted = [&] { turns.note(walk.state()); };
  EXPECT_TRUE(walk.to_end());
  return warned;
}

TEST(Turns, OfAConnectorAlongTheWayBetweenItsEndsAreToldOnce) {
  for (const double aside : {0.3, -0.45, 0.49})
    EXPECT_TRUE(warnings_of_a_connector("", aside).empty()) << aside;
  for (const double aside : {0.55, -0.8, 4.})
    EXPECT_EQ(warnings_of_a_connector("", aside).size(), 1U) << aside;
  EXPECT_NE(warnings_of_a_connector("", 0.6).at(0).find(
                "the connector between 'end' and 'eye' has turned by 0.0599 radians, more than 0.05"),
            std::string::npos);
  EXPECT_NE(warnings_of_a_connector("", 0.6).at(0).find(
                "expected 'rotates: true' at the connector, which then acts along the current line"),
            std::string::npos);
  EXPECT_TRUE(warnings_of_a_connector(", along: [0, 1]", 4).empty()) << "a direction of its own is meant";
  EXPECT_TRUE(warnings_of_a_connector(", rotates: true", 4).empty()) << "it acts along the current line";
}

} // namespace
} // namespace rubato::run::turn_watch_test
