// SPDX-License-Identifier: LGPL-3.0-or-later
// The mesh of a study: generated or read, mended, converted, refined.
#include "rubato/mesh/io/med.hpp"
#include "rubato/mesh/orientation.hpp"
#include "rubato/model/build_model.hpp"

#include <gtest/gtest.h>

#include "studies.hpp"
#include "support/scratch_folder.hpp"

namespace rubato::model::mesh_test {
namespace {

study::MeshSource generated() {
  return test::study_of(test::two_blocks).mesh;
}

const mesh::CellBlock* block_of(const mesh::Mesh& mesh, CellType type) {
  const auto found = std::ranges::find(mesh.blocks, type, &mesh::CellBlock::type);
  return found == mesh.blocks.end() ? nullptr : &*found;
}

/// The same request for a mesh from a file and for one made on the spot.
class StudyMesh : public testing::TestWithParam<bool> {
protected:
  study::MeshSource source() const {
    auto source = generated();
    if (!GetParam())
      return source;
    mesh::write_med(folder_ / "blocks.med", load_mesh(source));
    source.bodies.clear();
    source.file = (folder_ / "blocks.med").string();
    return source;
  }

  test::ScratchFolder folder_;
};

TEST_P(StudyMesh, IsConvertedAndRefined) {
  auto source = this->source();
  source.convert = study::MeshConversion::full_quadratic;
  source.refine = 2;
  const auto mesh = load_mesh(source);
  ASSERT_NE(block_of(mesh, CellType::quad9), nullptr);
  EXPECT_EQ(block_of(mesh, CellType::quad9)->cell_count(), 16 * 4);
  EXPECT_EQ(block_of(mesh, CellType::quad4), nullptr);
  EXPECT_EQ(mesh.node_count(), 2 * (2 * 8 + 1) * (2 * 4 + 1));
  EXPECT_EQ(mesh.cell_group("upper_face")->items.size(), 8U);
  EXPECT_EQ(mesh.node_group("tip")->items.size(), 1U);
}

TEST_P(StudyMesh, IsLeftAloneWhenNothingIsAsked) {
  const auto mesh = load_mesh(source());
  EXPECT_EQ(mesh.node_count(), 30);
  EXPECT_EQ(block_of(mesh, CellType::quad4)->cell_count(), 16);
}

INSTANTIATE_TEST_SUITE_P(From, StudyMesh, testing::Values(false, true),
                         [](const auto& from) { return from.param ? "File" : "Generator"; });

TEST(MirroredCells, OfAFileAreMended) {
  const test::ScratchFolder folder;
  auto mesh = load_mesh(generated());
  auto& nodes = mesh.blocks.back().nodes;
  ASSERT_EQ(mesh.blocks.back().type, CellType::quad4);
  std::swap(nodes[1], nodes[3]);
  mesh::write_med(folder / "blocks.med", mesh);
  study::MeshSource source;
  source.file = (folder / "blocks.med").string();
  const auto mended = load_mesh(source);
  for (mesh::CellIndex cell = 0; cell < mended.cell_count(); ++cell)
    EXPECT_GT(mesh::signed_measure(mended, cell), 0);
}

} // namespace
} // namespace rubato::model::mesh_test
