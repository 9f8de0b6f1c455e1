// SPDX-License-Identifier: LGPL-3.0-or-later
// Gaps and interferences that are expressions of place and time.
#include "rubato/contact/zone.hpp"
#include "rubato/core/error.hpp"
#include "rubato/mesh/mesh.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::gap_field_test {
namespace {

/// Two blocks on one another between a roof that comes down and the ground. Meshes do not match.
const std::string stack = R"(
mesh:
  generate:
    - {name: lower, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [3, 2], sides: {bottom: ground, top: under}}
    - {name: upper, rectangle: {from: [0, 1], to: [2, 2]}, divisions: [4, 2], sides: {top: roof, bottom: over}}
physics: plane_strain
materials: {steel: {young: 100, poisson: 0, density: 1}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: ground, fix: [x, y]}, {on: roof, x: 0, y: {value: -0.03, function: ramp}}]
contact: {seam: {master: under, slave: over}}
time: {scheme: static, step: 0.25, end: 1}
)";

std::string seam(const std::string& settings) {
  return "{master: under, slave: over, " + settings + "}";
}

constexpr std::array every_way{"method: augmented_lagrangian",
                               "method: nodal_lagrange",
                               "method: nodal_pcg",
                               "integration: {gauss: 2}",
                               "integration: {simpson: 2}",
                               "integration: mortar",
                               "freeze: true",
                               "integration: mortar, freeze: true",
                               "normal: average",
                               "method: penalty, coefficients: {normal: 1e5}"};

TEST(AGapOfPlace, ThatIsUniformIsTheNumberBitForBit) {
  for (const char* way : every_way)
    for (const auto& [number, expression] :
         {std::array{"gap: 0.01", "gap: \"0.01\""},
          std::array{"gap: {value: 0.01, function: ramp}", "gap: {value: 0*x+0.01, function: ramp}"},
          std::array{"interference: {value: 0.02, function: ramp}",
                     "interference: {value: \"if(x>1,0.02,0.02)\", function: ramp}"}}) {
      test::Walk by_number(stack, {{"contact.seam", seam(std::string(number) + ", " + way)}});
      test::Walk by_expression(stack, {{"contact.seam", seam(std::string(expression) + ", " + way)}});
      ASSERT_TRUE(by_number.to_end()) << way;
      ASSERT_TRUE(by_expression.to_end()) << way;
      EXPECT_EQ(by_number.state().motion.u, by_expression.state().motion.u) << way << ": " << expression;
      EXPECT_GT(by_number.resultants().normal, 0.1) << way;
    }
}

TEST(AGapOfPlace, ThatIsUniformIsTheNumberInMotion) {
  for (const char* integration : {"nodes", "mortar"}) {
    std::vector<Eigen::VectorXd> ends;
    for (const char* value : {"0.02", "\"0.02+0*y\""}) {
      test::Walk walk(stack,
                      {{"time", "{scheme: moreau_jean, step: 0.02, end: 0.5}"},
                       {"contact.seam.integration", integration},
                       {"contact.seam.interference", std::string("{value: ") + value + ", function: ramp}"}});
      ASSERT_TRUE(walk.to_end());
      ends.push_back(walk.state().motion.u);
    }
    EXPECT_EQ(ends[0], ends[1]) << integration;
  }
}

/// The upper block turns by the slope of the gap, u = (θ (y−1), −θ x), without strain, and closes a gap θ x.
/// Its roof comes down by d more, which strains both blocks by d/2 each: the pressure is E d/2 everywhere.
TEST(AGapOfPlace, ThatIsATiltIsClosedByATurn) {
  for (const char* way : every_way) {
    const bool spring = std::string(way).find("penalty") != std::string::npos;
    if (spring)
      continue;
    test::Walk walk(stack,
                    {{"contact.seam", seam(std::string("gap: \"0.01*x\", ") + way)},
                     {"supports", "[{on: ground, fix: y}, {on: upper, x: \"0.01*t*(y-1)\"}, {on: lower, "
                                  "fix: x}, {on: roof, y: \"-(0.02+0.01*x)*t\"}]"}});
    ASSERT_TRUE(walk.to_end()) << way;
    const auto& zone = walk.model.zones.front();
    for (std::size_t i = 0; i < zone.points.size(); ++i)
      EXPECT_NEAR(walk.state().zones.front().outcomes[i].gap, 0, 2e-4) << way;
    // 1 % of strain over both blocks: E ε times the area, and rotations of 1 % are what is neglected
    EXPECT_NEAR(walk.resultants().normal, 100 * 0.01 * 2, 0.01) << way;
  }
}

