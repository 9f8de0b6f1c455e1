// SPDX-License-Identifier: LGPL-3.0-or-later
// Checks that a run makes of itself: their values against closed forms, and studies that pass and fail each.
#include "rubato/deck/read.hpp"
#include "rubato/results/plausibility.hpp"
#include "rubato/run/run_study.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "support/scratch_folder.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::run::plausibility_test {
namespace {

using results::Plausibility;

struct Checked {
  std::vector<Plausibility> checks;
  std::vector<std::string> warned, said;

  const Plausibility* find(const std::string& name) const {
    const auto found = std::ranges::find(checks, name, &Plausibility::name);
    return found == checks.end() ? nullptr : &*found;
  }
  double value(const std::string& name) const {
    const auto* const check = find(name);
    EXPECT_NE(check, nullptr) << name;
    return check == nullptr ? NAN : check->value;
  }
};

class OwnChecks : public testing::Test {
protected:
  Checked run(const std::string& deck, const std::vector<deck::Setting>& changes = {}) {
    Checked found;
    Watch watch;
    watch.say = [&](const std::string& text) { found.said.push_back(text); };
    watch.warn = [&](const std::string& text) { found.warned.push_back(text); };
    const auto study = deck::parse_deck(deck, "deck.yaml", changes).runs.front();
    const auto result = run_study(study, folder_ / "out", watch);
    EXPECT_EQ(result.status, Status::complete) << result.message;
    found.checks = result.plausibility;
    return found;
  }
  nlohmann::json summary() const {
    std::ifstream file(folder_ / "out/run.json");
    return nlohmann::json::parse(file);
  }

  test::ScratchFolder folder_;
};

TEST_F(OwnChecks, PassWhereNothingIsWrongAndAreInTheSummary) {
  const auto found = run(test::two_blocks);
  EXPECT_TRUE(found.warned.empty()) << found.warned.front();
  EXPECT_EQ(found.said.back(), fmt::format("run: {0} of {0} checks passed", found.checks.size()));
  const auto json = summary().at("plausibility");
  ASSERT_EQ(json.size(), found.checks.size());
  for (std::size_t i = 0; i < json.size(); ++i) {
    EXPECT_EQ(json[i].at("check"), found.checks[i].name);
    EXPECT_EQ(json[i].at("value"), found.checks[i].value);
    EXPECT_EQ(json[i].at("passes"), true);
  }
}

/// A cell that stretches as a mass on a spring: k = E, half its mass moves; units of length, time and force.
std::string oscillator(double step, double steps, double unit = 1) {
  return fmt::format(R"(
mesh: {{generate: [{{name: cell, rectangle: {{from: [0, 0], to: [{0:g}, {0:g}]}}, divisions: [1, 1], cells: quad4, sides: {{left: held, right: free}}}}]}}
physics: plane_strain
materials: {{m: {{young: {1:g}, poisson: 0, density: {2:g}}}}}
supports: [{{on: held, fix: [x, y]}}, {{on: free, fix: [y]}}]
initial: [{{on: free, velocity: {{x: {3:g}}}}}]
time: {{scheme: newmark, step: {4:.17g}, end: {5:.17g}}}
)",
                     unit, 1 / unit / unit, 3 / unit / unit / unit / unit, 1e-3 * unit, step, steps * step);
}

/// Newmark's frequency is (2/h) atan(ω h/2), with ω² = E/(ρ/3) = 1; differences of velocities show 2 sin of
/// half its phase. Shear waves pass the cell in √(2ρ/E).
TEST_F(OwnChecks, CompareStepsAndCellsWithThePeriod) {
  for (const double step : {0.02, 0.3, 1.2, 30.}) {
    const double ratio = 2 * std::sin(std::atan(step / 2)) / (2 * std::numbers::pi);
    const double steps_in_period = std::numbers::pi / std::atan(step / 2);
    const auto found = run(oscillator(step, std::round(8 * steps_in_period)));
    EXPECT_NEAR(found.value("step_in_period"), ratio, 0.03 * ratio) << step;
    EXPECT_NEAR(found.value("cell_in_wave"), ratio / step * std::sqrt(6), 0.03 * ratio / step * std::sqrt(6));
    EXPECT_EQ(found.find("step_in_period")->passes(), ratio < 0.25) << step;
  }
}

