// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "verification/bulk_benchmarks.hpp"

namespace rubato::verification::bulk_contact_test {
namespace {

TEST(BulkContact, HasTheNumbersOfItsSources) {
  for (const auto& row : contact_benchmarks())
    for (const auto& number : row.numbers)
      EXPECT_TRUE(number.within()) << "row " << row.row << ", " << number.quantity << ": " << number.found
                                   << " instead of " << number.expected;
}

} // namespace
} // namespace rubato::verification::bulk_contact_test
