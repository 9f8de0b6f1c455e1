// SPDX-License-Identifier: LGPL-3.0-or-later
// Edges of surfaces in mortar contact are told before the first step.
#include "rubato/deck/read.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/mortar_edges.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/model_of.hpp"
#include "support/two_blocks.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace rubato::model::mortar_edges_test {
namespace {

using test::model_of;

const std::vector<deck::Setting> by_mortar{{"contact.interface.integration", "mortar"}};

/// The slave's right half turned up by that many degrees.
mesh::Mesh with_kink(const model::Model& model, double degrees) {
  auto mesh = model.mesh;
  for (const auto node : model.zones.front().slave.nodes) {
    auto& x = mesh.points[static_cast<std::size_t>(node)];
    x.y() += std::max(0., x.x() - 0.5) * std::tan(degrees * std::numbers::pi / 180);
  }
  return mesh;
}

TEST(EdgesInMortarZones, OfTheSlaveAreToldWithTheirAngleAndNode) {
  const auto model = model_of(test::two_blocks, by_mortar);
  EXPECT_TRUE(model.notes.empty());
  for (const double degrees : {16., 45., 59.}) {
    const auto notes = edges_in_mortar_zones(model.zones, with_kink(model, degrees));
    ASSERT_EQ(notes.size(), 1U) << degrees;
    EXPECT_NE(notes.front().find(fmt::format("contact zone interface: the slave 'lower_face' has an edge of "
                                             "{:.0f}° at N",
                                             degrees)),
              std::string::npos)
        << notes.front();
    EXPECT_NE(notes.front().find("'integration: nodes'"), std::string::npos) << notes.front();
  }
}

TEST(EdgesInMortarZones, AreOfNoConcernWhereTheyAreFlatOrSplit) {
  const auto model = model_of(test::two_blocks, by_mortar);
  for (const double degrees : {14., 61., 80.})
    EXPECT_TRUE(edges_in_mortar_zones(model.zones, with_kink(model, degrees)).empty()) << degrees;
}

TEST(EdgesInMortarZones, AreOfNoConcernOnNodesOrWithFrozenGeometry) {
  const auto on_nodes = model_of(test::two_blocks);
  EXPECT_TRUE(edges_in_mortar_zones(on_nodes.zones, with_kink(on_nodes, 45)).empty());
  auto settings = by_mortar;
  settings.push_back({"contact.interface.freeze", "true"});
  const auto frozen = model_of(test::two_blocks, settings);
  EXPECT_TRUE(edges_in_mortar_zones(frozen.zones, with_kink(frozen, 45)).empty());
}

TEST(EdgesInMortarZones, MayBeInTheMaster) {
  const std::string deck = R"(
mesh:
  generate:
    - {name: low, box: {from: [0, 0, 0], to: [1, 1, 1]}, divisions: [2, 2, 2], cells: hexa20, sides: {front: ground, back: roof, right: roof}}
    - {name: high, box: {from: [0, 0, 1], to: [1, 1, 2]}, divisions: [3, 3, 2], cells: tetra10, sides: {front: under, back: top}}
physics: solid
materials: {rubber: {young: 2e6, poisson: 0, density: 1000}}
supports: [{on: ground, fix: [x, y, z]}, {on: top, fix: [x, y], z: -0.01}]
contact: {joint: {master: roof, slave: under}}
time: {scheme: static, step: 1, end: 1}
)";
  EXPECT_TRUE(model_of(deck).notes.empty());
}

} // namespace
} // namespace rubato::model::mortar_edges_test
