// SPDX-License-Identifier: LGPL-3.0-or-later
// Mortar contact where gaps open within a face and where masters lie behind one another: nothing presses
// before it touches.
#include "rubato/contact/zone.hpp"
#include "rubato/deck/read.hpp"

#include <gtest/gtest.h>

#include "support/model_parts.hpp"
#include "support/walk.hpp"
#include <string>
#include <vector>

namespace rubato::step::open_gaps_test {
namespace {

/// A plate on weak springs lies on two blocks, the right one of which is lower; its faces end nowhere at the
/// step.
std::string plate_over_a_step(const std::string& cells) {
  return R"(
mesh:
  generate:
    - {name: high, rectangle: {from: [0, -5], to: [5, 0]}, divisions: [5, 5], cells: )" +
         cells + R"(, sides: {top: high_top, bottom: high_bottom}}
    - {name: low, rectangle: {from: [5, -5], to: [10, -0.5]}, divisions: [5, 5], cells: )" +
         cells + R"(, sides: {top: low_top, bottom: low_bottom}}
    - {name: plate, rectangle: {from: [0, 0], to: [10, 2]}, divisions: [13, 2], cells: )" +
         cells + R"(, sides: {bottom: under, top: above, left: left}}
physics: plane_strain
materials: {steel: {young: 210000, poisson: 0.3}}
supports: [{on: high_bottom, fix: [x, y]}, {on: low_bottom, fix: [x, y]}, {on: left, fix: x}]
springs: [{on: above, y: 1000}]
contact: {c: {all: true}}
loads: [{pressure: {on: above, value: 0}}]
time: {scheme: static, step: 1, end: 1}
)";
}

std::size_t zone_of_plate(const test::ModelParts& model) {
  for (std::size_t z = 0; z < model.zones.size(); ++z)
    if (model.zones[z].settings.name == "c_plate")
      return z;
  return model.zones.size();
}

class PlateOverAStep : public testing::TestWithParam<const char*> {};

TEST_P(PlateOverAStep, LiesStillWithoutLoad) {
  test::Walk walk(plate_over_a_step(GetParam()));
  ASSERT_TRUE(walk.to_end());
  EXPECT_LT(walk.state().motion.u.cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT(walk.resultants(zone_of_plate(walk.model)).normal, 1e-9);
}

/// What the plate presses, and what the lower block's bottom bears.
struct Borne {
  double normal = 0, by_lower = 0;
};

Borne borne(const std::string& deck, const std::vector<deck::Setting>& changes) {
  test::Walk walk(deck, changes);
  EXPECT_TRUE(walk.to_end());
  Borne borne{.normal = walk.resultants(zone_of_plate(walk.model)).normal};
  for (const auto node : walk.model.dofs.nodes) {
    const auto& x = walk.model.mesh.points[static_cast<std::size_t>(node)];
    if (x.y() == -5 && x.x() > 5)
      borne.by_lower += walk.state().reaction[walk.model.dofs.dof(node, 1)];
  }
  return borne;
}

TEST_P(PlateOverAStep, PressesTheBlocksAsOnNodes) {
  auto deck = plate_over_a_step(GetParam());
  deck.replace(deck.find("value: 0}"), 8, "value: \"if(x<4, 100, 0)\"");
  const auto by_mortar = borne(deck, {}), on_nodes = borne(deck, {{"contact.c.integration", "nodes"}});
  EXPECT_NEAR(by_mortar.normal, on_nodes.normal, 0.01 * on_nodes.normal);
  EXPECT_NEAR(by_mortar.by_lower, on_nodes.by_lower, 0.005 * on_nodes.normal);
}

INSTANTIATE_TEST_SUITE_P(Of, PlateOverAStep, testing::Values("quad4", "tria3", "quad8", "tria6"));

/// Three plates on one another, thinner than their faces are long; 100 go through them.
TEST(PlatesInOneZone, PressTheNextOneOnly) {
  for (const std::string integration : {"mortar", "nodes"}) {
    test::Walk walk(R"(
mesh:
  generate:
    - {name: a, rectangle: {from: [0, 0], to: [40, 4]}, divisions: [12, 2], sides: {top: a_top, bottom: ground, left: al}}
    - {name: b, rectangle: {from: [0, 4], to: [40, 5]}, divisions: [10, 1], sides: {top: b_top, bottom: b_bottom, left: bl}}
    - {name: c, rectangle: {from: [0, 5], to: [40, 12]}, divisions: [9, 2], sides: {top: c_top, bottom: c_bottom, left: cl}}
physics: plane_strain
materials: {steel: {young: 210000, poisson: 0}}
supports: [{on: ground, fix: y}, {on: al, fix: x}, {on: bl, fix: x}, {on: cl, fix: x}]
loads: [{pressure: {on: c_top, value: 100}}]
contact: {k: {all: true}}
time: {scheme: static, step: 1, end: 1}
)",
                    {{"contact.k.integration", integration}});
    ASSERT_TRUE(walk.to_end());
    const double exact = -12 * 100. / 210000, tolerance = integration == "mortar" ? 1e-9 : 0.05;
    EXPECT_NEAR(walk.displacement(walk.node_at(0, 12), 1), exact, tolerance * std::abs(exact)) << integration;
  }
}

} // namespace
} // namespace rubato::step::open_gaps_test
