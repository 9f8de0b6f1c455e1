// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "verification/bulk_benchmarks.hpp"

namespace rubato::verification::bulk_points_test {
namespace {

TEST(BulkPoints, HaveTheNumbersOfTheirClosedForms) {
  for (const auto& row : point_benchmarks())
    for (const auto& number : row.numbers)
      EXPECT_TRUE(number.within()) << "row " << row.row << ", " << number.quantity << ": " << number.found
                                   << " instead of " << number.expected;
}

} // namespace
} // namespace rubato::verification::bulk_points_test
