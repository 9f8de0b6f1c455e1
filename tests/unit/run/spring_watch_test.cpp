// SPDX-License-Identifier: LGPL-3.0-or-later
// Springs of penalties that give way as bodies do are told at the end, with a coefficient that is stiff
// enough.
#include "rubato/run/spring_watch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <string>
#include <vector>

namespace rubato::run::spring_watch_test {
namespace {

struct Squeezed {
  double force = 0;
  std::vector<std::string> warned;
};

/// A layer of height 1 that a roof presses by 0.01 on a floor, E = 1000, without lateral contraction.
Squeezed squeeze(const std::string& contact, const std::string& time, double unit = 1) {
  test::Walk walk(fmt::format(R"(
mesh: {{generate: [{{name: layer, rectangle: {{from: [0, 0], to: [{0:g}, {0:g}]}}, divisions: [3, 3], cells: quad4, sides: {{bottom: under, top: roof}}}}]}}
physics: plane_strain
materials: {{rubber: {{young: {1:g}, poisson: 0, density: {2:g}}}}}
functions: {{press: {{times: [0, 1, 2], values: [0, 1, 1]}}}}
supports: [{{on: roof, x: 0, y: {{value: {3:g}, function: press}}}}]
contact: {{floor: {{slave: under, integration: nodes, obstacle: {{plane: {{point: [0, 0], normal: [0, 1]}}}}, {4}}}}}
time: {{{5}}}
)",
                              unit, 1000 / unit / unit, 1e-3 / unit / unit / unit, -0.01 * unit, contact,
                              time));
  Squeezed found;
  Watch watch;
  watch.warn = [&](const std::string& text) { found.warned.push_back(text); };
  SpringWatch springs(walk.model, watch);
  walk.accepted = [&] { springs.note(walk.state(), walk.simulation.energy()); };
  EXPECT_TRUE(walk.to_end());
  springs.tell();
  found.force = walk.resultants().force.y() * unit; // per unit of the unit of length
  return found;
}

const std::string at_rest = "scheme: static, step: 0.5, end: 1";

std::string penalty(double stiffness) {
  return fmt::format("method: penalty, coefficients: {{normal: {:g}}}", stiffness);
}

/// In series with a stiffness of 1000: the part of the way that the spring takes.
TEST(Springs, ThatGiveWayAreToldWithThePartThatIsMissing) {
  for (const double stiffness : {1e3, 5e3, 1.9e4}) {
    const auto found = squeeze(penalty(stiffness), at_rest);
    EXPECT_NEAR(found.force, 10 / (1 + 1000 / stiffness), 1e-6);
    ASSERT_EQ(found.warned.size(), 1U) << stiffness;
    EXPECT_NE(
        found.warned[0].find(fmt::format("are too small by {:.0f} %; expected 'coefficients: {{normal: ",
                                         100 * (1 - found.force / 10))),
        std::string::npos)
        << found.warned[0];
    EXPECT_NE(found.warned[0].find("the springs of contact.floor held"), std::string::npos)
        << found.warned[0];
  }
}

TEST(Springs, ThatAreStiffAreNotTold) {
  for (const double stiffness : {2.1e4, 1e5, 1e6})
    EXPECT_TRUE(squeeze(penalty(stiffness), at_rest).warned.empty()) << stiffness;
}

TEST(Springs, OfTheNamedStiffnessAreStiffEnoughInAnyUnit) {
  for (const double unit : {1., 1e-3, 1e3}) {
    const auto soft = squeeze(penalty(2e3 / unit / unit / unit), at_rest, unit);
    ASSERT_EQ(soft.warned.size(), 1U) << unit;
    EXPECT_NE(soft.warned[0].find(fmt::format("normal: {:g}}}'", 1e5 / unit / unit / unit)),
              std::string::npos)
        << soft.warned[0];
    EXPECT_TRUE(squeeze(penalty(1e5 / unit / unit / unit), at_rest, unit).warned.empty()) << unit;
  }
}

/// A coefficient is the stiffness of a node there: of a third of the width, and half of that at the ends.
TEST(Springs, OfNodesAreToldWithTheStiffnessOfANode) {
  const auto nodal = [](double stiffness) {
    return squeeze(fmt::format("method: nodal_penalty, coefficients: {{normal: {:g}}}", stiffness), at_rest);
  };
  const auto soft = nodal(1000);
  ASSERT_EQ(soft.warned.size(), 1U);
  EXPECT_TRUE(nodal(5e4).warned.empty());
  EXPECT_NE(soft.warned[0].find("normal: 50000}'"), std::string::npos) << soft.warned[0];
}

TEST(Springs, AreNoneOfExactMethods) {
  EXPECT_TRUE(squeeze("method: augmented_lagrangian", at_rest).warned.empty());
}

} // namespace
} // namespace rubato::run::spring_watch_test
