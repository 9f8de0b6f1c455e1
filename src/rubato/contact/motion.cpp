// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/motion.hpp"

#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <cmath>

namespace rubato::contact {

using Eigen::Vector3d;

std::vector<Vector3d> positions_of(const Surface& surface, const Configuration& configuration) {
  std::vector<Vector3d> x;
  x.reserve(surface.nodes.size());
  for (const auto node : surface.nodes)
    x.push_back(configuration.position(node));
  return x;
}

Vector3d mean_motion(std::span<const Vector3d> from, std::span<const Vector3d> to) {
  Vector3d sum(0, 0, 0);
  for (std::size_t i = 0; i < from.size(); ++i)
    add_scaled(1, difference_of(to[i], from[i]), sum);
  const auto count = static_cast<double>(from.size());
  return {sum[0] / count, sum[1] / count, sum[2] / count};
}

double farthest_motion(std::span<const Vector3d> from, std::span<const Vector3d> to, const Vector3d& common) {
  double squared = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const auto own = difference_of(difference_of(to[i], from[i]), common);
    squared = std::max(squared, dot(own, own));
  }
  return std::sqrt(squared);
}

} // namespace rubato::contact
