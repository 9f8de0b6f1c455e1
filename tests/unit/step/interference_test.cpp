// SPDX-License-Identifier: LGPL-3.0-or-later
// Interference and gap: what a deck takes from the gaps of the mesh, and what it adds.
#include "rubato/deck/read.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/walk.hpp"
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::interference_test {
namespace {

using deck::Setting;

constexpr double young = 2e5;
constexpr double poisson = 0.3;
constexpr double joint = 20;   ///< radius where the ring sits on the shaft
constexpr double outside = 40; ///< of the ring
constexpr double overlap = 0.05;

/// A slice of a ring on a shaft between planes that do not move. The meshes touch.
const std::string fit = R"(
mesh:
  generate:
    - {name: shaft, rectangle: {from: [0, 0], to: [20, 2]}, divisions: [6, 2], cells: quad8,
       sides: {bottom: ends, top: ends, left: axis, right: shaft_face}}
    - {name: ring, rectangle: {from: [20, 0], to: [40, 2]}, divisions: [8, 3], cells: quad8,
       sides: {bottom: ends, top: ends, left: ring_face}}
physics: axisymmetric
materials: {steel: {young: 2e5, poisson: 0.3}}
functions: {ramp: {times: [0, 2], values: [0, 1]}, fall: {times: [0, 2], values: [1, 0]}}
supports: [{on: ends, fix: y}, {on: axis, fix: x}]
contact: {fit: {master: shaft_face, slave: ring_face, integration: mortar}}
time: {scheme: static, step: 1, end: 2}
)";

/// Lamé's: a ring under pressure inside, a solid shaft under pressure outside, plane strain.
double pressure_of(double interference) {
  const double inner = joint * joint;
  const double outer = outside * outside;
  const double ring = ((1 - 2 * poisson) * inner + outer) / (outer - inner);
  const double shaft = 1 - 2 * poisson;
  return interference * young / ((1 + poisson) * joint * (ring + shaft));
}

void expect_pressure(const test::Walk& walk, double expected, double relative) {
  for (std::size_t i = 0; i < walk.slave_count(); ++i)
    EXPECT_NEAR(walk.state().zones.front().outcomes[i].pressure, expected, relative * pressure_of(overlap));
}

TEST(AnInterference, PressesARingOntoAShaftAsLameSays) {
  test::Walk walk(fit, {{"contact.fit.interference", "0.05"}});
  ASSERT_TRUE(walk.to_end());
  expect_pressure(walk, pressure_of(overlap), 1e-4);
  for (const auto& outcome : walk.state().zones.front().outcomes)
    EXPECT_NEAR(outcome.gap, 0, 1e-13);
}

TEST(AnInterference, GrowsWithItsFunctionAndLeavesTheLedgerClosed) {
  test::Walk walk(fit, {{"contact.fit.interference", "{value: 0.05, function: ramp}"}});
  EnergyAccount account(walk.model, walk.scheme, walk.state());
  walk.accepted = [&] { account.enter(walk.before, walk.state()); };
  ASSERT_TRUE(walk.advance());
  expect_pressure(walk, pressure_of(overlap) / 2, 1e-4);
  ASSERT_TRUE(walk.to_end());
  expect_pressure(walk, pressure_of(overlap), 1e-4);
  const auto& ledger = account.ledger();
  EXPECT_NEAR(ledger.support_work, ledger.strain, 1e-10 * ledger.strain);
  EXPECT_NEAR(ledger.impact, 0, 1e-10 * ledger.strain);
  EXPECT_NEAR(ledger.balance(), 0, 1e-10 * ledger.strain);
}

/// What begins with a part of it: that part is an overlap of the start.
TEST(AnInterference, ThatBeginsWithAPartCountsNothingTwice) {
  test::Walk walk(fit, {{"contact.fit.interference", "{value: 0.05, function: half}"},
                        {"functions.half", "{times: [0, 2], values: [0.5, 1]}"}});
  EnergyAccount account(walk.model, walk.scheme, walk.state());
  walk.accepted = [&] { account.enter(walk.before, walk.state()); };
  ASSERT_TRUE(walk.to_end());
  const auto& ledger = account.ledger();
  EXPECT_GT(ledger.overlap_work, 0.1 * ledger.strain);
  EXPECT_NEAR(ledger.impact, 0, 1e-10 * ledger.strain);
  EXPECT_NEAR(ledger.balance(), 0, 1e-10 * ledger.strain);
}

TEST(AnInterference, IsWhatAMeshThatOverlapsHasByItself) {
  test::Walk walk(fit, {{"mesh.generate.1.rectangle.from", "[19.95, 0]"}});
  ASSERT_TRUE(walk.to_end());
  const double by_mesh = walk.state().zones.front().outcomes[2].pressure;
  EXPECT_NEAR(by_mesh, pressure_of(overlap), 0.01 * by_mesh); // the ring is thicker by its overlap
}

TEST(AGap, TakesAnOverlapOutStepByStep) {
  test::Walk walk(fit, {{"mesh.generate.1.rectangle.from", "[19.95, 0]"},
                        {"contact.fit.gap", "{value: 0.05, function: fall}"}});
  ASSERT_TRUE(walk.advance());
  const double half = walk.state().zones.front().outcomes[2].pressure;
  ASSERT_TRUE(walk.to_end());
  const double whole = walk.state().zones.front().outcomes[2].pressure;
  EXPECT_NEAR(half, whole / 2, 1e-9 * whole);
  EXPECT_NEAR(whole, pressure_of(overlap), 0.01 * whole);
}

TEST(AGap, IsANegativeInterference) {
  test::Walk one(fit, {{"contact.fit.gap", "-0.05"}});
  test::Walk other(fit, {{"contact.fit.interference", "0.05"}});
  ASSERT_TRUE(one.to_end());
  ASSERT_TRUE(other.to_end());
  EXPECT_EQ(one.state().motion.u, other.state().motion.u);
  test::Walk open(fit, {{"contact.fit.gap", "0.01"}});
  ASSERT_TRUE(open.to_end());
  EXPECT_EQ(open.resultants().in_contact, 0);
  EXPECT_NEAR(open.state().zones.front().outcomes[1].gap, 0.01, 1e-12);
}

/// Two equal blocks on one another, pressed by an interference between roof and ground.
const std::string stack = R"(
mesh:
  generate:
    - {name: lower, rectangle: {from: [0, 0], to: [2, 1]}, divisions: [4, 2], sides: {bottom: ground, top: under}}
    - {name: upper, rectangle: {from: [0, 1], to: [2, 2]}, divisions: [4, 2], sides: {top: roof, bottom: over}}
physics: plane_strain
materials: {steel: {young: 100, poisson: 0, density: 1}}
functions: {ramp: {times: [0, 1], values: [0, 1]}}
supports: [{on: ground, fix: [x, y]}, {on: roof, fix: [x, y]}]
contact: {seam: {master: under, slave: over, integration: nodes}}
time: {scheme: static, step: 0.25, end: 1}
)";

