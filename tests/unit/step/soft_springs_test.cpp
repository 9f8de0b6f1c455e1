// SPDX-License-Identifier: LGPL-3.0-or-later
/// Static runs of bodies that soft springs keep from being lost, as users of other codes add them: contact
/// says where such a body is.
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

namespace rubato::step::soft_springs_test {
namespace {

using test::Walk;

int most_iterations(const Walk& walk) {
  int most = 0;
  for (const auto& report : walk.reports)
    most = std::max(most, report.iterations);
  return most;
}

/// A block on springs, each of its 30 nodes by `stiffness`, is pressed by 100 towards a floor; faces are 2
/// and 50/13 wide.
std::string lowered_block(double gap, double stiffness, double friction, double pressure = 10) {
  const auto text = [](double value) { return std::to_string(value); };
  return R"(
physics: plane_strain
mesh:
  generate:
    - {name: floor, rectangle: {from: [-20, -10], to: [30, 0]}, divisions: [13, 3], sides: {top: above, bottom: base}}
    - {name: block, rectangle: {from: [0, )" +
         text(gap) + "], to: [10, " + text(gap + 8) +
         R"(]}, divisions: [5, 4], sides: {bottom: under, top: roof}}
materials: {steel: {young: 210e3, poisson: 0.3}}
supports: [{on: base, fix: [x, y]}]
springs: [{on: block, x: )" +
         fmt::format("{:g}, y: {:g}", stiffness, stiffness) + R"(}]
functions: {ramp: {times: [0, 1], values: [0, 1]}}
loads: [{pressure: {on: roof, value: )" +
         text(pressure) + R"(, function: ramp}}]
contact: {rest: {master: above, slave: under, friction: )" +
         text(friction) + R"(}}
time: {scheme: static, step: 0.2, end: 1}
)";
}

/// Gap, stiffness of a node's spring, friction.
class LoweredBlock : public testing::TestWithParam<std::tuple<double, double, double>> {};

/// Springs carry what they are stretched by, contact the rest; none without a floor in the way.
TEST_P(LoweredBlock, StandsOnItsFloor) {
  const auto [gap, stiffness, friction] = GetParam();
  Walk walk(lowered_block(gap, stiffness, friction));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 5U) << "a step was cut";
  EXPECT_LE(most_iterations(walk), 60) << "an iteration moves it by half a face at most";
  const double carried = std::max(0.0, 100 - 30 * stiffness * gap);
  EXPECT_NEAR(walk.resultants().force.y(), carried, 1e-3 * 100);
}

INSTANTIATE_TEST_SUITE_P(Any, LoweredBlock,
                         testing::Combine(testing::Values(0.0, 0.1, 1.0, 5.0),
                                          testing::Values(1e-6, 1e-3, 0.5), testing::Values(0.0, 0.2)));

TEST(LoweredBlocks, HangFreelyWhereNothingIsInTheWay) {
  for (const double pressure : {3.0, -10.0}) {
    Walk walk(lowered_block(5, 1, 0.2, pressure));
    ASSERT_TRUE(walk.to_end());
    EXPECT_EQ(walk.reports.size(), 5U);
    EXPECT_EQ(walk.resultants().force.y(), 0);
    const auto& u = walk.state().motion.u;
    const double expected = -pressure / 3;
    EXPECT_NEAR(pressure > 0 ? u.minCoeff() : u.maxCoeff(), expected, 2e-3 * std::abs(expected));
  }
}

/// closed_rings turns pins: the facets of pin and ring match.
Eigen::Vector3d turned_as_pins(double angle, double radius) {
  return test::circle(angle + 0.03, radius);
}

/// A smooth ring on a pin, both on springs, pressed together by an interference of 1e-3 beyond their gap:
/// facets alone resist their turning.
class SprungRing : public testing::TestWithParam<double> {
protected:
  static test::BuiltModel model(double stiffness) {
    const auto study = deck::parse_deck(R"(mesh:
  generate:
    - {name: pin, rectangle: {from: [0, 0.3], to: [6.283185307179586, 0.9999]}, divisions: [40, 5],
       sides: {top: pin_skin}}
    - {name: ring, rectangle: {from: [0, 1], to: [6.283185307179586, 1.5]}, divisions: [40, 4],
       sides: {bottom: ring_skin}}
physics: plane_strain
materials: {steel: {young: 2e5, poisson: 0.3}}
springs: [{on: pin, x: )" + fmt::format("{0:g}, y: {0:g}}}, {{on: ring, x: {0:g}, y: {0:g}}}]", stiffness) +
                                            R"(
functions: {ramp: {times: [0, 1], values: [0, 1]}}
contact: {fit: {master: pin_skin, slave: ring_skin, interference: {value: 1.1e-3, function: ramp}}}
time: {scheme: static, step: 0.25, end: 1}
)",
                                        "deck.yaml")
                           .runs.front();
    return test::BuiltModel(study, test::closed_rings(model::load_mesh(study.mesh), turned_as_pins));
  }
};

TEST_P(SprungRing, IsShrunkOnInFewIterations) {
  Walk walk(model(GetParam()));
  ASSERT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 4U) << "a step was cut";
  EXPECT_LE(most_iterations(walk), 10);
  // p = δ/b / ((1+ν)/E (…)): inner pin with a bore of 0.3 and ring to 1.5, plane strain.
  const double e = 2e5, nu = 0.3, a = 0.3, b = 1, c = 1.5;
  const auto out = [&](double in, double around) { return (1 + nu) / e * b * ((1 - 2 * nu) * in + around); };
  const double ring = out(b * b / (c * c - b * b), c * c / (c * c - b * b));
  const double pin = out(b * b / (b * b - a * a), a * a / (b * b - a * a));
  const double p = 1e-3 / (ring + pin);
  EXPECT_NEAR(walk.resultants().normal, p * 2 * std::numbers::pi, 0.03 * p * 2 * std::numbers::pi);
}

INSTANTIATE_TEST_SUITE_P(Any, SprungRing, testing::Values(1e-6, 1e-3, 1.0));

} // namespace
} // namespace rubato::step::soft_springs_test
