// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/builder.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace rubato::mesh::builder_test {
namespace {

using Numbers = std::vector<std::int64_t>;
using Names = std::vector<std::string>;

/// Four corners of a square, numbers and names as given.
MeshBuilder square(const std::array<std::int64_t, 4>& numbers = {},
                   const std::array<const char*, 4>& names = {"", "", "", ""}) {
  MeshBuilder builder(2);
  const std::array<Eigen::Vector3d, 4> corners{Eigen::Vector3d(0, 0, 0), {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (std::size_t i = 0; i < 4; ++i)
    builder.add_node(corners[i], numbers[i], names[i]);
  return builder;
}

TEST(MeshBuilder, NumbersWhatHasNoNumberAfterTheLargest) {
  const auto mesh = square({7, 0, 2, 0}).build();
  EXPECT_EQ(mesh.node_numbers, (Numbers{7, 8, 2, 9}));
  EXPECT_TRUE(mesh.node_names.empty()) << "nobody gave names";
}

TEST(MeshBuilder, NamesWhatHasNoNameByItsNumberOnceOneHasAName) {
  const auto mesh = square({3, 4, 5, 6}, {"", "tip", "", "N3"}).build();
  ASSERT_EQ(mesh.node_names.size(), 4U);
  EXPECT_EQ(mesh.node_names[1], "tip");
  EXPECT_EQ(mesh.node_names[2], "N5");
  EXPECT_EQ(mesh.node_names[3], "N3");
  EXPECT_NE(mesh.node_names[0], "N3") << "the name is taken";
  EXPECT_EQ(std::set<std::string>(mesh.node_names.begin(), mesh.node_names.end()).size(), 4U);
}

/// Cells come in the order of their types, whatever order they were added in; groups follow them.
TEST(MeshBuilder, KeepsGroupsOnTheirCellsWhenItSortsThemByType) {
  auto builder = square();
  const auto face = builder.add_cell(CellType::quad4, std::array{0, 1, 2, 3}, 10);
  const auto side = builder.add_cell(CellType::seg2, std::array{1, 2}, 20);
  const auto other = builder.add_cell(CellType::seg2, std::array{3, 0}, 30);
  builder.add_to_cell_group("plate", std::array{face});
  builder.add_to_cell_group("sides", std::array{other, side});
  const auto mesh = std::move(builder).build();
  ASSERT_EQ(mesh.cell_count(), 3);
  const auto types_of = [&](const char* group) {
    std::vector<CellType> types;
    for (const auto cell : mesh.cell_group(group)->items)
      types.push_back(mesh.type_of(cell));
    return types;
  };
  EXPECT_EQ(types_of("plate"), std::vector{CellType::quad4});
  EXPECT_EQ(types_of("sides"), (std::vector{CellType::seg2, CellType::seg2}));
  const auto first = mesh.nodes_of(mesh.cell_group("sides")->items.front());
  EXPECT_EQ(std::vector<NodeIndex>(first.begin(), first.end()), (std::vector<NodeIndex>{1, 2}));
}

TEST(MeshBuilder, MakesTheUnionOfWhatIsAddedToAGroup) {
  auto builder = square();
  builder.add_to_node_group("ends", std::array{3, 1});
  builder.add_to_node_group("ends", std::array{1, 0});
  const auto mesh = std::move(builder).build();
  ASSERT_NE(mesh.node_group("ends"), nullptr);
  EXPECT_EQ(mesh.node_group("ends")->items, (std::vector<std::int32_t>{0, 1, 3}));
}

TEST(MeshBuilder, AppendsAMeshOnNodesOfItsOwn) {
  auto builder = square({1, 2, 3, 4});
  builder.add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  builder.add_to_node_group("corner", std::array{0});
  const auto one = std::move(builder).build();
  MeshBuilder two(2);
  two.append(one);
  two.append(one);
  const auto mesh = std::move(two).build();
  EXPECT_EQ(mesh.node_count(), 8);
  EXPECT_EQ(mesh.cell_count(), 2);
  EXPECT_EQ(mesh.node_group("corner")->items, (std::vector<std::int32_t>{0, 4}));
  const auto second = mesh.nodes_of(1);
  EXPECT_EQ(std::vector<NodeIndex>(second.begin(), second.end()), (std::vector<NodeIndex>{4, 5, 6, 7}));
  EXPECT_EQ(std::set<std::int64_t>(mesh.node_numbers.begin(), mesh.node_numbers.end()).size(), 8U);
}

TEST(MeshBuilder, GoesOnWithTheNodesOfAMesh) {
  auto builder = square({5, 6, 7, 8}, {"a", "b", "c", "d"});
  builder.add_to_node_group("corner", std::array{2});
  const auto before = std::move(builder).build();
  auto more = MeshBuilder::on_nodes_of(before);
  more.add_cell(CellType::tria3, std::array{0, 1, 2});
  const auto mesh = std::move(more).build();
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.node_numbers, before.node_numbers);
  EXPECT_EQ(mesh.node_names, before.node_names);
  EXPECT_EQ(mesh.node_group("corner")->items, before.node_group("corner")->items);
  EXPECT_EQ(mesh.cell_count(), 1);
}

} // namespace
} // namespace rubato::mesh::builder_test
