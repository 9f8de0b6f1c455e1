// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "verification/bulk_locking.hpp"
#include "verification/bulk_run.hpp"
#include "verification/bulk_structures.hpp"
#include <algorithm>
#include <array>
#include <set>

namespace rubato::verification::bulk_structures_test {
namespace {

void expect_within(const std::vector<Benchmark>& benchmarks) {
  for (const auto& benchmark : benchmarks)
    for (const auto& number : benchmark.numbers)
      EXPECT_TRUE(number.within()) << benchmark.row << ", " << benchmark.what << ", " << number.quantity
                                   << ": " << number.found << ", " << number.expected << " by "
                                   << number.source;
}

TEST(BulkBenchmarks, SayWhichNumbersAreWithinTheirTolerance) {
  EXPECT_TRUE((BenchmarkNumber{"", -1.009, -1, 0.01, ""}).within());
  EXPECT_FALSE((BenchmarkNumber{"", -1.011, -1, 0.01, ""}).within());
}

TEST(BulkBenchmarks, TellTheOrderOfConvergenceAboveRounding) {
  EXPECT_NEAR(*order_of({1, 1e-2, 1e-4, 1e-8}), 2, 1e-12);
  EXPECT_NEAR(*order_of({1e2, 1e-1, 1e-3, 1e-5, 1e-12}), 1, 1e-12);
  EXPECT_FALSE(order_of({1, 1e-8, 1e-16}));
  EXPECT_FALSE(order_of({1, 1e-4, 1e-3, 1e-9}));
  EXPECT_FALSE(order_of({}));
}

/// Rows 1 to 5, 15, 16, 20 to 22, and residuals of those that iterate.
TEST(BulkBenchmarks, OfStructuresHoldAndConvergeQuadratically) {
  const auto benchmarks = structure_benchmarks();
  expect_within(benchmarks);
  std::set<int> rows, quadratic;
  for (const auto& benchmark : benchmarks) {
    rows.insert(benchmark.row);
    EXPECT_FALSE(benchmark.numbers.empty()) << benchmark.what;
    if (benchmark.residuals.empty())
      continue;
    const auto order = order_of(benchmark.residuals);
    ASSERT_TRUE(order) << benchmark.what;
    EXPECT_GE(*order, 1.8) << benchmark.what;
    quadratic.insert(benchmark.row);
  }
  EXPECT_EQ(rows, (std::set{1, 2, 3, 4, 5, 15, 16, 20, 21, 22}));
  EXPECT_EQ(quadratic, (std::set{5, 15, 16, 20, 21, 22}));
}

TEST(BulkBenchmarks, IntegratedInFullLockAsMuchAsExpected) {
  expect_within(locked_structures());
}

/// As measured with an independent implementation, or better; finer membranes are on the page.
TEST(LockingOfLinearCells, IsWhatTheTableHas) {
  int count = 0;
  for (const auto& row : locking_rows(64))
    for (const auto& number : {row.full, row.mean_dilatation, row.enhanced})
      if (number) {
        EXPECT_TRUE(holds(*number, row.exact))
            << row.what << ": " << number->found << ", expected " << number->expected;
        ++count;
      }
  EXPECT_EQ(count, 59);
}

TEST(LockingOfLinearCells, MayBeLessThanExpectedButNotMore) {
  const LockingNumber better{.found = 9.9, .expected = 9, .digit = 0.1};
  EXPECT_TRUE(holds(better, 10));
  EXPECT_TRUE(holds({.found = 8.96, .expected = 9, .digit = 0.1}, 10));
  EXPECT_FALSE(holds({.found = 8.9, .expected = 9, .digit = 0.1}, 10));
  EXPECT_FALSE(holds({.found = 11.1, .expected = 9, .digit = 0.1}, 10));
}

} // namespace
} // namespace rubato::verification::bulk_structures_test
