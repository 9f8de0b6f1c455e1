// SPDX-License-Identifier: LGPL-3.0-or-later
// Mesh files that cannot be computed with: told at the place of the deck that names them.
#include "rubato/mesh/builder.hpp"
#include "rubato/mesh/io/med.hpp"

#include <gtest/gtest.h>

#include "program.hpp"

namespace rubato::bad_mesh_test {
namespace {

/// One fault in the file, or one change by --set, and the deck is refused.
const std::string deck = R"(mesh: {file: blocks.med}
physics: plane_strain
materials:
  steel: {young: 200e9, poisson: 0.3, density: 7800, cells: all}
supports:
  - {on: held, fix: [x, y]}
contact:
  interface: {master: one_side, slave: other_side}
time: {scheme: hht, alpha: -0.1, step: 1e-4, end: 2e-4}
)";

/// Two squares side by side that share the edge "middle"; "one_side" and "other_side" are outer edges.
/// `tangled`: the second square's nodes in an order that makes a bow tie.
mesh::Mesh two_squares(bool tangled = false) {
  mesh::MeshBuilder builder(2);
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {2, 0}, {0, 1}, {1, 1}, {2, 1}})
    builder.add_node(Eigen::Vector3d(x, y, 0));
  builder.add_cell(CellType::quad4, std::array{0, 1, 4, 3}, 11);
  builder.add_cell(CellType::quad4, tangled ? std::array{1, 2, 4, 5} : std::array{1, 2, 5, 4}, 12);
  const auto add_edge = [&](const std::string& group, int a, int b, int number) {
    const auto edge = builder.add_cell(CellType::seg2, std::array{a, b}, number);
    builder.add_to_cell_group(group, std::array{edge});
  };
  add_edge("held", 0, 3, 1);
  add_edge("middle", 1, 4, 2);
  add_edge("one_side", 3, 4, 3);
  add_edge("other_side", 0, 1, 4);
  return std::move(builder).build();
}

class BadMeshFile : public testing::Test {
protected:
  BadMeshFile() { test::write_text(folder_ / "deck.yaml", deck); }

  void write(const mesh::Mesh& mesh) const { mesh::write_med(folder_ / "blocks.med", mesh); }

  std::string refusal(const std::vector<std::string>& settings = {}) const {
    std::vector<std::string> arguments{"run", "deck.yaml", "-o", "out"};
    for (const auto& setting : settings)
      arguments.insert(arguments.end(), {"--set", setting});
    const auto outcome = test::run_program(arguments, folder_.path());
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
    return outcome.err;
  }

  test::ScratchFolder folder_;
};

TEST_F(BadMeshFile, IsToldWhenItIsAbsent) {
  EXPECT_EQ(refusal(), "error: deck.yaml:1:14: mesh file 'blocks.med' does not exist\n");
}

TEST_F(BadMeshFile, IsToldWhenItIsTruncated) {
  write(two_squares());
  const auto bytes = test::text_of(folder_ / "blocks.med");
  test::write_text(folder_ / "blocks.med", bytes.substr(0, bytes.size() / 2));
  EXPECT_EQ(refusal(), "error: deck.yaml:1:14: mesh file 'blocks.med' is truncated: it has " +
                           std::to_string(bytes.size() / 2) + " of its " + std::to_string(bytes.size()) +
                           " bytes\n");
}

TEST_F(BadMeshFile, IsToldWhenItIsNotMed) {
  test::write_text(folder_ / "blocks.med", "solid blocks\nendsolid blocks\n");
  EXPECT_EQ(
      refusal(),
      "error: deck.yaml:1:14: mesh file 'blocks.med' is not a MED file: it does not begin as an HDF5 file\n");
}

TEST_F(BadMeshFile, IsToldWhenItIsHdf5ButNotMed) {
  write(two_squares());
  auto bytes = test::text_of(folder_ / "blocks.med");
  const std::string mark = "INFOS_GENERALES";
  for (auto at = bytes.find(mark); at != std::string::npos; at = bytes.find(mark))
    bytes.replace(at, mark.size(), "ZNFOS_GENERALES");
  test::write_text(folder_ / "blocks.med", bytes);
  EXPECT_EQ(refusal(), "error: deck.yaml:1:14: mesh file 'blocks.med' is an HDF5 file but not a MED file: it "
                       "has no MED version\n");
}

