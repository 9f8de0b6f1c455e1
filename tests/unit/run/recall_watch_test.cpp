// SPDX-License-Identifier: LGPL-3.0-or-later
// Steps that are too long for back stresses that recall are told, once.
#include "rubato/run/recall_watch.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <string>
#include <vector>

namespace rubato::run::recall_watch_test {
namespace {

std::vector<std::string> warnings_of(const std::string& step, const std::string& recall) {
  test::Walk walk(R"(
mesh: {generate: [{name: bar, rectangle: {from: [0, 0], to: [1, 1]}, divisions: [1, 1], cells: quad4, sides: {left: left, right: right, bottom: bottom}}]}
physics: plane_strain
materials: {steel: {law: plastic, young: 200e3, poisson: 0.3, hardening: {linear: {yield_stress: 200, modulus: 0}}, kinematic: {modulus: 20e3, recall: )" +
                  recall + R"(}}}
supports: [{on: left, fix: x}, {on: bottom, fix: y}, {on: right, x: {value: 0.01, function: f}}]
functions: {f: {times: [0, 1], values: [0, 1]}}
time: {scheme: static, end: 1, step: )" +
                  step + "}\n");
  std::vector<std::string> warned;
  Watch watch;
  watch.warn = [&](const std::string& text) { warned.push_back(text); };
  RecallWatch recalls(walk.model, watch);
  walk.accepted = [&] { recalls.note(walk.before, walk.state()); };
  EXPECT_TRUE(walk.to_end());
  return warned;
}

TEST(Recall, IsToldOfLongSteps) {
  const auto warned = warnings_of("0.25", "100");
  ASSERT_EQ(warned.size(), 1U);
  EXPECT_NE(warned[0].find("expected time.max_plastic_step: 0.001"), std::string::npos) << warned[0];
  EXPECT_NE(warned[0].find(" (QUAD4) at (0.5, 0.5)"), std::string::npos) << warned[0];
}

TEST(Recall, IsNotToldOfShortStepsOrWithoutIt) {
  EXPECT_TRUE(warnings_of("0.05", "100").empty());
  EXPECT_TRUE(warnings_of("0.25", "0").empty());
}

} // namespace
} // namespace rubato::run::recall_watch_test
