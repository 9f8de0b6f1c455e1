// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/step/common/spatial_order.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <numeric>

namespace rubato::step {
namespace {

using Eigen::Vector3d;

/// How many of the points go to the first half: a multiple of `together`.
std::size_t first_half(std::size_t count, std::size_t together) {
  const std::size_t parts = (count + together - 1) / together;
  return (parts + 1) / 2 * together;
}

void bisect(std::span<const Vector3d> points, std::size_t together, std::span<std::size_t> order) {
  if (order.size() <= together)
    return;
  Eigen::AlignedBox3d box;
  for (const auto i : order)
    box.extend(points[i]);
  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(points[i][axis], i); });
  const auto half = first_half(order.size(), together);
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

std::vector<int> in_spatial_order(const model::Model& model, std::span<const int> unknowns,
                                  std::size_t together) {
  const auto& dofs = model.reduction.free_dofs();
  std::vector<Vector3d> points;
  std::vector<std::size_t> first; ///< of each node in `unknowns`
  mesh::NodeIndex last = -1;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const auto node = model.node_of(dofs[static_cast<std::size_t>(unknowns[i])]);
    if (node == last)
      continue;
    last = node;
    first.push_back(i);
    points.push_back(model.mesh.points[static_cast<std::size_t>(node)]);
  }
  first.push_back(unknowns.size());
  std::vector<int> ordered;
  ordered.reserve(unknowns.size());
  for (const auto i : spatial_order(points, together))
    for (std::size_t k = first[i]; k < first[i + 1]; ++k)
      ordered.push_back(unknowns[k]);
  return ordered;
}

} // namespace rubato::step
