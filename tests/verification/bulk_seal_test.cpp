// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "verification/bulk_seal.hpp"
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace rubato::verification::bulk_seal_test {
namespace {

/// Forces on the lid at 10, 20 and 30 % on 3072 cells.
constexpr std::array<double, 3> on_fine_cells{29.80, 85.03, 208.84};

TEST(PressedSeal, HasForcesThatConvergeOnFinerMeshes) {
  std::array<double, 3> before;
  before.fill(std::numeric_limits<double>::infinity());
  for (const int n : {2, 4}) {
    const auto found = press_seal(n);
    EXPECT_LE(found.balance, 1e-12);
    for (const std::size_t i : {0U, 1U, 2U}) {
      const double error = std::abs(found.force[i] / on_fine_cells[i] - 1);
      EXPECT_LT(error, before[i]) << n << ' ' << i;
      before[i] = error;
    }
  }
  for (const double error : before)
    EXPECT_LE(error, 0.07);
}

/// Steps of a twentieth of the diameter are more than contact can be predicted for: the first moves of the
/// ring turn cells inside out, and the step is cut instead.
TEST(PressedSeal, IsCutWhereThePredictionTurnsCellsInsideOut) {
  const auto found = press_seal(8, 0.05);
  EXPECT_GT(found.cuts, 0);
  EXPECT_LE(found.balance, 1e-12);
  for (const std::size_t i : {0U, 1U, 2U})
    EXPECT_NEAR(found.force[i], on_fine_cells[i], 5e-3 * on_fine_cells[i]);
}

} // namespace
} // namespace rubato::verification::bulk_seal_test
