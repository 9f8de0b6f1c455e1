// SPDX-License-Identifier: LGPL-3.0-or-later
// Which cells deform and what they are made of.
#include "rubato/model/build_model.hpp"

#include <gtest/gtest.h>

#include "unit/model/meshes.hpp"
#include <limits>

namespace rubato::model::materials_test {
namespace {

using test::elastic;
using test::plane_study;
using Texts = std::vector<std::string>;

/// Three squares in a row.
struct Assigned {
  mesh::Mesh mesh = test::row_of_squares(3).build();
  std::vector<Fault> faults{};
  domain::Bulk bulk;

  explicit Assigned(std::vector<study::Material> materials)
      : bulk(make_bulk(plane_study(std::move(materials)), mesh, faults)) {}
};

TEST(Materials, AreGivenToTheCellsOfTheirGroups) {
  mesh::Mesh mesh = test::row_of_squares(2).build();
  std::vector<Fault> faults;
  auto study = plane_study({elastic("a", {"last"}, 5), elastic("b", {"first"}, 7)});
  study.thickness = 0.25;
  const auto bulk = make_bulk(study, mesh, faults);
  EXPECT_TRUE(faults.empty());
  ASSERT_EQ(bulk.cells.size(), 2U);
  EXPECT_EQ(material::density(bulk.law(0)), 7);
  EXPECT_EQ(material::density(bulk.law(1)), 5);
  EXPECT_EQ(bulk.section.thickness, 0.25);
}

TEST(Materials, AreGivenToCellsThatDeformOnly) {
  const Assigned all({elastic("a", {}, 5)});
  EXPECT_TRUE(all.faults.empty());
  EXPECT_EQ(all.bulk.cells.size(), 3U) << "edges do not deform";
  for (std::size_t i = 0; i < all.bulk.cells.size(); ++i)
    EXPECT_EQ(material::density(all.bulk.law(i)), 5);
}

TEST(Materials, OfOneCellMustAgree) {
  const Assigned twice({elastic("stone"), elastic("steel", {"first", "last"})});
  EXPECT_EQ(
      test::told(twice.faults),
      (Texts{"materials.steel: material 'steel' is given to cells that have material 'stone' already"}));
  const Assigned named_twice({elastic("steel", {"first", "first", "last"})});
  ASSERT_EQ(named_twice.faults.size(), 1U);
  EXPECT_TRUE(named_twice.faults[0].text.starts_with("1 of 3 cells have no material")) << "and no cell two";
}

TEST(Materials, AreGivenToEveryCell) {
  const Assigned bare({elastic("steel", {"last"})});
  EXPECT_EQ(
      test::told(bare.faults),
      (Texts{"materials.steel: 2 of 3 cells have no material, the first one is cell 4 (QUAD4); expected "
             "one for every cell (`cells: all`, or a group)"}));
}

TEST(Materials, AreNotGivenToEdgesOrNodes) {
  EXPECT_EQ(test::told(Assigned({elastic("steel", {"floor"})}).faults),
            (Texts{"materials.steel.cells.0: group 'floor' holds SEG2 cells, expected surface cells for "
                   "material 'steel'"}));
  EXPECT_EQ(test::told(Assigned({elastic("steel", {"wall"})}).faults),
            (Texts{"materials.steel.cells.0: group 'wall' holds nodes, expected a group of cells"}));
}

TEST(Materials, NeedCellsThatDeform) {
  mesh::MeshBuilder builder(2);
  builder.add_node(Eigen::Vector3d(0, 0, 0));
  builder.add_node(Eigen::Vector3d(1, 0, 0));
  builder.add_cell(CellType::seg2, std::array{0, 1});
  std::vector<Fault> faults;
  make_bulk(plane_study({elastic("steel")}), std::move(builder).build(), faults);
  EXPECT_EQ(test::told(faults),
            (Texts{"materials.steel: the mesh has no surface cells, expected some for material 'steel'"}));
}

TEST(Shapes, OfCellsAreNotJudgedWhereNodesAreNowhere) {
  auto mesh = test::row_of_squares(20).build();
  const std::vector<mesh::CellIndex> cells{0, 1};
  for (std::size_t i = 0; i < 12; ++i)
    mesh.points[i].x() = std::numeric_limits<double>::quiet_NaN();
  auto study = plane_study({elastic("steel")});
  study.mesh.file = "broken.med";
  std::vector<Fault> faults;
  check_shapes(study, mesh, cells, faults);
  ASSERT_EQ(faults.size(), 11U);
  EXPECT_EQ(faults.front().path, "mesh.file");
  EXPECT_EQ(faults.front().text,
            "mesh file 'broken.med': node N1 (nan, 0) has a coordinate that is not finite");
  EXPECT_EQ(faults.back().text, "mesh file 'broken.med': and 2 more nodes like these");
}

TEST(Shapes, AreJudgedOfTheGivenCellsOnly) {
  auto mesh = test::row_of_squares(3).build();
  std::swap(mesh.points[0], mesh.points[4]); // turns the first square over
  const auto study = plane_study({elastic("steel")});
  const auto faults_of = [&](const char* group) {
    std::vector<Fault> faults;
    check_shapes(study, mesh, mesh.cell_group(group)->items, faults);
    return faults.size();
  };
  EXPECT_EQ(faults_of("last"), 0U);
  EXPECT_EQ(faults_of("first"), 1U);
}

} // namespace
} // namespace rubato::model::materials_test
