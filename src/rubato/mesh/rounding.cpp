// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::mesh {
namespace {

using Eigen::Vector3d;

/// The bounding box' edges; NaN when a coordinate is not finite.
Vector3d extent(const Mesh& mesh) {
  if (mesh.points.empty())
    return Vector3d::Zero();
  Vector3d lower = mesh.points.front();
  Vector3d upper = lower;
  for (const auto& point : mesh.points) {
    if (!point.allFinite())
      return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  return upper - lower;
}

bool has_surfaces_only(const Mesh& mesh) {
  const auto dimension = [](const CellBlock& block) { return cell::topology(block.type).dimension; };
  return std::ranges::any_of(mesh.blocks, [&](const auto& block) { return dimension(block) == 2; }) &&
         std::ranges::none_of(mesh.blocks, [&](const auto& block) { return dimension(block) == 3; });
}

} // namespace

double diagonal(const Mesh& mesh) {
  return extent(mesh).norm();
}

bool lay_flat(Mesh& mesh) {
  const auto size = extent(mesh);
  const bool flat = size.z() <= coordinate_rounding * size.norm();
  if (mesh.dimension != 3 || !has_surfaces_only(mesh) || !flat)
    return false;
  mesh.dimension = 2;
  for (auto& point : mesh.points)
    point.z() = 0.0;
  return true;
}

void snap_to_axis(Mesh& mesh) {
  const double rounding = coordinate_rounding * diagonal(mesh);
  for (auto& point : mesh.points)
    if (std::abs(point.x()) <= rounding)
      point.x() = 0.0;
}

} // namespace rubato::mesh