/// Frozen geometry is linear: the hand solution to rounding, u = (θ (y−1), −θ x − d/2) on the joint. By
/// mortar on meshes that do not match, where points are nodes or Gauss points on meshes that do: those hand
/// on a uniform pressure.
TEST(AGapOfPlace, ThatIsATiltIsClosedExactlyWhereGeometryIsFrozen) {
  for (const auto& [integration, divisions] :
       {std::array{"nodes", "[4, 2]"}, std::array{"{gauss: 2}", "[4, 2]"}, std::array{"mortar", "[3, 2]"}}) {
    test::Walk walk(
        stack, {{"mesh.generate.0.divisions", divisions},
                {"contact.seam", seam(std::string("freeze: true, gap: 0.01*x, integration: ") + integration)},
                {"supports", "[{on: ground, fix: y}, {on: upper, x: \"0.01*t*(y-1)\"}, {on: lower, "
                             "fix: x}, {on: roof, y: \"-(0.02+0.01*x)*t\"}]"}});
    ASSERT_TRUE(walk.to_end()) << integration;
    const auto& zone = walk.model.zones.front();
    for (const auto& outcome : walk.state().zones.front().outcomes)
      EXPECT_NEAR(outcome.pressure, 1.0, 1e-9) << integration;
    for (const auto node : zone.slave.nodes) {
      const double x = walk.model.mesh.points[static_cast<std::size_t>(node)].x();
      EXPECT_NEAR(walk.displacement(node, 1), -0.01 - 0.01 * x, 1e-12) << integration;
    }
  }
}

/// A hump that comes up with time: work and ledger.
TEST(AGapOfPlaceAndTime, DoesItsWorkAndLeavesTheLedgerClosed) {
  for (const char* integration : {"nodes", "mortar"})
    for (const char* scheme : {"static, step: 0.125, end: 1", "hht, alpha: -0.1, step: 0.02, end: 1",
                               "moreau_jean, step: 0.02, end: 1"}) {
      test::Walk walk(stack, {{"time", std::string("{scheme: ") + scheme + "}"},
                              {"supports", "[{on: ground, fix: [x, y]}, {on: roof, fix: [x, y]}]"},
                              {"contact.seam.integration", integration},
                              {"contact.seam.interference", "\"0.02*t*sin(pi*x/2)^2\""}});
      EnergyAccount account(walk.model, walk.scheme, walk.state());
      walk.accepted = [&] { account.enter(walk.before, walk.state()); };
      ASSERT_TRUE(walk.to_end()) << integration << ", " << scheme;
      const auto& ledger = account.ledger();
      EXPECT_GT(ledger.support_work, 0) << integration << ", " << scheme;
      EXPECT_NEAR(ledger.balance(), 0, 1e-10 * ledger.largest()) << integration << ", " << scheme;
    }
}

TEST(AGapOfPlaceAndTime, IsRampedAsAFunctionOfTimeWouldBe) {
  test::Walk by_function(stack, {{"contact.seam.gap", "{value: 0.01*x, function: ramp}"}});
  test::Walk by_time(stack, {{"contact.seam.gap", "0.01*x*t"}});
  ASSERT_TRUE(by_function.to_end());
  ASSERT_TRUE(by_time.to_end());
  EXPECT_LE((by_function.state().motion.u - by_time.state().motion.u).norm(), 1e-14);
}

TEST(AGapOfPlace, IsRefusedWhereItIsNoNumber) {
  const auto told = [](const std::string& seam_settings) {
    try {
      test::Walk walk(stack, {{"contact.seam", seam(seam_settings)}});
      walk.to_end();
    } catch (const InputError& error) {
      return error.faults().front().text;
    }
    return std::string();
  };
  EXPECT_EQ(told("gap: 1/x"), "contact.seam.gap: '1/x' is infinite at x = 0, y = 1, z = 0, t = 0, expected a "
                              "finite number");
  EXPECT_EQ(told("gap: 0*sqrt(abs(t-0.5)-1e-9)"),
            "contact.seam.gap: '0*sqrt(abs(t-0.5)-1e-9)' is not a number at x = 0, y = 1, z = 0, t = 0.5, "
            "expected a finite number")
      << "met in the second step";
  EXPECT_EQ(told("interference: x-1").find("contact.seam.interference: found -1 at x = 0, y = 1"), 0U);
  EXPECT_EQ(told("gap: 0"), "");
}

TEST(AnInterferenceOfPlace, BeginsWithZeroWhereVelocitiesJump) {
  try {
    test::Walk walk(stack, {{"time", "{scheme: moreau_jean, step: 0.02, end: 1}"},
                            {"contact.seam.interference", "0.01*x"}});
    ADD_FAILURE() << "an overlap at the start";
  } catch (const InputError& error) {
    EXPECT_NE(
        error.faults().front().text.find("the first instant, but the scheme moreau_jean leaves overlaps "
                                         "of the start as they are, expected 0 there"),
        std::string::npos);
  }
}

} // namespace
} // namespace rubato::step::gap_field_test
