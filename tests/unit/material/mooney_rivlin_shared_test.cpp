// SPDX-License-Identifier: LGPL-3.0-or-later
/// Code_Aster's block of rubber whose sides are free: each of its points is like any other. The file stands
/// beside the project on some machines only.
#include "rubato/material/mooney_rivlin.hpp"

#include <gtest/gtest.h>

#include "support/csv_file.hpp"
#include "support/point_path.hpp"
#include "support/shared_files.hpp"

namespace rubato::material::mooney_rivlin_shared_test {
namespace {

/// A unit cube pressed by 0.3 in ten steps; columns: t, reaction on the top, then displacements, the side's
/// fifth of them (x = 1, z = ½).
TEST(MooneyRivlin, FollowsCodeAster) {
  const auto rows = test::csv_rows(test::shared_file("oracle/hyper_h8_free.csv"));
  if (rows.empty())
    GTEST_SKIP() << "no shared files";
  test::PointPath path(MooneyRivlin{4e5, 1e5, 2e7, Volumetric::quadratic});
  for (const auto& row : rows) {
    const double stretch = 1 - 0.3 * row[0];
    ASSERT_TRUE(path.to_mixed({false, false, true, false, false, false},
                              0.5 * (stretch * stretch - 1) * Strain6::Unit(2)));
    EXPECT_NEAR(stretch * path.response().stress[2], row[1], 1e-10 * 1.43e6);
    EXPECT_NEAR(std::sqrt(1 + 2 * path.strain()[0]) - 1, row[5], 1e-11);
  }
}

} // namespace
} // namespace rubato::material::mooney_rivlin_shared_test
