// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/spatial_order.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace rubato::spatial_order_test {
namespace {

using Eigen::Vector3d;

/// A square of n × n points of which neighbours in number are far apart in space.
std::vector<Vector3d> shuffled_square(int n) {
  std::vector<Vector3d> points;
  for (int i = 0; i < n * n; ++i)
    points.emplace_back(i % n, i / n, 0);
  std::mt19937 random(7);
  std::ranges::shuffle(points, random);
  return points;
}

TEST(SpatialOrder, HasEveryPointOnce) {
  const auto points = shuffled_square(13);
  auto order = spatial_order(points, 5);
  std::ranges::sort(order);
  ASSERT_EQ(order.size(), points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    EXPECT_EQ(order[i], i);
}

TEST(SpatialOrder, PutsNeighboursTogether) {
  constexpr std::size_t together = 16;
  const auto points = shuffled_square(32);
  const auto order = spatial_order(points, together);
  for (std::size_t first = 0; first < order.size(); first += together) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = first; i < first + together; ++i)
      box.extend(points[order[i]]);
    EXPECT_EQ(box.sizes(), Vector3d(3, 3, 0)) << first;
  }
}

TEST(SpatialOrder, FillsAllPartsButTheLast) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 23; ++i)
    points.emplace_back(22 - i, 0, 0);
  const auto order = spatial_order(points, 4);
  std::vector<double> x;
  for (const auto i : order)
    x.push_back(points[i][0]);
  for (std::size_t part = 4; part < x.size(); part += 4)
    EXPECT_LT(*std::max_element(x.begin() + static_cast<std::ptrdiff_t>(part - 4),
                                x.begin() + static_cast<std::ptrdiff_t>(part)),
              x[part]);
}

TEST(SpatialOrder, KeepsTheOrderOfPointsAtOnePlace) {
  const std::vector<Vector3d> points(9, Vector3d(1, 2, 3));
  const auto order = spatial_order(points, 2);
  EXPECT_TRUE(std::ranges::is_sorted(order));
}

} // namespace
} // namespace rubato::spatial_order_test
