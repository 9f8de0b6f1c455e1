// SPDX-License-Identifier: LGPL-3.0-or-later
// A slave surface that is cut into two zones before one master.
#include "rubato/contact/zone.hpp"
#include "rubato/model/model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/walk.hpp"
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace rubato::step::shared_zones_test {
namespace {

using deck::Setting;

/// A block whose sole is cut at x = 0.5, pressed on a plate and pushed sidewards.
std::string plane_deck(const std::string& cells, const std::string& zones) {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: block, rectangle: {{from: [0, 0], to: [1, 1]}}, divisions: [4, 2], cells: {0}, sides: {{bottom: sole, top: roof}}}}
    - {{name: plate, rectangle: {{from: [-0.5, -0.5], to: [1.5, 0]}}, divisions: [6, 2], cells: {0}, sides: {{top: ground, bottom: base}}}}
  groups:
    left: {{box: {{from: [-1, -1], to: [0.5, 2]}}, of: sole, take: faces}}
    right: {{box: {{from: [0.5, -1], to: [2, 2]}}, of: sole, take: faces}}
physics: plane_strain
materials: {{steel: {{young: 1000, poisson: 0.3}}}}
supports: [{{on: base, fix: [x, y]}}, {{on: roof, fix: x, y: -0.01}}]
contact: {1}
time: {{scheme: static, step: 1, end: 1}}
)",
                     cells, zones);
}

std::string solid_deck(const std::string& cells, const std::string& zones) {
  return fmt::format(R"(
mesh:
  generate:
    - {{name: block, box: {{from: [0, 0, 0], to: [1, 1, 1]}}, divisions: [2, 1, 2], cells: {0}, sides: {{bottom: sole, top: roof}}}}
    - {{name: plate, box: {{from: [-0.5, -0.5, -0.5], to: [1.5, 0, 1.5]}}, divisions: [4, 1, 4], cells: {0}, sides: {{top: ground, bottom: base}}}}
  groups:
    left: {{box: {{from: [-1, -1, -1], to: [0.5, 2, 2]}}, of: sole, take: faces}}
    right: {{box: {{from: [0.5, -1, -1], to: [2, 2, 2]}}, of: sole, take: faces}}
physics: solid
materials: {{steel: {{young: 1000, poisson: 0.3}}}}
supports: [{{on: base, fix: [x, y, z]}}, {{on: roof, fix: [x, z], y: -0.01}}]
contact: {1}
time: {{scheme: static, step: 1, end: 1}}
)",
                     cells, zones);
}

std::string one_zone(const std::string& rest) {
  return "{sole: {master: ground, slave: sole, integration: nodes" + rest + "}}";
}
std::string two_zones(const std::string& left, const std::string& right) {
  return "{left: {master: ground, slave: left, integration: nodes" + left +
         "}, right: {master: ground, slave: right, integration: nodes" + right + "}}";
}

/// Compares what the nodes of two zones report with the one zone of the whole sole.
void expect_same(const test::Walk& cut, const test::Walk& whole, const std::string& what) {
  const auto& points = whole.model.zones.front().points;
  std::size_t shared = 0;
  for (std::size_t z = 0; z < 2; ++z) {
    const auto& zone = cut.model.zones[z];
    const auto& state = cut.state().zones[z];
    double normal = 0;
    for (const auto& outcome : state.outcomes)
      normal += outcome.pressure * outcome.area;
    EXPECT_NEAR(cut.resultants(z).normal, normal, 1e-12 * normal) << what;
    for (std::size_t i = 0; i < zone.points.size(); ++i) {
      const auto node = zone.slave.nodes[static_cast<std::size_t>(zone.points[i].node_position)];
      const auto at = static_cast<std::size_t>(
          std::ranges::find_if(points, [&](const auto& point) { return point.nodes.front() == node; }) -
          points.begin());
      const auto& expected = whole.state().zones.front();
      EXPECT_NEAR(state.outcomes[i].pressure, expected.outcomes[at].pressure, 1e-8) << what << node;
      EXPECT_EQ(state.status[i], expected.status[at]) << what << node;
      EXPECT_NEAR(state.outcomes[i].gap, expected.outcomes[at].gap, 1e-9) << what << node;
      shared += zone.points[i].excluded ? 1 : 0;
    }
  }
  EXPECT_GT(shared, 0U) << what;
  const auto left = cut.resultants(0), right = cut.resultants(1), all = whole.resultants();
  EXPECT_NEAR(left.normal + right.normal, all.normal, 1e-8 * all.normal) << what;
  EXPECT_LT((left.force + right.force - all.force).norm(), 1e-8 * all.normal) << what;
}

