// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/error.hpp"
#include "rubato/core/ranks.hpp"
#include "rubato/core/writing.hpp"

#include <gtest/gtest.h>

#include "support/thread_ranks.hpp"
#include <array>
#include <atomic>
#include <new>
#include <stdexcept>

namespace rubato::ranks_test {
namespace {

TEST(Ranks, OneAloneNeedsNothing) {
  const Ranks alone;
  EXPECT_TRUE(alone.is_alone());
  EXPECT_TRUE(alone.is_first());
  EXPECT_EQ(alone.of_first(3), 3);
  EXPECT_EQ(alone.sum(0.25), 0.25);
  EXPECT_EQ(alone.largest(-2), -2);
  EXPECT_FALSE(alone.all(false));
  EXPECT_EQ(alone.bytes_sent(), 0);
  EXPECT_THROW(alone.first_does([] { throw std::domain_error("as it is"); }), std::domain_error);
}

TEST(Ranks, Agree) {
  test::as_ranks(3, [](const Ranks& ranks) {
    const int own = ranks.index();
    EXPECT_EQ(ranks.count(), 3);
    EXPECT_EQ(ranks.of_first(own + 7), 7);
    EXPECT_FALSE(ranks.of_first(own > 0));
    EXPECT_FALSE(ranks.all(own != 1));
    EXPECT_TRUE(ranks.all(own >= 0));
    EXPECT_EQ(ranks.largest(-own), 0);
    EXPECT_EQ(ranks.largest(own), 2);
    std::array<double, 2> values{own + 0.5, 1};
    ranks.share_first(values);
    EXPECT_EQ(values[0], 0.5);
  });
}

/// Sums of numbers whose rounding depends on the order have the same bits on all.
TEST(Ranks, SumInTheirOrder) {
  constexpr std::array parts{1.0, 1e-16, -1.0, 3e-17};
  const double expected = ((0 + parts[0]) + parts[1] + parts[2]) + parts[3];
  test::as_ranks(4, [&](const Ranks& ranks) {
    const double own = parts.at(static_cast<std::size_t>(ranks.index()));
    EXPECT_EQ(ranks.sum(own), expected);
    std::array<double, 2> both{own, 2 * own};
    ranks.sum(both);
    EXPECT_EQ(both[0], expected);
    EXPECT_EQ(both[1], 2 * expected);
  });
}

TEST(Ranks, TheFirstDoesItOnce) {
  std::atomic<int> done = 0;
  test::as_ranks(3, [&](const Ranks& ranks) {
    ranks.first_does([&] { ++done; });
    EXPECT_EQ(done, 1);
  });
}

TEST(Ranks, WhatTheFirstThrowsAllThrow) {
  test::as_ranks(2, [](const Ranks& ranks) {
    EXPECT_THROW(ranks.first_does([] { throw InputError("bad"); }), InputError);
    EXPECT_THROW(ranks.first_does([] { throw WriteError("file"); }), WriteError);
    EXPECT_THROW(ranks.first_does([] { throw std::bad_alloc(); }), std::bad_alloc);
    EXPECT_THROW(ranks.first_does([] { throw std::length_error("other"); }), std::exception);
    EXPECT_NO_THROW(ranks.first_does([] {}));
  });
}

TEST(Ranks, CountWhatTheySend) {
  test::as_ranks(2, [](const Ranks& ranks) {
    const double before = ranks.bytes_sent();
    std::array<double, 5> values{};
    ranks.share_first(values);
    // The first one's five numbers, and what the sum of bytes itself sends.
    EXPECT_EQ(ranks.bytes_sent() - before, 5 * sizeof(double) + 2 * sizeof(double));
  });
}

} // namespace
} // namespace rubato::ranks_test
