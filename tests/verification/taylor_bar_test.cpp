// SPDX-License-Identifier: LGPL-3.0-or-later
#include <gtest/gtest.h>

#include "verification/taylor_bar.hpp"
#include <cmath>
#include <numbers>

namespace rubato::verification::taylor_bar_test {
namespace {

/// It comes to rest: nearly all of ½ m v² has gone into plastic work, and every joule of it is found.
void expect_ledger(const TaylorResult& result) {
  EXPECT_LE(result.balance, 1e-10);
  EXPECT_GE(result.plastic, 0.99 * result.start);
  EXPECT_LE(result.plastic, result.start);
  EXPECT_LE(std::abs(result.scheme), 1e-3 * result.start);
}

void expect_published_length(const TaylorResult& result) {
  EXPECT_GE(result.length, 21.4e-3);
  EXPECT_LE(result.length, 21.8e-3);
}

void expect_published_shape(const TaylorResult& result) {
  expect_published_length(result);
  EXPECT_GE(result.radius, 6.9e-3);
  EXPECT_LE(result.radius, 7.2e-3);
}

TEST(TaylorBar, HasThePublishedShapeOnAxisymmetricCells) {
  const auto result = run(taylor_bar(TaylorMesh::meridian, TaylorWall::sliding));
  expect_published_shape(result);
  expect_ledger(result);
}

TEST(TaylorBar, HasThePublishedShapeOnAQuarterOfSolidCells) {
  const auto result = run(taylor_bar(TaylorMesh::quarter, TaylorWall::sliding));
  expect_published_shape(result);
  expect_ledger(result);
}

/// One point a cell; hourglasses hold little of the energy.
TEST(TaylorBar, HasThePublishedShapeOnReducedCells) {
  for (const auto mesh : {TaylorMesh::meridian, TaylorMesh::quarter}) {
    const auto result = run(taylor_bar(mesh, TaylorWall::sliding, study::Formulation::reduced));
    expect_published_shape(result);
    EXPECT_LE(result.balance, 1e-10);
    EXPECT_LE(result.hourglass, 0.05 * result.start);
  }
}

/// Nothing holds the foot to a smooth wall: its edge comes off by 0.5 mm, and is 0.4 mm wider than where it
/// stays in the plane. Cells half as long give 7.44 mm, too.
TEST(TaylorBar, LiftsItsEdgeOffASmoothWall) {
  const auto result = run(taylor_bar(TaylorMesh::meridian, TaylorWall::contact));
  expect_published_length(result);
  EXPECT_NEAR(result.radius, 7.44e-3, 0.05e-3);
  EXPECT_NEAR(result.edge, 0.49e-3, 0.04e-3);
  expect_ledger(result);
  const double mass = 8930 * std::numbers::pi * 3.2e-3 * 3.2e-3 * 32.4e-3;
  EXPECT_NEAR(result.start, 0.5 * mass * 227 * 227, 1e-9 * result.start);
}

} // namespace
} // namespace rubato::verification::taylor_bar_test
