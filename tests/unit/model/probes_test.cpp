// SPDX-License-Identifier: LGPL-3.0-or-later
// Which nodes a probe looks at.
#include <gtest/gtest.h>

#include "unit/model/meshes.hpp"

namespace rubato::model::probes_test {
namespace {

using Nodes = std::vector<mesh::NodeIndex>;
using Texts = std::vector<std::string>;

study::Probe probe_on(const std::string& node, study::ProbeTake take = study::ProbeTake::node) {
  study::Probe probe;
  probe.name = "p";
  probe.node = node;
  probe.take = take;
  return probe;
}

study::Probe probe_at(double x, double y) {
  study::Probe probe;
  probe.name = "p";
  probe.point = {x, y, 0};
  return probe;
}

study::Probe in_cells(study::Probe probe, study::ProbePlace place) {
  probe.field = study::ProbeField::mean_stress;
  probe.place = place;
  return probe;
}

/// Two squares and, apart from them, a node that no cell has: number 8 of mesh N7 (0.5, 0.5).
class Probed : public testing::Test {
protected:
  static mesh::Mesh mesh() {
    auto builder = test::row_of_squares(2);
    builder.add_node(Eigen::Vector3d(0.5, 0.5, 0));
    builder.add_to_node_group("loose", std::array{6});
    builder.add_to_node_group("mixed", std::array{1, 6});
    builder.add_to_node_group("lonely", std::array{6});
    return std::move(builder).build();
  }
  Nodes nodes_of(const study::Probe& probe) {
    auto study = test::plane_study({test::elastic("any")});
    study.probes = {probe};
    const test::Numbered part{study, mesh()};
    return make_probe_nodes(part.study, part.mesh, part.dofs, {}, faults_, notes_).at(0);
  }
  ProbedCells cells_of(const study::Probe& probe) {
    auto study = test::plane_study({test::elastic("any")});
    study.probes = {probe};
    const auto probed = mesh();
    const auto bulk = make_bulk(study, probed, faults_);
    return make_probe_cells(study, probed, bulk, faults_, notes_).at(0);
  }

