// SPDX-License-Identifier: LGPL-3.0-or-later
// A ring shrunk onto another one, by springs: nodes of both sides stand on each other, each in a valley
// between two faces of the master.
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/step/energy.hpp"

#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::step::shrink_fit_test {
namespace {

using deck::Setting;

/// Quarters of two rings, unrolled: x is the part of the quarter, y the radius.
const std::string rings = R"(
mesh:
  generate:
    - {name: inner, rectangle: {from: [0, 20], to: [1, 40.005]}, divisions: [10, 4], cells: quad4,
       sides: {left: upright, right: level, top: inner_face}}
    - {name: outer, rectangle: {from: [0, 40], to: [1, 60]}, divisions: [10, 4], cells: quad4,
       sides: {left: upright, right: level, bottom: outer_face}}
physics: plane_strain
materials: {steel: {young: 2e5, poisson: 0.3}}
supports: [{on: upright, fix: x}, {on: level, fix: y}]
contact: {fit: {master: outer_face, slave: inner_face, method: nodal_penalty}}
time: {scheme: static, step: 1, end: 1}
)";

test::BuiltModel rolled_up(const std::vector<Setting>& changes, double size) {
  const auto study = deck::parse_deck(rings, "deck.yaml", changes).runs.front();
  auto mesh = model::load_mesh(study.mesh);
  for (auto& point : mesh.points) {
    const double angle = std::numbers::pi / 2 * (1 - point[0]);
    const double radius = size * point[1];
    point = {radius * std::cos(angle), radius * std::sin(angle), 0};
    if (std::abs(point[0]) < 1e-12 * radius)
      point[0] = 0;
  }
  return test::BuiltModel(study, std::move(mesh));
}

double force_of(const std::vector<Setting>& changes, double size = 1) {
  test::Walk walk(rolled_up(changes, size));
  EXPECT_TRUE(walk.to_end());
  EXPECT_EQ(walk.reports.size(), 1u) << "the step was cut";
  EXPECT_EQ(walk.resultants().in_contact, 11);
  return walk.resultants().normal / size;
}

TEST(AShrinkFit, SettlesByNodalSpringsOfAnySize) {
  for (const char* cells : {"quad4", "tria3"})
    for (const char* friction : {"0", "0.2"})
      for (const double size : {1.0, 1000.0}) {
        const std::vector<Setting> deck{{"mesh.generate.0.cells", cells},
                                        {"mesh.generate.1.cells", cells},
                                        {"contact.fit.friction", friction}};
        const double force = force_of(deck, size);
        EXPECT_GT(force, 0) << cells << ", friction " << friction << ", size " << size;
        EXPECT_NEAR(force, force_of(deck), 1e-6 * force) << cells << ", friction " << friction;
      }
}

/// Forces of such springs follow the last digits of places: there the residual can go no lower.
TEST(AShrinkFit, ComesToTheExactForceByStiffNodalSprings) {
  const double exact = force_of({{"contact.fit.method", "nodal_lagrange"}});
  for (const auto& [normal, tolerance] : {std::pair{"1e8", 1e-2}, {"1e10", 1e-4}, {"1e11", 1e-4}})
    EXPECT_NEAR(force_of({{"contact.fit.coefficients.normal", normal}}), exact, tolerance * exact) << normal;
}

TEST(AShrinkFit, KeepsStillInStepsWithoutLoads) {
  for (const char* method : {"nodal_penalty", "nodal_lagrange", "nodal_pcg"}) {
    test::Walk walk(rolled_up({{"contact.fit.method", method}, {"time.end", "3"}}, 1));
    ASSERT_TRUE(walk.to_end()) << method;
    EXPECT_EQ(walk.reports.size(), 3u) << method;
  }
}

/// Such a node slips on either face towards the other one: springs that only push it back over and over pass
/// the slips that stick.
TEST(AShrinkFit, SettlesByPenaltiesWithFrictionHoweverDeep) {
  for (const char* radius : {"40.0628", "40.5", "42.5"}) // 1, 8 and 40 % of a face
    for (const char* friction : {"0.2", "1"}) {
      test::Walk walk(rolled_up({{"mesh.generate.0.rectangle.to", "[1, " + std::string(radius) + "]"},
                                 {"contact.fit.method", "penalty"},
                                 {"contact.fit.friction_method", "penalty"},
                                 {"contact.fit.friction", friction}},
                                1));
      ASSERT_TRUE(walk.to_end()) << radius << ", friction " << friction;
      EXPECT_EQ(walk.reports.size(), 1u) << radius << ", friction " << friction;
      EXPECT_LE(walk.reports.front().iterations, 30) << radius << ", friction " << friction;
      EXPECT_EQ(walk.resultants().in_contact, 11);
    }
}

/// Overlaps are measured along the normals that close them, between two faces too: nothing is gained.
TEST(AShrinkFit, GainsNothingInTheLedger) {
  for (const char* divisions : {"[5, 4]", "[10, 4]"})
    for (const char* method :
         {"augmented_lagrangian", "penalty", "nodal_lagrange", "nodal_penalty", "nodal_pcg"})
      for (const char* friction : {"0", "0.2"}) {
        if (std::string(method) == "nodal_pcg" && std::string(friction) != "0")
          continue;
        test::Walk walk(rolled_up({{"mesh.generate.0.divisions", divisions},
                                   {"mesh.generate.1.divisions", divisions},
                                   {"contact.fit.method", method},
                                   {"contact.fit.friction", friction}},
                                  1));
        EnergyAccount account(walk.model, walk.scheme, walk.state());
        walk.accepted = [&] { account.enter(walk.before, walk.state()); };
        ASSERT_TRUE(walk.to_end()) << method;
        const auto& ledger = account.ledger();
        EXPECT_GT(ledger.overlap_work, 0.9 * ledger.stored()) << method;
        EXPECT_NEAR(ledger.impact, 0, 1e-10 * ledger.largest()) << method << ", friction " << friction;
        EXPECT_NEAR(ledger.balance(), 0, 1e-10 * ledger.largest()) << method << ", friction " << friction;
      }
}

} // namespace
} // namespace rubato::step::shrink_fit_test
