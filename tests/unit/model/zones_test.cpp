// SPDX-License-Identifier: LGPL-3.0-or-later
// The zones of a study: surfaces by their names, sheets turned to the slave, what supports hold.
#include "rubato/contact/surface.hpp"
#include "rubato/contact/zone.hpp"
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/sheet.hpp"
#include "rubato/model/build.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"

#include <gtest/gtest.h>

#include "studies.hpp"
#include "support/faults.hpp"
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <vector>

namespace rubato::model::zones_test {
namespace {

using mesh::NodeIndex;
using test::fault_of;
using test::located_model;
using test::with;

/// Places along x of the nodes of a surface.
std::set<double> along_x(const Model& model, const contact::Surface& surface) {
  std::set<double> found;
  for (const auto node : surface.nodes)
    found.insert(model.mesh.points[static_cast<std::size_t>(node)].x());
  return found;
}

TEST(AZone, HasTheFacesOfTheGroupsThatItNames) {
  const auto model = located_model(test::two_blocks);
  ASSERT_EQ(model.zones.size(), 1U);
  const auto& zone = model.zones.front();
  EXPECT_EQ(zone.settings.name, "interface");
  EXPECT_EQ(zone.master.faces.size(), 4U);
  EXPECT_EQ(zone.slave.faces.size(), 4U);
  EXPECT_EQ(along_x(model, zone.slave), (std::set{0.0, 0.25, 0.5, 0.75, 1.0}));
  EXPECT_TRUE(zone.choice.empty());
  EXPECT_FALSE(zone.obstacle);
}

TEST(AZone, HasTheFrictionOfEachPoint) {
  EXPECT_TRUE(located_model(test::two_blocks).zones.front().friction_shares.empty());
  const auto model = located_model(with(test::two_blocks, "friction: 0.2", "friction: 0.1+0.2*x"));
  const auto& zone = model.zones.front();
  ASSERT_EQ(zone.friction_shares.size(), zone.points.size());
  for (std::size_t i = 0; i < zone.points.size(); ++i)
    EXPECT_DOUBLE_EQ(zone.friction_at(i, 0.5), 0.5 * (0.1 + 0.2 * zone.points[i].place.x()));
  EXPECT_EQ(
      fault_of([] { located_model(with(test::two_blocks, "friction: 0.2", "friction: 0.5-x")); }),
      "deck.yaml:22:84: contact.interface.friction: found -0.25 at x = 0.75, y = 0, z = 0, t = 0, expected a "
      "number >= 0");
}

TEST(AZone, KnowsWhatSupportsHoldOfItsSlaveNodes) {
  const auto deck = with(test::two_blocks, "  - {on: held, fix: [x, y]}",
                         "  - {on: held, fix: [x, y]}\n  - {on: lower_face, fix: y}");
  const auto model = located_model(deck);
  const auto& zone = model.zones.front();
  ASSERT_EQ(zone.held.size(), zone.slave.nodes.size());
  for (std::size_t i = 0; i < zone.held.size(); ++i) {
    const bool is_left = model.mesh.points[static_cast<std::size_t>(zone.slave.nodes[i])].x() == 0;
    EXPECT_EQ(zone.held[i], is_left ? 3 : 2) << "bits of x and y";
  }
}

TEST(AZone, LeavesOutTheNodesOfAllGroupsThatItIsTold) {
  const auto deck = with(with(test::two_blocks, "sides: {left: held, top: lower_face}",
                              "sides: {left: held, top: lower_face}\n      points: {right_top: lower_end}"),
                         "exclude_nodes: [held]", "exclude_nodes: [held, lower_end]");
  const auto model = located_model(deck);
  std::set<double> excluded;
  for (const auto& point : model.zones.front().points)
    if (point.excluded)
      excluded.insert(model.mesh.points[static_cast<std::size_t>(point.nodes.front())].x());
  EXPECT_EQ(excluded, (std::set{0.0, 1.0}));
}

TEST(AZone, HasItsGapAndTheFirstInstantOfTheRun) {
  auto deck = with(test::two_blocks, "friction: 0.2,", "friction: 0.2, gap: 0.03,");
  deck = with(deck, "step: 1e-4, end: 4e-4", "begin: 1, step: 1e-4, end: 1.0004");
  const auto model = located_model(deck);
  const auto& zone = model.zones.front();
  EXPECT_EQ(zone.begin, 1);
  EXPECT_EQ(zone.offset.at(Eigen::Vector3d::Zero(), 1), 0.03);
}

TEST(Zones, StandInTheOrderOfTheStudyEachWithItsMultipliersBehindThoseBefore) {
  const auto deck = with(test::two_blocks, "exclude_nodes: [held]}",
                         "exclude_nodes: [held]}\n  ground: {slave: roof, obstacle: {plane: {point: [0, 5], "
                         "normal: [0, -1]}}}");
  const auto model = located_model(deck);
  ASSERT_EQ(model.zones.size(), 2U);
  EXPECT_EQ(model.zones[0].settings.name, "interface");
  EXPECT_EQ(model.zones[1].settings.name, "ground");
  EXPECT_TRUE(model.zones[1].obstacle);
  EXPECT_TRUE(model.zones[1].master.faces.empty());
  EXPECT_EQ(model.multiplier_offsets, (std::vector{0, model.zones[0].multiplier_count()}));
}

TEST(Zones, TellTheFaultsOfAllOfThem) {
  const auto fault = fault_of([] {
    located_model(with(test::two_blocks, "exclude_nodes: [held]}",
                       "exclude_nodes: [held, nobody]}\n  one: {master: nothing, slave: roof}\n"
                       "  two: {master: upper_face, slave: nowhere}"));
  });
  for (const auto* name : {"'nobody'", "'nothing'", "'nowhere'"})
    EXPECT_NE(fault.find(name), std::string::npos) << fault;
}

/// The blocks' mesh, and between them loose segments from place to place, in the group "table".
mesh::Mesh with_segments(const study::Study& study,
                         const std::vector<std::array<Eigen::Vector3d, 2>>& segments) {
  const auto bodies = load_mesh(study.mesh);
  mesh::MeshBuilder builder(bodies.dimension);
  builder.append(bodies);
  std::vector<mesh::MeshBuilder::CellHandle> cells;
  for (const auto& [from, to] : segments)
    cells.push_back(
        builder.add_cell(CellType::seg2, std::array{builder.add_node(from), builder.add_node(to)}));
  builder.add_to_cell_group("table", cells);
  return std::move(builder).build();
}

/// The upper block alone has contact, with the table.
study::Study on_table(const std::string& slave) {
  return test::study_of(with(
      with(test::two_blocks, "  - {on: held, fix: [x, y]}",
           "  - {on: held, fix: [x, y]}\n  - {on: table, fix: [x, y]}"),
      "{master: upper_face, slave: lower_face, integration: nodes, friction: 0.2, exclude_nodes: [held]}",
      "{master: table, slave: " + slave + "}"));
}

/// The normals of the master's faces, 2D: (t_y, −t_x).
std::vector<double> heights_of_normals(const Model& model) {
  std::vector<double> heights;
  for (const auto& face : model.zones.front().master.faces) {
    const auto at = [&](std::size_t i) { return model.mesh.points[static_cast<std::size_t>(face.nodes[i])]; };
    heights.push_back(-(at(1) - at(0)).normalized().x());
  }
  return heights;
}

TEST(ASheet, LooksAtTheSlaveHoweverItIsNumbered) {
  const std::vector<std::array<Eigen::Vector3d, 2>> segments{{{{0, -0.5, 0}, {0.5, -0.5, 0}}},
                                                             {{{1, -0.6, 0}, {0.5, -0.6, 0}}}};
  const auto study = on_table("upper_face");
  EXPECT_EQ(heights_of_normals(build_model(study, with_segments(study, segments))), (std::vector{1.0, 1.0}))
      << "from below";
  const auto above = on_table("roof");
  const std::vector<std::array<Eigen::Vector3d, 2>> higher{{{{0, 0.5, 0}, {0.5, 0.5, 0}}},
                                                           {{{1, 0.6, 0}, {0.5, 0.6, 0}}}};
  EXPECT_EQ(heights_of_normals(build_model(above, with_segments(above, higher))), (std::vector{-1.0, -1.0}))
      << "from above";
}

TEST(RigidFaces, AreThoseOfMastersThatBelongToNoBody) {
  const std::vector<std::array<Eigen::Vector3d, 2>> segments{{{{0, -0.5, 0}, {0.5, -0.5, 0}}},
                                                             {{{1, -0.6, 0}, {0.5, -0.6, 0}}}};
  auto study = on_table("upper_face");
  const auto mesh = with_segments(study, segments);
  const auto* table = mesh.cell_group("table");
  ASSERT_NE(table, nullptr);
  EXPECT_EQ(rigid_faces(study, mesh), table->items);
  study.contact[0].between = {"roof", "table"};
  study.contact[0].master.clear();
  EXPECT_EQ(rigid_faces(study, mesh), table->items) << "either of two may be the master";
  study.contact[0].between.clear();
  study.contact[0].self = "table";
  EXPECT_TRUE(rigid_faces(study, mesh).empty());
  study.contact[0].self.clear();
  study.contact[0].master = "lower_face";
  EXPECT_TRUE(rigid_faces(study, mesh).empty()) << "a side of a body";
}

} // namespace
} // namespace rubato::model::zones_test
