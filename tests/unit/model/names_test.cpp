// SPDX-License-Identifier: LGPL-3.0-or-later
// Names of a study that must mean something in the mesh.
#include <gtest/gtest.h>

#include "unit/model/meshes.hpp"

namespace rubato::model::names_test {
namespace {

using Nodes = std::vector<mesh::NodeIndex>;
using Texts = std::vector<std::string>;

class Named : public testing::Test {
protected:
  static mesh::Mesh mesh() {
    auto builder = test::row_of_squares(2);
    builder.add_node(Eigen::Vector3d(5, 5, 0)); // N7, which no cell has
    builder.add_to_node_group("loose", std::array{6});
    builder.add_to_node_group("mixed", std::array{1, 6});
    builder.add_to_cell_group("nothing", {});
    return std::move(builder).build();
  }
  Nodes of_body(const std::string& name) {
    return body_nodes_or_fault(part_.mesh, part_.dofs, {name, "path"}, "to hold", faults_);
  }
  Texts told() const { return test::told(faults_); }

  const test::Numbered part_{test::plane_study({test::elastic("any")}), mesh()};
  std::vector<Fault> faults_;
};

TEST_F(Named, GroupsOfCellsAreFound) {
  const auto* floor = cells_named(part_.mesh, {"floor", "path"}, faults_);
  ASSERT_NE(floor, nullptr);
  EXPECT_EQ(floor->items.size(), 2U);
  EXPECT_TRUE(faults_.empty());
}

TEST_F(Named, GroupsOfCellsMustHoldSome) {
  for (const char* name : {"wall", "nothing", "flor", "something else"})
    EXPECT_EQ(cells_named(part_.mesh, {name, "path"}, faults_), nullptr);
  EXPECT_EQ(told(),
            (Texts{"path: group 'wall' holds nodes, expected a group of cells",
                   "path: group 'nothing' is empty, expected cells in it",
                   "path: found 'flor', expected a group of cells of the mesh; did you mean 'floor'?",
                   "path: found 'something else', expected a group of cells of the mesh; the mesh has the "
                   "groups first, floor, last, loose, mixed, nothing, wall"}));
}

TEST_F(Named, GroupsAreNoneOfAMeshWithoutGroups) {
  mesh::MeshBuilder builder(2);
  builder.add_node(Eigen::Vector3d(0, 0, 0));
  cells_named(std::move(builder).build(), {"floor", "path"}, faults_);
  EXPECT_EQ(told(),
            (Texts{"path: found 'floor', expected a group of cells of the mesh; the mesh has no groups"}));
}

TEST_F(Named, NodesOfBodiesAreThoseOfTheirCells) {
  EXPECT_EQ(of_body("wall"), (Nodes{0, 3}));
  EXPECT_EQ(of_body("last"), (Nodes{1, 2, 4, 5}));
  EXPECT_EQ(of_body("mixed"), Nodes{1});
  EXPECT_EQ(of_body("N3"), Nodes{2});
  EXPECT_TRUE(faults_.empty());
  EXPECT_TRUE(of_body("loose").empty());
  EXPECT_TRUE(of_body("N8").empty());
  ASSERT_EQ(faults_.size(), 2U);
  EXPECT_EQ(told()[0],
            "path: found 'loose', none of whose nodes belongs to a cell that deforms, expected a part "
            "of a body to hold");
}

TEST_F(Named, FunctionsAreNoneWithoutAName) {
  study::Study study;
  study.functions["ramp"] = {{0, 1}, {0, 2}};
  EXPECT_FALSE(function_named(study, ""));
  EXPECT_EQ(function_named(study, "ramp"), (Function{{0, 1}, {0, 2}}));
}

} // namespace
} // namespace rubato::model::names_test