/// A sheet of thickness g that the mesh does not have, under a uniform pressure and as large a shear stress.
/// Shear acts on both sides, so the moment is shear times g; a side is as long as 1. A tie over the same gap
/// has none but by what small strain leaves out.
TEST_F(OwnChecks, TellHowFarForcesOfBothSidesStandBesideOneAnother) {
  const auto joined = [](double gap, const std::string& joint) {
    return fmt::format(R"(
mesh: {{generate: [{{name: a, rectangle: {{from: [0, 0], to: [4, 1]}}, divisions: [4, 1], sides: {{bottom: ground, top: low, left: a_left, right: a_right}}}},
 {{name: b, rectangle: {{from: [0, {0:g}], to: [4, {1:g}]}}, divisions: [4, 1], sides: {{bottom: high, top: moved, left: b_left, right: b_right}}}}]}}
physics: plane_strain
materials: {{m: {{young: 1000, poisson: 0}}}}
functions: {{r: {{ramp: [0, 1]}}}}
supports: [{{on: ground, fix: [x, y]}}, {{on: moved, y: {{value: -0.01, function: r}}, x: {{value: 0.02, function: r}}}}]
loads:
  - {{surface_force: {{on: a_left, y: -5, function: r}}}}
  - {{surface_force: {{on: b_left, y: -5, function: r}}}}
  - {{surface_force: {{on: a_right, y: 5, function: r}}}}
  - {{surface_force: {{on: b_right, y: 5, function: r}}}}
contact: {{weld: {{slave: high, master: low, {2}}}}}
time: {{scheme: static, step: 0.5, end: 1}}
)",
                       1 + gap, 2 + gap, joint);
  };
  for (const double gap : {0., 0.05, 0.4}) {
    EXPECT_LT(run(joined(gap, "tie: true")).value("contact_moment"), 1e-3) << gap;
    const auto found = run(joined(gap, fmt::format("friction: 2, interference: {:g}", gap)));
    EXPECT_NEAR(found.value("contact_moment"), gap / std::numbers::sqrt2, 1e-6);
    const bool fails = gap > 0.2;
    EXPECT_EQ(found.warned.size(), fails ? 1U : 0U);
    if (fails)
      EXPECT_NE(found.warned.front().find("contact_moment is"), std::string::npos) << found.warned.front();
    if (fails)
      EXPECT_NE(found.warned.front().find("of contact.weld"), std::string::npos) << found.warned.front();
    EXPECT_LT(found.value("contact_forces"), 1e-12);
  }
}

/// A block whose chamfered end is dragged over a rail: the slave's normal at its edge has a part along the
/// rail.
TEST_F(OwnChecks, TellContactThatDragsWithoutFriction) {
  const auto dragged = [](const std::string& zone) {
    return fmt::format(R"(
mesh: {{generate: [{{name: b, rectangle: {{from: [0, 2], to: [3, 3]}}, divisions: [3, 1], sides: {{bottom: sole, top: held}}}},
 {{name: t, rectangle: {{from: [-2, 0], to: [9, 2]}}, divisions: [22, 2], sides: {{top: rail, bottom: ground}}}}]}}
physics: plane_strain
materials: {{s: {{young: 1000, poisson: 0.3}}}}
functions: {{turn: {{ramp: [0, 0.1]}}, press: {{ramp: [0.1, 0.2]}}, go: {{ramp: [0.2, 1.2]}}}}
supports: [{{on: ground, fix: [x, y]}}, {{on: held, rotate: {{about: [0, 3], angle: {{value: 0.03, function: turn}}}}, y: {{value: -0.02, function: press}}, x: {{value: 3, function: go}}}}]
contact: {{j: {{slave: sole, master: rail, {}}}}}
time: {{scheme: static, step: 0.02, end: 1.2}}
)",
                       zone);
  };
  const auto smooth = run(dragged("integration: mortar"));
  EXPECT_LT(smooth.value("contact_work"), 0.02);
  const auto rough = run(dragged("normal: slave, integration: nodes"));
  EXPECT_GT(rough.value("contact_work"), 0.1);
  EXPECT_TRUE(std::ranges::any_of(
      rough.warned, [](const auto& text) { return text.find("contact_work is") != std::string::npos; }));
}

/// A block dragged over a rail of long faces. A law of velocities keeps the mean gap that a node of the rail
/// had when the block came over it, and the normal force is 3 % low; static forces are right.
TEST_F(OwnChecks, TellPointsThatPressWithoutBeingClosed) {
  const auto dragged = [](const std::string& sides, const std::string& time) {
    return fmt::format(R"(
mesh: {{generate: [{{name: rail, rectangle: {{from: [-3, -2], to: [9, 0]}}, divisions: [6, 1], sides: {{top: above, bottom: ground}}}},
 {{name: block, rectangle: {{from: [0, 0], to: [4, 2]}}, divisions: [2, 1], sides: {{bottom: sole, top: held}}}}]}}
physics: plane_strain
materials: {{steel: {{young: 1, poisson: 0.3, density: 1e-8}}}}
functions: {{press: {{ramp: [0, 1]}}, go: {{ramp: [1, 2]}}}}
supports: [{{on: ground, fix: [x, y]}}, {{on: held, x: {{value: 1.2, function: go}}, y: {{value: -0.003, function: press}}}}]
contact: {{joint: {{{}}}}}
time: {{{}, end: 2}}
)",
                       sides, time);
  };
  const std::string rail = "slave: above, master: sole", block = "slave: sole, master: above";
  const auto wrong = run(dragged(rail, "step: 0.02"));
  EXPECT_NEAR(wrong.value("closed_gaps"), 0.032, 0.01);
  EXPECT_TRUE(std::ranges::any_of(wrong.warned, [](const auto& text) {
    return text.find("closed_gaps is") != std::string::npos &&
           text.find("contact.joint at node") != std::string::npos;
  }));
  EXPECT_LT(run(dragged(block, "step: 0.02")).value("closed_gaps"), 0.002);
  EXPECT_LT(run(dragged(rail, "step: 0.02, scheme: static")).value("closed_gaps"), 1e-6);
}