  std::vector<Fault> faults_;
  Texts notes_;
};

TEST_F(Probed, PointIsTheNearestNodeThatDeforms) {
  EXPECT_EQ(nodes_of(probe_at(1.9, 0.8)), Nodes{5});
  EXPECT_EQ(nodes_of(probe_at(0.4, 0.49)), Nodes{0}); // not the loose node, which is nearer
  EXPECT_TRUE(notes_.empty());
}

/// The size of the squares is √5.
TEST_F(Probed, PointBetweenNodesIsToldOfAsLongAsTheyAreEquallyNear) {
  EXPECT_EQ(nodes_of(probe_at(0.5 - 0.9e-6, 0)), Nodes{0});
  EXPECT_EQ(notes_,
            (Texts{"probe 'p': 2 nodes are equally near to its point, N1 (0, 0), N2 (1, 0); N1 is taken, "
                   "'node: N1' instead of the point, or another one of them, says which is meant"}));
  notes_.clear();
  EXPECT_EQ(nodes_of(probe_at(0.5 + 0.9e-6, 0)), Nodes{1}) << "the nearest one although both are named";
  EXPECT_EQ(notes_.size(), 1U);
  notes_.clear();
  EXPECT_EQ(nodes_of(probe_at(0.5 + 1.4e-6, 0)), Nodes{1});
  EXPECT_TRUE(notes_.empty());
}

TEST_F(Probed, PointThatManyNodesAreNearToNamesAFew) {
  auto study = test::plane_study({test::elastic("any")});
  study.probes = {probe_at(0, 0)};
  mesh::MeshBuilder builder(2);
  for (int i = 0; i < 8; ++i) // two squares on each other
    builder.add_node(Eigen::Vector3d(i % 4 == 1 || i % 4 == 2 ? 1 : -1, i % 4 < 2 ? -1 : 1, 0));
  builder.add_cell(CellType::quad4, std::array{0, 1, 2, 3});
  builder.add_cell(CellType::quad4, std::array{4, 5, 6, 7});
  const test::Numbered part{study, std::move(builder).build()};
  make_probe_nodes(part.study, part.mesh, part.dofs, {}, faults_, notes_);
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_NE(notes_[0].find("8 nodes are equally near"), std::string::npos) << notes_[0];
  EXPECT_NE(notes_[0].find("N5 (-1, -1) and 3 more; N1 is taken"), std::string::npos) << notes_[0];
}

TEST_F(Probed, GroupIsThoseOfItsNodesThatDeform) {
  EXPECT_EQ(nodes_of(probe_on("wall", study::ProbeTake::sum)), (Nodes{0, 3}));
  EXPECT_EQ(nodes_of(probe_on("mixed", study::ProbeTake::sum)), Nodes{1});
  EXPECT_EQ(nodes_of(probe_on("N2")), Nodes{1});
  EXPECT_TRUE(faults_.empty());
}

TEST_F(Probed, NodeIsOneThatDeforms) {
  nodes_of(probe_on("mixed"));
  nodes_of(probe_on("N7"));
  nodes_of(probe_on("lonely", study::ProbeTake::mean));
  EXPECT_EQ(
      test::told(faults_),
      (Texts{"probes.p.node: probe 'p': group 'mixed' has 2 nodes, expected one, or what is taken of them: "
             "{on: mixed, take: sum}, mean, min or max",
             "probes.p.node: probe 'p': node N7 (0.5, 0.5) belongs to no cell that deforms",
             "probes.p.on: probe 'p': node N7 (0.5, 0.5) belongs to no cell that deforms"}));
}

using Cells = std::vector<std::size_t>;

TEST_F(Probed, CellsAreThoseOfAGroupThatDeform) {
  const auto place = study::ProbePlace::gauss_points;
  const auto cells = [&](const std::string& on) {
    return cells_of(in_cells(probe_on(on, study::ProbeTake::largest), place)).cells;
  };
  EXPECT_EQ(cells("all"), (Cells{0, 1}));
  EXPECT_EQ(cells("last"), Cells{1});
  EXPECT_TRUE(nodes_of(in_cells(probe_on("last", study::ProbeTake::largest), place)).empty());
  EXPECT_TRUE(faults_.empty());
  EXPECT_TRUE(cells("floor").empty());
  EXPECT_TRUE(cells("wall").empty());
  EXPECT_EQ(
      test::told(faults_),
      (Texts{"probes.p.on: probe 'p': group 'floor' holds no cells that deform, expected some, or 'all'",
             "probes.p.on: group 'wall' holds nodes, expected a group of cells"}));
}

TEST_F(Probed, GaussPointIsTheNearestOne) {
  const auto near = cells_of(in_cells(probe_at(1.9, 0.8), study::ProbePlace::gauss_points));
  EXPECT_EQ(near.cells, Cells{1});
  EXPECT_GE(near.point, 0);
  EXPECT_EQ(cells_of(in_cells(probe_at(1.9, 0.8), study::ProbePlace::cells)).point, -1);
  EXPECT_TRUE(notes_.empty());
  cells_of(in_cells(probe_at(0.5, 0.5), study::ProbePlace::gauss_points));
  EXPECT_EQ(notes_,
            (Texts{"probe 'p': 4 Gauss points are equally near to its point; one of cell 3 (QUAD4) at "
                   "(0.5, 0.5) is taken, a place nearer to one of them says which is meant"}));
}

TEST_F(Probed, NameMustMeanSomething) {
  EXPECT_EQ(nodes_of(probe_on("wal", study::ProbeTake::sum)), Nodes{0});
  ASSERT_EQ(faults_.size(), 1U);
  EXPECT_EQ(faults_[0].path, "probes.p.on");
  EXPECT_NE(faults_[0].text.find("'wall'"), std::string::npos) << faults_[0].text;
}

TEST_F(Probed, FieldsOfChecksAreOnPlacesOfTheMesh) {
  auto study = test::plane_study({test::elastic("any")});
  study.checks.resize(4); // the first one is of a probe, the second one of every node
  study.checks[1].field = study::CheckedField{"displacement", "y", ""};
  study.checks[2].field = study::CheckedField{"displacement", "y", "wall"};
  study.checks[3].field = study::CheckedField{"displacement", "y", "N99"};
  check_compared_places(study, mesh(), faults_);
  ASSERT_EQ(faults_.size(), 1U);
  EXPECT_EQ(faults_[0].path, "checks.3.on");
}

} // namespace
} // namespace rubato::model::probes_test
