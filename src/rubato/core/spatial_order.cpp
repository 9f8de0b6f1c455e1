// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/core/spatial_order.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>
#include <utility>

namespace rubato {
namespace {

using Eigen::Vector3d;

/// How many of the points go to the first half: a multiple of `together`.
std::size_t first_half(std::size_t count, std::size_t together) {
  const std::size_t parts = (count + together - 1) / together;
  return (parts + 1) / 2 * together;
}

void bisect(std::span<const Vector3d> points, std::size_t together, std::span<std::size_t> order) {
  if (order.size() <= together) {
    std::ranges::sort(order);
    return;
  }
  Eigen::AlignedBox3d box;
  for (const auto i : order)
    box.extend(points[i]);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto half = first_half(order.size(), together);
  std::ranges::nth_element(order, order.begin() + static_cast<std::ptrdiff_t>(half), {},
                           [&](std::size_t i) { return std::pair(points[i][axis], i); });
  bisect(points, together, order.first(half));
  bisect(points, together, order.subspan(half));
}

} // namespace

std::vector<std::size_t> spatial_order(std::span<const Vector3d> points, std::size_t together) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  bisect(points, together, order);
  return order;
}

} // namespace rubato