TEST(ZonesOfOneSurface, ReportThePressureOfSharedNodesInBoth) {
  for (const char* method : {"augmented_lagrangian", "nodal_lagrange"})
    for (const char* solver : {"auto", "full"}) {
      const std::string rest = std::string(", method: ") + method;
      for (const char* cells : {"quad4", "quad8", "tria3", "tria6"}) {
        test::Walk cut(plane_deck(cells, two_zones(rest, rest)), {{"solver", solver}});
        test::Walk whole(plane_deck(cells, one_zone(rest)), {{"solver", solver}});
        ASSERT_TRUE(cut.to_end() && whole.to_end());
        expect_same(cut, whole, fmt::format("{} {} {} ", method, solver, cells));
      }
      for (const char* cells : {"hexa8", "hexa27"}) {
        test::Walk cut(solid_deck(cells, two_zones(rest, rest)), {{"solver", solver}});
        test::Walk whole(solid_deck(cells, one_zone(rest)), {{"solver", solver}});
        ASSERT_TRUE(cut.to_end() && whole.to_end());
        expect_same(cut, whole, fmt::format("{} {} {} ", method, solver, cells));
      }
    }
}

TEST(ZonesOfOneSurface, HaveFrictionAsOneZone) {
  for (const char* friction : {", friction: 0.05", ", friction: 0.6"}) {
    const std::vector<Setting> pushed{
        {"supports", "[{on: base, fix: [x, y]}, {on: roof, x: {value: 0.003, function: ramp}, y: -0.01}]"},
        {"functions", "{ramp: {times: [0, 1], values: [0, 1]}}"},
        {"time", "{scheme: static, step: 0.25, end: 1}"}};
    test::Walk cut(plane_deck("quad4", two_zones(friction, friction)), pushed);
    test::Walk whole(plane_deck("quad4", one_zone(friction)), pushed);
    ASSERT_TRUE(cut.to_end() && whole.to_end());
    const auto all = whole.resultants();
    EXPECT_LT((cut.resultants(0).force + cut.resultants(1).force - all.force).norm(), 1e-7 * all.normal);
    const auto sum = [](const test::Walk& walk) {
      double work = 0;
      for (const auto& zone : walk.state().zones)
        for (const auto& history : zone.friction_history)
          work += history.work;
      return work;
    };
    EXPECT_NEAR(sum(cut), sum(whole), 1e-7 * all.normal * 0.003);
  }
}

/// The shared node slides at the mean coefficient by area.
TEST(ZonesOfOneSurface, MixTheirCoefficientsOfFriction) {
  test::Walk cut(plane_deck("quad4", two_zones("", ", friction: 0.1")),
                 {{"supports", "[{on: base, fix: [x, y]}, {on: roof, x: 0.02, y: -0.01}]"}});
  ASSERT_TRUE(cut.to_end());
  for (std::size_t z = 0; z < 2; ++z) {
    const auto& zone = cut.model.zones[z];
    for (std::size_t i = 0; i < zone.points.size(); ++i) {
      const auto& outcome = cut.state().zones[z].outcomes[i];
      const bool shared = std::abs(zone.points[i].place[0] - 0.5) < 1e-9;
      const double expected = shared ? 0.05 : z == 0 ? 0 : 0.1;
      EXPECT_NEAR(outcome.tangential.norm(), expected * outcome.normal.norm(), 1e-6) << z << " " << i;
    }
  }
}

TEST(ZonesOfOneSurface, StayApartWhereTheirConstraintsDiffer) {
  for (const char* rest : {", gap: 0.001", ", bilateral: true"}) {
    const auto model = test::model_of(plane_deck("quad4", two_zones("", rest)));
    for (const auto& zone : model.zones)
      for (const auto& point : zone.points) {
        EXPECT_FALSE(point.excluded) << rest;
        EXPECT_TRUE(point.shares.empty()) << rest;
      }
  }
}

} // namespace
} // namespace rubato::step::shared_zones_test
