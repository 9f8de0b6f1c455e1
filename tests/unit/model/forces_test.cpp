// SPDX-License-Identifier: LGPL-3.0-or-later
// Loads of a study as forces on the nodes of a mesh.
#include "rubato/load/follower_pressure.hpp"
#include "rubato/model/model.hpp"
#include "rubato/model/model_forces.hpp"

#include <gtest/gtest.h>

#include "unit/model/meshes.hpp"

namespace rubato::model::forces_test {
namespace {

using Eigen::VectorXd;
using study::LoadKind;
using Texts = std::vector<std::string>;

/// Three squares in a row, thickness 0.5; the last one weighs 8 each unit of volume, the others 2.
class Loaded : public testing::Test {
protected:
  static test::Numbered part() {
    auto builder = test::row_of_squares(3);
    // The edge on the right of the last square, from top to bottom: not the way round that looks outwards.
    builder.add_to_cell_group("end", std::array{builder.add_cell(CellType::seg2, std::array{7, 3})});
    const auto middle = std::array{2}; // squares are cells 0, 2 and 4 of the builder, with an edge after each
    builder.add_to_cell_group("light", std::array{0});
    builder.add_to_cell_group("light", middle);
    auto study = test::plane_study({test::elastic("a", {"light"}, 2), test::elastic("b", {"last"}, 8)});
    study.thickness = 0.5;
    study.functions["ramp"] = {{0, 1}, {0, 1}};
    return {study, std::move(builder).build()};
  }

  std::vector<Force> forces_of(const std::vector<study::Load>& loads) {
    auto numbered = part();
    EXPECT_TRUE(numbered.faults.empty());
    numbered.study.loads = loads;
    return make_forces(numbered.study, numbered.mesh, numbered.dofs, numbered.bulk, {}, faults_);
  }
  /// x then y of every node: the lower row from left to right, then the upper one.
  VectorXd pattern_of(const study::Load& load) { return forces_of({load}).at(0).pattern; }