/// Small strain gives a bent cantilever that turns by θ a moment of internal forces; finite strain none.
TEST_F(OwnChecks, TellMomentsOfBodiesThatTurn) {
  const auto bent = [](const std::string& strain, double force) {
    return fmt::format(R"(
mesh: {{generate: [{{name: a, rectangle: {{from: [0, 0], to: [10, 1]}}, divisions: [10, 2], cells: quad8, sides: {{left: root, right: tip}}}}]}}
physics: plane_stress
materials: {{s: {{young: 1000, poisson: 0, strain: {0}}}}}
functions: {{r: {{ramp: [0, 1]}}}}
supports: [{{on: root, fix: [x, y]}}]
loads: [{{nodal_force: {{on: tip, x: {1:g}, y: {1:g}, function: r}}}}]
time: {{scheme: static, step: 0.25, end: 1}}
)",
                       strain, force);
  };
  EXPECT_LT(run(bent("green_lagrange", 0.5)).value("body_moments"), 1e-8);
  const auto small = run(bent("small", 0.005)).value("body_moments");
  const auto large = run(bent("small", 0.05)).value("body_moments");
  EXPECT_NEAR(large / small, 10, 0.5);
  EXPECT_GT(run(bent("small", 0.7)).value("body_moments"), 0.05);
}

/// Rubber in quadratic cells that are integrated in full, under a roller.
TEST_F(OwnChecks, TellPressuresThatOscillate) {
  const auto pressed = [](const std::string& cells, const std::string& formulation) {
    return fmt::format(R"(
mesh: {{generate: [{{name: a, rectangle: {{from: [-4, 0], to: [4, 3]}}, divisions: [24, 9], cells: {}, sides: {{bottom: ground, top: face}}}}]}}
physics: plane_strain
materials: {{s: {{law: hyperelastic, c10: 0.5, bulk: 1000, formulation: {}}}}}
functions: {{r: {{ramp: [0, 1]}}}}
supports: [{{on: ground, fix: [x, y]}}]
contact: {{z: {{slave: face, obstacle: {{cylinder: {{point: [0, 8], radius: 5}}, move: {{y: {{value: -0.3, function: r}}}}}}}}}}
time: {{scheme: static, step: 0.25, end: 1}}
)",
                       cells, formulation);
  };
  EXPECT_LT(run(pressed("quad4", "mean_dilatation")).value("pressure_oscillation"), 0.05);
  const auto rough = run(pressed("quad8", "full"));
  EXPECT_GT(rough.value("pressure_oscillation"), 0.2);
  EXPECT_NE(rough.find("pressure_oscillation")->where.find("contact.z at node"), std::string::npos);
}

TEST(Plausibility, KeepsTheLargerOfTwoPartsOfARun) {
  std::vector<Plausibility> all{{"a", 1, 2, 0.5, "x", "", false}, {"b", 3, 2, 0.5, "y", "", false}};
  const std::vector<Plausibility> more{
      {"a", 1.5, 2, 1, "z", "", false}, {"b", 2, 2, 1, "z", "", false}, {"c", NAN, 1, 1, "", "", false}};
  results::keep_larger(all, more);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].where, "z");
  EXPECT_EQ(all[1].where, "y");
  EXPECT_FALSE(all[2].passes());
  EXPECT_EQ(results::summary_of(all), "1 of 3 checks passed, not b (3, at most 2) and c (nan, at most 1)");
}

TEST(Plausibility, ComesBackFromJsonToTheLastBit) {
  const std::vector<Plausibility> checks{
      {"a", 1. / 3, 0.1, 1e-3 / 7, "contact.z at node N1", "expected 'x'", true},
      {"b", 0, 1, 0, "", "", false}};
  EXPECT_EQ(results::plausibility_of(results::plausibility_text(checks)), checks);
}

} // namespace
} // namespace rubato::run::plausibility_test