/// Strain 0.01 in both.
TEST(AnInterference, PressesByEveryMethodAndWhereverPointsStand) {
  for (const char* zone : {"method: augmented_lagrangian", "method: nodal_lagrange", "method: nodal_pcg",
                           "integration: {gauss: 2}", "integration: mortar", "freeze: true",
                           "integration: mortar, freeze: true", "iterate: {geometry: fixed_point}"}) {
    test::Walk walk(stack, {{"contact.seam", std::string("{master: under, slave: over, interference: {value: "
                                                         "0.02, function: ramp}, ") +
                                                 zone + "}"}});
    ASSERT_TRUE(walk.to_end()) << zone;
    EXPECT_NEAR(walk.resultants().normal, 2.0, 1e-9) << zone;
    EXPECT_NEAR(walk.displacement(walk.node_at(1, 0.5), 1), -0.005, 1e-10) << zone;
  }
}

TEST(AnInterference, PushesBodiesApartInMotionWithoutAHoleInTheLedger) {
  for (const char* scheme : {"hht, alpha: -0.1", "moreau_jean"})
    for (const char* integration : {"nodes", "mortar"}) {
      test::Walk walk(stack, {{"time", std::string("{scheme: ") + scheme + ", step: 0.02, end: 1}"},
                              {"contact.seam.integration", integration},
                              {"contact.seam.interference", "{value: 0.02, function: ramp}"}});
      EnergyAccount account(walk.model, walk.scheme, walk.state());
      walk.accepted = [&] { account.enter(walk.before, walk.state()); };
      ASSERT_TRUE(walk.to_end()) << scheme;
      const auto& ledger = account.ledger();
      EXPECT_GT(ledger.support_work, 0) << scheme << ", " << integration;
      EXPECT_NEAR(ledger.balance(), 0, 1e-10 * ledger.largest()) << scheme << ", " << integration;
    }
}

/// Exact contact of a scheme of forces would ring.
TEST(AnInterference, GivesABodyInMotionJustItsWork) {
  for (const char* integration : {"nodes", "mortar"}) {
    test::Walk walk(stack, {{"time", "{scheme: moreau_jean, step: 0.02, end: 1}"},
                            {"contact.seam.integration", integration},
                            {"contact.seam.interference", "{value: 0.02, function: ramp}"}});
    EnergyAccount account(walk.model, walk.scheme, walk.state());
    walk.accepted = [&] { account.enter(walk.before, walk.state()); };
    ASSERT_TRUE(walk.to_end());
    const auto& ledger = account.ledger();
    EXPECT_NEAR(walk.resultants().normal, 2.0, 0.5) << integration;
    EXPECT_NEAR(ledger.support_work, ledger.stored(), 0.05 * ledger.stored()) << integration;
    EXPECT_NEAR(ledger.impact, 0, 1e-10 * ledger.largest()) << integration;
    for (const auto& outcome : walk.state().zones.front().outcomes)
      EXPECT_NEAR(outcome.gap, 0, 1e-3) << integration;
  }
}

} // namespace
} // namespace rubato::step::interference_test
