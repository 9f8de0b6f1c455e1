// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact patch test by mortar: whatever the cells of the two blocks, and however their faces lie on one
/// another, a uniform pressure goes through.
#include <gtest/gtest.h>

#include "patch/contact_blocks.hpp"
#include <array>
#include <tuple>

namespace rubato {
namespace {

using test::ContactBlocks;

constexpr std::array plane_cells{CellType::quad4, CellType::quad8, CellType::quad9,
                                 CellType::tria3, CellType::tria6, CellType::tria7};
constexpr std::array solid_cells{CellType::hexa8,   CellType::hexa20, CellType::hexa27, CellType::tetra4,
                                 CellType::tetra10, CellType::penta6, CellType::penta15};

using Pair = std::tuple<CellType, CellType>;

std::string name_of(const testing::TestParamInfo<Pair>& instance) {
  return std::string(cell::topology(std::get<0>(instance.param)).name) + "_on_" +
         std::string(cell::topology(std::get<1>(instance.param)).name);
}

class MortarBlocks : public testing::TestWithParam<Pair> {
protected:
  static void expect_uniform(int upper, int lower, double friction, double turned, double allowed) {
    const auto& [above, below] = GetParam();
    const auto outcome =
        test::press({above, upper, lower, friction, ", integration: mortar", turned, {}, below});
    ASSERT_TRUE(outcome.converged) << outcome.failure;
    EXPECT_LT(outcome.pressure, allowed) << upper << " on " << lower;
    EXPECT_LT(outcome.displacement, allowed) << upper << " on " << lower;
  }
};

TEST_P(MortarBlocks, HandOnAUniformPressureThoughTheirMeshesDoNotMatch) {
  expect_uniform(3, 4, 0, 0, 1e-9);
  expect_uniform(3, 2, 0, 0, 1e-9);
}

TEST_P(MortarBlocks, HandOnAUniformPressureWhereTheirMeshesMatch) {
  expect_uniform(2, 2, 0, 0, 1e-9);
}

TEST_P(MortarBlocks, HandOnAUniformPressureWithFrictionHoweverTheyAreTurned) {
  expect_uniform(3, 2, 0.3, 0.5, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Plane, MortarBlocks,
                         testing::Combine(testing::ValuesIn(plane_cells), testing::ValuesIn(plane_cells)),
                         name_of);
INSTANTIATE_TEST_SUITE_P(Solid, MortarBlocks,
                         testing::Combine(testing::ValuesIn(solid_cells), testing::ValuesIn(solid_cells)),
                         name_of);

} // namespace
} // namespace rubato