  std::vector<Fault> faults_;
};

/// One component at some nodes.
VectorXd on_nodes(std::initializer_list<int> nodes, int component, double value) {
  VectorXd force = VectorXd::Zero(16);
  for (const int node : nodes)
    force[2 * node + component] = value;
  return force;
}

TEST_F(Loaded, NodesEachHaveTheWholeNodalForce) {
  EXPECT_EQ(pattern_of({LoadKind::nodal_force, "wall", {3, 0, 0}, ""}), on_nodes({0, 4}, 0, 3));
}

TEST_F(Loaded, EdgesHandHalfOfTheirForceToEachEnd) {
  EXPECT_LE((pattern_of({LoadKind::line_force, "end", {0, 6, 0}, ""}) - on_nodes({3, 7}, 1, 3)).norm(), 1e-14)
      << "a force per length does not know the thickness";
  EXPECT_LE((pattern_of({LoadKind::surface_force, "end", {0, 6, 0}, ""}) - on_nodes({3, 7}, 1, 1.5)).norm(),
            1e-14)
      << "6 × 1 × 0.5 in all";
}

TEST_F(Loaded, PressurePushesIntoTheBodyWhicheverWayTheEdgeRuns) {
  EXPECT_LE((pattern_of({LoadKind::pressure, "end", {8, 0, 0}, ""}) - on_nodes({3, 7}, 0, -2)).norm(), 1e-14);
  VectorXd up = on_nodes({0, 3}, 1, 2) + on_nodes({1, 2}, 1, 4);
  EXPECT_LE((pattern_of({LoadKind::pressure, "floor", {8, 0, 0}, ""}) - up).norm(), 1e-14);
}

/// A square hands a quarter of its weight to each node.
TEST_F(Loaded, CellsWeighWhatTheirMaterialsWeigh) {
  const VectorXd last = on_nodes({2, 3, 6, 7}, 1, -10 * 8 * 0.5 / 4);
  EXPECT_LE((pattern_of({LoadKind::gravity, "last", {0, -10, 0}, ""}) - last).norm(), 1e-12);
  const VectorXd others = on_nodes({0, 2, 4, 6}, 1, -2.5) + on_nodes({1, 5}, 1, -5);
  EXPECT_LE((pattern_of({LoadKind::gravity, "", {0, -10, 0}, ""}) - last - others).norm(), 1e-12);
  EXPECT_LE((pattern_of({LoadKind::gravity, "light", {0, -10, 0}, ""}) - others).norm(), 1e-12);
  EXPECT_TRUE(faults_.empty());
}

TEST_F(Loaded, ForcesFollowTheirFunctions) {
  const auto forces = forces_of(
      {{LoadKind::nodal_force, "wall", {3, 0, 0}, "ramp"}, {LoadKind::nodal_force, "wall", {3, 0, 0}, ""}});
  ASSERT_EQ(forces.size(), 2U);
  EXPECT_EQ(forces[0].function, (Function{{0, 1}, {0, 1}}));
  EXPECT_FALSE(forces[1].function);
}

TEST_F(Loaded, PlacesMustSuitTheLoad) {
  forces_of({{LoadKind::line_force, "last", {1, 0, 0}, ""},
             {LoadKind::gravity, "floor", {1, 0, 0}, ""},
             {LoadKind::nodal_force, "wal", {1, 0, 0}, ""},
             {LoadKind::pressure, "wall", {1, 0, 0}, ""}});
  const auto told = test::told(faults_);
  ASSERT_EQ(told.size(), 4U);
  EXPECT_EQ(told[0],
            "loads.0.line_force.on: group 'last' holds QUAD4 cells, expected edges for a line force");
  EXPECT_EQ(told[1],
            "loads.1.gravity.on: group 'floor' holds no cells that deform, expected some for gravity");
  EXPECT_EQ(faults_[2].path, "loads.2.nodal_force.on");
  EXPECT_EQ(told[3], "loads.3.pressure.on: group 'wall' holds nodes, expected a group of cells");
}

TEST_F(Loaded, SurfacesWithABodyOnBothSidesAreRefused) {
  auto numbered = part();
  mesh::MeshBuilder builder = mesh::MeshBuilder(2);
  builder.append(numbered.mesh);
  builder.add_to_cell_group("inside", std::array{builder.add_cell(CellType::seg2, std::array{1, 5})});
  const test::Numbered with_inside{numbered.study, std::move(builder).build()};
  auto study = with_inside.study;
  study.loads = {{LoadKind::pressure, "inside", {1, 0, 0}, ""}};
  make_forces(study, with_inside.mesh, with_inside.dofs, with_inside.bulk, {}, faults_);
  ASSERT_EQ(faults_.size(), 1U);
  EXPECT_EQ(faults_[0].path, "loads.0.pressure.on");
  EXPECT_EQ(faults_[0].text.rfind("loaded surface 'inside': ", 0), 0U) << faults_[0].text;
}

TEST_F(Loaded, ExpressionsOfPlaceArePartOfThePattern) {
  const auto forces = forces_of({{LoadKind::nodal_force, "wall", {3, study::Formula{"1+y"}, 0}, "ramp"}});
  EXPECT_EQ(forces.at(0).pattern, on_nodes({0, 4}, 0, 3) + on_nodes({0}, 1, 1) + on_nodes({4}, 1, 2));
  EXPECT_TRUE(forces.at(0).fields.empty());
  EXPECT_TRUE(forces.at(0).function.has_value());
}

TEST_F(Loaded, ExpressionsOfTimeAreComputedAtEachInstant) {
  const auto forces = forces_of({{LoadKind::line_force, "end", {0, study::Formula{"6*t*y"}, 0}, "ramp"},
                                 {LoadKind::pressure, "end", {study::Formula{"t"}, 0, 0}, ""}});
  ASSERT_EQ(forces.at(0).fields.size(), 1U);
  EXPECT_TRUE(forces[0].pattern.isZero(0));
  VectorXd force = VectorXd::Zero(16);
  load::add_field_force(forces[0].fields[0], 0.5, force);
  // ∫ N 6 t y dy over the edge of length 1: t and 2 t, times the function
  EXPECT_LE((force - on_nodes({3}, 1, 0.25) - on_nodes({7}, 1, 0.5)).norm(), 1e-14);
  force.setZero();
  load::add_field_force(forces.at(1).fields.at(0), 4, force);
  EXPECT_LE((force - on_nodes({3, 7}, 0, -1)).norm(), 1e-14);
}

TEST_F(Loaded, FollowersStandApartAndTurnWithTheirFaces) {
  const std::vector<study::Load> loads{{LoadKind::pressure, "end", {8, 0, 0}, "ramp", true},
                                       {LoadKind::nodal_force, "wall", {3, 0, 0}, ""}};
  EXPECT_EQ(forces_of(loads).size(), 1U);
  auto numbered = part();
  numbered.study.loads = loads;
  Model model;
  model.followers = make_followers(numbered.study, numbered.mesh, numbered.dofs, numbered.bulk, faults_);
  ASSERT_EQ(model.followers.size(), 1U);
  EXPECT_TRUE(faults_.empty());
  VectorXd u = VectorXd::Zero(16);
  VectorXd force = VectorXd::Zero(16);
  add_follower_forces(model, 0.5, u, force);
  EXPECT_LE((force - on_nodes({3, 7}, 0, -1)).norm(), 1e-14) << "half of 8 × 1 × 0.5, whichever way it runs";
  u[2 * 7] = 1; // the edge leans to the right by 45°
  force.setZero();
  add_follower_forces(model, 1, u, force);
  EXPECT_LE((force - on_nodes({3, 7}, 0, -2) - on_nodes({3, 7}, 1, 2)).norm(), 1e-14);
}

/// Of an edge in the plane by 8 × 0.5: k_ij = p h ∫ N_i N_j,ξ dξ turned by −90°, whatever u is.
TEST_F(Loaded, FollowersAddTheSymmetricPartOfTheirStiffness) {
  auto numbered = part();
  numbered.study.loads = {{LoadKind::pressure, "end", {8, 0, 0}, "", true}};
  Model model;
  model.followers = make_followers(numbered.study, numbered.mesh, numbered.dofs, numbered.bulk, faults_);
  auto matrix = domain::BlockPattern(numbered.mesh, numbered.bulk.cells, numbered.dofs).zero_matrix();
  add_follower_tangent(model, 1, VectorXd::Zero(16), 0.25, matrix);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(16, 16);
  expected(6, 15) = expected(15, 6) = 0.25 * 4 / 2; // nodes 3 below and 7 above
  expected(7, 14) = expected(14, 7) = -0.25 * 4 / 2;
  EXPECT_LE((Eigen::MatrixXd(matrix) - expected).norm(), 1e-14);
}

TEST_F(Loaded, FollowersAreRefusedWhereTheyStand) {
  auto numbered = part();
  numbered.study.loads = {{LoadKind::pressure, "wall", {1, 0, 0}, "", true},
                          {LoadKind::pressure, "end", {study::Formula{"1/(x-3)"}, 0, 0}, "", true}};
  make_followers(numbered.study, numbered.mesh, numbered.dofs, numbered.bulk, faults_);
  ASSERT_EQ(faults_.size(), 2U);
  EXPECT_EQ(faults_[0].path, "loads.0.pressure.on");
  EXPECT_EQ(faults_[1].path, "loads.1.pressure.value");
}

TEST_F(Loaded, ExpressionsWithoutANumberAreRefusedAtTheirPlace) {
  forces_of({{LoadKind::nodal_force, "wall", {study::Formula{"1/x"}, 0, 0}, ""}});
  EXPECT_EQ(test::told(faults_),
            (Texts{"loads.0.nodal_force.x: loads.0.nodal_force.x: '1/x' is infinite at x = 0, y = 0, z = 0, "
                   "t = 0, expected a finite number"}));
}

} // namespace
} // namespace rubato::model::forces_test
