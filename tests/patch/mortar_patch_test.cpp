// SPDX-License-Identifier: LGPL-3.0-or-later
/// The contact patch test by mortar: whatever the cells of the two blocks, and however their faces lie on one
/// another, a uniform pressure goes through.
#include <gtest/gtest.h>

#include "patch/cell_pairs.hpp"
#include "patch/contact_blocks.hpp"
#include <array>
#include <tuple>

namespace rubato::mortar_patch_test {
namespace {

using test::ContactBlocks;

class MortarBlocks : public testing::TestWithParam<test::CellPair> {
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
                         testing::Combine(testing::ValuesIn(test::plane_cells),
                                          testing::ValuesIn(test::plane_cells)),
                         &test::name_of_pair);
INSTANTIATE_TEST_SUITE_P(Solid, MortarBlocks,
                         testing::Combine(testing::ValuesIn(test::solid_cells),
                                          testing::ValuesIn(test::solid_cells)),
                         &test::name_of_pair);

} // namespace
} // namespace rubato::mortar_patch_test
