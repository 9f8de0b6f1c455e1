// SPDX-License-Identifier: LGPL-3.0-or-later
// Contact whose pressure grows exponentially from a clearance on.
#include "rubato/contact/exponential.hpp"
#include "rubato/step/energy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <tuple>

namespace rubato::step::exponential_test {
namespace {

using test::Walk;

constexpr double base = 1e6;
constexpr double clearance = 1e-5;
const std::string law = "method: exponential, coefficients: {pressure: 1e6, clearance: 1e-5}";

/// A block on a rigid plane, apart by the clearance and more.
const std::string block = R"(
mesh:
  generate:
    - {name: b, rectangle: {from: [0, 2e-5], to: [1, 1.00002]}, divisions: [3, 2], sides: {bottom: under, top: roof, left: left}}
physics: plane_strain
materials: {steel: {young: 200e9, poisson: 0.3, density: 7800}}
supports: [{on: left, fix: x}]
newton: {residual: 1e-10}
)";
const std::string floor_below = "contact: {floor: {slave: under, integration: nodes, obstacle: {plane: "
                                "{point: [0, 0], normal: [0, 1]}}, " +
                                law + "}}\n";

/// Two of them, the lower one on the ground.
const std::string blocks = R"(
mesh:
  generate:
    - {name: b, rectangle: {from: [0, 2e-5], to: [1, 1.00002]}, divisions: [3, 2], sides: {bottom: under, top: roof, left: left}}
    - {name: g, rectangle: {from: [0, -1], to: [1, 0]}, divisions: [3, 2], sides: {bottom: ground, top: over, left: left}}
physics: plane_strain
materials: {steel: {young: 200e9, poisson: 0, density: 7800}}
supports: [{on: left, fix: x}, {on: ground, fix: y}]
newton: {residual: 1e-10}
)";
const std::string interface_between =
    "contact: {joint: {slave: under, integration: nodes, master: over, " + law + "}}\n";

std::string pressed(double pressure) {
  return fmt::format("loads: [{{surface_force: {{on: roof, y: {:.17g}}}}}]\n"
                     "time: {{scheme: static, step: 1, end: 1}}\n",
                     -pressure);
}

std::string as_calculix(std::string deck) {
  const std::string last = "clearance: 1e-5";
  return deck.insert(deck.find(last) + last.size(), ", curve: calculix");
}

/// What p(g) = p asks for.
double gap_under(double pressure, study::ExponentialCurve curve) {
  return contact::exponential::gap_of(pressure, {base, clearance, curve});
}

struct Press {
  const char* name;
  std::string deck;
  study::ExponentialCurve curve = study::ExponentialCurve::abaqus;
};
void PrintTo(const Press& press, std::ostream* out) {
  *out << press.name;
}

class PressedBlock : public testing::TestWithParam<std::tuple<Press, double>> {};

/// In one step from apart, also under pressures far from p₀: the prediction follows the law.
TEST_P(PressedBlock, StandsWhereTheLawHasThePressure) {
  const auto& [press, multiple] = GetParam();
  Walk walk(press.deck + pressed(multiple * base));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 1U) << "attempts";
  const double expected = gap_under(multiple * base, press.curve);
  for (const auto& outcome : walk.state().zones[0].outcomes) {
    EXPECT_NEAR(outcome.gap, expected, 1e-9 * std::max(clearance, std::abs(expected)));
    EXPECT_NEAR(outcome.pressure, multiple * base, 1e-9 * multiple * base);
  }
}

std::string name_of_press(const testing::TestParamInfo<std::tuple<Press, double>>& chosen) {
  return std::string(std::get<0>(chosen.param).name) + std::to_string(chosen.index);
}

INSTANTIATE_TEST_SUITE_P(Masters, PressedBlock,
                         testing::Combine(testing::Values(Press{"OnAPlane", block + floor_below},
                                                          Press{"OnABlock", blocks + interface_between}),
                                          testing::Values(1e-3, 0.1, 1.0, 30.0, 1e3)),
                         name_of_press);

/// At 1e3 p₀ rounding of places is 4e-9 of the pressure: −dp/dg is 4.6 p/c₀ there.
INSTANTIATE_TEST_SUITE_P(OfCalculix, PressedBlock,
                         testing::Combine(testing::Values(Press{"OnABlock",
                                                                as_calculix(blocks + interface_between),
                                                                study::ExponentialCurve::calculix}),
                                          testing::Values(1e-3, 0.1, 1.0, 30.0)),
                         name_of_press);

struct Bounce {
  EnergyLedger ledger;
  double gain = 0;
  double out_of_balance = 0;
  bool rebounded = false;
};

Bounce bounce(double step, const std::string& more = "") {
  Walk walk(block + floor_below + more +
            fmt::format("initial: [{{on: all, velocity: {{y: -0.5}}}}]\n"
                        "time: {{scheme: newmark, step: {}, end: 1e-3}}\n",
                        step));
  Bounce result;
  walk.accepted = [&] {
    const auto& ledger = walk.simulation.energy();
    result.gain = std::max(result.gain, std::abs(ledger.gain()));
    result.out_of_balance = std::max(result.out_of_balance, std::abs(ledger.balance()));
  };
  EXPECT_TRUE(walk.to_end());
  result.ledger = walk.simulation.energy();
  result.rebounded = walk.state().motion.v.sum() > 0 && result.ledger.contact == 0;
  return result;
}

/// The spring gives back what it took, but for the error of the trapezoidal rule.
TEST(BouncingBlock, LosesAndGainsNothingAsStepsBecomeShort) {
  const auto coarse = bounce(4e-6);
  const auto fine = bounce(2e-6);
  for (const auto& run : {coarse, fine}) {
    EXPECT_TRUE(run.rebounded);
    EXPECT_LT(run.out_of_balance, 1e-9 * run.ledger.start);
  }
  EXPECT_LT(fine.gain, 1e-3 * fine.ledger.start);
  EXPECT_LT(fine.gain, coarse.gain / 2.5);
}

/// Dragged along by the roof, farther than friction springs give way.
TEST(DraggedBlock, SlidesAtTheFrictionOfItsPressure) {
  for (const std::string friction : {"penalty", "augmented_lagrangian"}) {
    auto deck = blocks + interface_between + pressed(2 * base);
    deck.replace(deck.find("method: exp"), 0, "friction: 0.25, friction_method: " + friction + ", ");
    deck.replace(deck.find("{on: left, fix: x}"), 18, "{on: roof, x: 1e-3}, {on: ground, fix: x}");
    Walk walk(deck);
    ASSERT_TRUE(walk.to_end()) << friction;
    const auto sum = walk.resultants();
    EXPECT_NEAR(sum.normal, 2 * base, 1e-4 * base) << friction << ", but for the tilt that friction gives";
    EXPECT_NEAR(sum.friction, 0.25 * sum.normal, 1e-9 * base) << friction;
  }
}

} // namespace
} // namespace rubato::step::exponential_test
