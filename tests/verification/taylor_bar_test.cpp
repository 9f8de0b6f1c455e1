// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "verification/taylor_bar.hpp"
#include <cmath>
#include <numbers>

namespace rubato::verification {
namespace {

void expect_published(const TaylorResult& result) {
  EXPECT_GE(result.length, 21.4e-3);
  EXPECT_LE(result.length, 21.8e-3);
  EXPECT_GE(result.radius, 6.9e-3);
  EXPECT_LE(result.radius, 7.2e-3);
}

/// It comes to rest: nearly all of ½ m v² has gone into plastic work, and every joule of it is found.
void expect_ledger(const TaylorResult& result) {
  EXPECT_LE(result.balance, 1e-10);
  EXPECT_GE(result.plastic, 0.97 * result.start);
  EXPECT_LE(result.plastic, result.start);
  EXPECT_LE(std::abs(result.scheme), 1e-4 * result.start);
}

TEST(TaylorBar, HasThePublishedShapeOnAxisymmetricCells) {
  const auto result = run(taylor_bar(TaylorMesh::meridian));
  expect_published(result);
  expect_ledger(result);
  const double mass = 8930 * std::numbers::pi * 3.2e-3 * 3.2e-3 * 32.4e-3;
  EXPECT_NEAR(result.start, 0.5 * mass * 227 * 227, 1e-9 * result.start);
}

TEST(TaylorBar, HasThePublishedShapeOnAQuarterOfSolidCells) {
  const auto result = run(taylor_bar(TaylorMesh::quarter));
  expect_published(result);
  expect_ledger(result);
}

} // namespace
} // namespace rubato::verification