TEST_F(BadMeshFile, IsToldByNumberWhichCellIsTangled) {
  write(two_squares(true));
  EXPECT_EQ(refusal(),
            "error: deck.yaml:1:14: mesh file 'blocks.med': cell 12 (QUAD4) at (1.5, 0.5) is "
            "inverted or degenerate: its Jacobian determinant falls to -0.144, it must be positive\n");
}

TEST_F(BadMeshFile, IsToldByNumberWhichNodeIsNowhere) {
  auto mesh = two_squares();
  mesh.points[4][1] = std::numeric_limits<double>::quiet_NaN();
  write(mesh);
  EXPECT_EQ(refusal(),
            "error: deck.yaml:1:14: mesh file 'blocks.med': node N5 (1, nan) has a coordinate that is "
            "not finite\n");
}

TEST_F(BadMeshFile, IsToldWhichCellHasAStiffnessBeyondAllNumbers) {
  write(two_squares());
  EXPECT_EQ(
      refusal({"materials.steel.young=1e308", "thickness=100"}),
      "error: cell 11 (QUAD4) at (0.5, 0.5): its stiffness is not finite (young 1e+308, poisson 0.3, density "
      "7800)\n");
}

TEST_F(BadMeshFile, IsToldWhenItCannotBeRead) {
  std::filesystem::create_directory(folder_ / "blocks.med");
  EXPECT_EQ(refusal(),
            "error: deck.yaml:1:14: mesh file 'blocks.med' is a directory, a MED file was expected\n");
  std::filesystem::remove(folder_ / "blocks.med");
  write(two_squares());
  std::filesystem::permissions(folder_ / "blocks.med", std::filesystem::perms::none);
  if (geteuid() == 0)
    GTEST_SKIP() << "permissions do not bind this user";
  EXPECT_EQ(refusal(), "error: deck.yaml:1:14: mesh file 'blocks.med' cannot be read: permission denied\n");
}

TEST_F(BadMeshFile, IsToldWhenItHasNoCellsOfThePhysics) {
  write(two_squares());
  EXPECT_EQ(refusal({"physics=solid", "supports.0.fix=[x, y, z]"}),
            "error: deck.yaml:4:3: the mesh has no solid cells, expected some for material 'steel'\n");
}

TEST_F(BadMeshFile, IsToldWhenContactFacesAreInsideABody) {
  write(two_squares());
  EXPECT_EQ(refusal({"contact.interface.slave=middle"}),
            "error: --set contact.interface.slave: contact surface 'middle': 1 cell (the first: number 2 of "
            "SEG2) found inside a body, between two of its cells: a skin is expected\n");
}

TEST_F(BadMeshFile, IsToldWhenMasterAndSlaveShareFaces) {
  auto mesh = two_squares();
  auto& both = mesh.cell_groups.emplace_back(mesh::Group{"sides", mesh.cell_group("one_side")->items});
  both.items.push_back(mesh.cell_group("other_side")->items.front());
  write(mesh);
  EXPECT_EQ(
      refusal({"contact.interface.slave=sides"}),
      "error: --set contact.interface.slave: master 'one_side' and slave 'sides' share faces, expected two "
      "surfaces\n");
}

TEST_F(BadMeshFile, IsToldWhenFacesBelongToNoBody) {
  auto mesh = two_squares();
  auto builder = mesh::MeshBuilder(2);
  builder.append(mesh);
  const auto a = builder.add_node({5, 0, 0});
  const auto b = builder.add_node({6, 0, 0});
  const auto edge = builder.add_cell(CellType::seg2, std::array{a, b});
  builder.add_to_cell_group("loose", std::array{edge});
  write(std::move(builder).build());
  EXPECT_EQ(refusal({"contact.interface.slave=loose"}),
            "error: --set contact.interface.slave: contact surface 'loose': 1 cell (the first: number 5 of "
            "SEG2) found that bound no surface cell\n");
  EXPECT_EQ(refusal({"supports.0.on=loose"}),
            "error: --set supports.0.on: found 'loose', none of whose nodes belongs to a cell that deforms, "
            "expected a part of a body to hold\n");
}

TEST_F(BadMeshFile, IsToldWhenTheMeshOfThatNameIsMissing) {
  write(two_squares());
  EXPECT_EQ(refusal({"mesh.name=other"}),
            "error: deck.yaml:1:14: mesh file 'blocks.med' holds no mesh 'other'; it holds: mesh\n");
}

} // namespace
} // namespace rubato::bad_mesh_test
