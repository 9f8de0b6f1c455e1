// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/motion.hpp"

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
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i)
    sum += to[i] - from[i];
  return sum / static_cast<double>(from.size());
}

double farthest_motion(std::span<const Vector3d> from, std::span<const Vector3d> to, const Vector3d& common) {
  double squared = 0;
  for (std::size_t i = 0; i < from.size(); ++i)
    squared = std::max(squared, (to[i] - from[i] - common).squaredNorm());
  return std::sqrt(squared);
}

} // namespace rubato::contact
