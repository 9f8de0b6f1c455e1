// SPDX-License-Identifier: LGPL-3.0-or-later
/// Uniform pressure through an interface. On conforming meshes every cell passes: the nodal and Gauss rules
/// of the contact faces integrate their shape functions exactly.
#include <gtest/gtest.h>

#include "patch/contact_blocks.hpp"
#include "patch/pyramids.hpp"

namespace rubato {
namespace {

using test::ContactBlocks;

std::string name_of(const testing::TestParamInfo<CellType>& instance) {
  return std::string(cell::topology(instance.param).name);
}

void expect_uniform(const ContactBlocks& blocks) {
  const auto outcome = test::press(blocks);
  ASSERT_TRUE(outcome.converged) << outcome.failure << "\n" << test::deck_of(blocks);
  EXPECT_LT(outcome.pressure, 1e-10);
  EXPECT_LT(outcome.displacement, 1e-10);
}

class ConformingBlocks : public testing::TestWithParam<CellType> {};

TEST_P(ConformingBlocks, HandOnAUniformPressure) {
  expect_uniform({GetParam(), 2, 2, 0, ""});
}

TEST_P(ConformingBlocks, HandOnAUniformPressureWithFriction) {
  expect_uniform({GetParam(), 2, 2, 0.3, ""});
}

TEST_P(ConformingBlocks, HandOnAUniformPressureThroughGaussPoints) {
  expect_uniform({GetParam(), 2, 2, 0, ", integration: {gauss: 3}"});
}

TEST_P(ConformingBlocks, HandOnAUniformPressureHoweverTheyAreTurned) {
  expect_uniform({GetParam(), 2, 2, 0, "", 0.5});
  expect_uniform({GetParam(), 2, 2, 0.3, "", 2.5});
}

INSTANTIATE_TEST_SUITE_P(Plane, ConformingBlocks,
                         testing::Values(CellType::quad4, CellType::quad8, CellType::quad9, CellType::tria3,
                                         CellType::tria6, CellType::tria7),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Solid, ConformingBlocks,
                         testing::Values(CellType::hexa8, CellType::hexa20, CellType::hexa27,
                                         CellType::tetra4, CellType::tetra10, CellType::penta6,
                                         CellType::penta15),
                         name_of);

/// Blocks of pyramids that touch with their triangles or with their bases.
ContactBlocks pyramids(bool triangles, double friction, double turned) {
  const auto change = [triangles](const mesh::Mesh& mesh) {
    return test::PyramidCut(mesh, 2, triangles).cut();
  };
  return {CellType::hexa8, 2, 2, friction, "", turned, change};
}

TEST(PyramidBlocks, HandOnAUniformPressureThroughTriangles) {
  expect_uniform(pyramids(true, 0, 0));
  expect_uniform(pyramids(true, 0.3, 0.5));
}

TEST(PyramidBlocks, HandOnAUniformPressureThroughQuadrangles) {
  expect_uniform(pyramids(false, 0, 0));
  expect_uniform(pyramids(false, 0.3, 0.5));
}

/// Points against faces cannot hand on a uniform pressure through meshes that don't match; how far they are
/// from it is known and no more.
TEST(BlocksThatDoNotMatch, ArePressedUnevenlyByPointsAgainstFaces) {
  for (const auto type : {CellType::quad4, CellType::hexa8}) {
    const auto outcome = test::press({type, 3, 2, 0, ""});
    ASSERT_TRUE(outcome.converged) << outcome.failure;
    EXPECT_GT(outcome.pressure, 1e-3);
    EXPECT_LT(outcome.pressure, 0.5);
    std::printf("nonmatching %.3e %.3e\n", outcome.pressure, outcome.displacement);
  }
}

} // namespace
} // namespace rubato
