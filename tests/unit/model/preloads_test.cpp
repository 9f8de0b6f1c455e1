// SPDX-License-Identifier: LGPL-3.0-or-later
// What becomes of a mesh that preloads cut.
#include "rubato/deck/read.hpp"
#include "rubato/model/build_model.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/preloads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace rubato::model::preloads_test {
namespace {

/// A bar of four cells one above another, cut in the middle, with its left side and its points as groups.
study::Study bar(const std::string& cells) {
  return deck::parse_deck(R"(mesh:
  generate: [{name: bar, rectangle: {from: [0, 0], to: [1, 4]}, divisions: [1, 4], cells: quad8, sides: {left: flank, bottom: ground}}]
  groups: {middle: {nodes_of: flank}}
physics: plane_stress
materials: {any: {young: 1, poisson: 0}}
supports: [{on: ground, fix: [x, y]}]
preload: {b: {cut: {point: [0, 2.2], normal: [0, 1])" +
                              cells +
                              R"(}, force: 1}}
time: {scheme: static, step: 1, end: 1}
)",
                          "deck.yaml")
      .runs.front();
}

TEST(PreloadedMesh, HasTwinsForTheCellsInFront) {
  const auto study = bar(", cells: bar");
  auto mesh = load_mesh(study.mesh);
  const auto before = mesh.node_count();
  std::vector<Fault> faults;
  const auto cuts = split_at_preloads(study, mesh, faults);
  ASSERT_TRUE(faults.empty());
  ASSERT_EQ(cuts.size(), 1U);
  ASSERT_EQ(cuts[0].pairs.size(), 3U);
  EXPECT_EQ(mesh.node_count(), before + 3);
  EXPECT_EQ(std::set(mesh.node_numbers.begin(), mesh.node_numbers.end()).size(), mesh.points.size());
  for (const auto& [behind, in_front] : cuts[0].pairs) {
    EXPECT_EQ(mesh.points[static_cast<std::size_t>(behind)], mesh.points[static_cast<std::size_t>(in_front)]);
    EXPECT_EQ(mesh.points[static_cast<std::size_t>(behind)][1], 2);
  }
  const auto behind = nodes_behind(mesh, cuts);
  EXPECT_EQ(behind[static_cast<std::size_t>(cuts[0].pairs[1].in_front)], cuts[0].pairs[1].behind);
  EXPECT_EQ(behind[0], 0);
}

/// Cells above the plane have twins, cells below have none; so have the edges of the flank.
TEST(PreloadedMesh, LeavesEveryCellTheNodesOfItsSide) {
  const auto study = bar("");
  auto mesh = load_mesh(study.mesh);
  const auto nodes_in_group = mesh.node_group("middle")->items;
  std::vector<Fault> faults;
  const auto cuts = split_at_preloads(study, mesh, faults);
  std::set<mesh::NodeIndex> twins;
  std::set<mesh::NodeIndex> others;
  for (const auto& pair : cuts.at(0).pairs) {
    others.insert(pair.behind);
    twins.insert(pair.in_front);
  }
  int with_twins = 0;
  mesh::for_each_cell(mesh, [&](mesh::CellIndex, const auto&, std::span<const mesh::NodeIndex> nodes) {
    double height = 0;
    for (const auto node : nodes)
      height += mesh.points[static_cast<std::size_t>(node)][1] / static_cast<double>(nodes.size());
    for (const auto node : nodes) {
      EXPECT_FALSE(height < 2 && twins.contains(node));
      EXPECT_FALSE(height > 2 && others.contains(node));
      with_twins += twins.contains(node) ? 1 : 0;
    }
  });
  EXPECT_EQ(with_twins, 3 + 1); // the cell above, and its edge on the flank
  EXPECT_EQ(mesh.node_group("middle")->items, nodes_in_group);
}

/// The left column of a bar of two.
TEST(PreloadedMesh, IsRefusedWhereOtherCellsHoldTheCut) {
  auto study = bar(", cells: part");
  study.mesh.bodies.at(0).divisions = {2, 4, 1};
  auto mesh = load_mesh(study.mesh);
  mesh::Group part{"part", {}};
  for (const auto cell : mesh.cell_group("bar")->items)
    if (mesh.points[static_cast<std::size_t>(mesh.nodes_of(cell)[0])][0] < 0.25)
      part.items.push_back(cell);
  mesh.cell_groups.push_back(part);
  std::vector<Fault> faults;
  EXPECT_TRUE(split_at_preloads(study, mesh, faults).at(0).pairs.empty());
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_NE(faults[0].text.find("is also one of cells that are not in 'part'"), std::string::npos)
      << faults[0].text;
}

} // namespace
} // namespace rubato::model::preloads_test
