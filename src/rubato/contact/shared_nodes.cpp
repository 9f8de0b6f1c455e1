// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/shared_nodes.hpp"

#include "rubato/contact/kinematics.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/contact/zone.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace rubato::contact {
namespace {

/// The sine of 10 degrees.
constexpr double same_surface = 0.17;

bool shares_nodes(const Zone& zone) {
  return zone.points_own_multipliers && !zone.settings.tie;
}

} // namespace

std::vector<std::vector<PointOfZone>> points_of_shared_nodes(std::span<const Zone> zones) {
  std::map<mesh::NodeIndex, std::vector<PointOfZone>> of_node;
  for (std::size_t z = 0; z < zones.size(); ++z)
    for (std::size_t i = 0; shares_nodes(zones[z]) && i < zones[z].points.size(); ++i)
      if (const auto& point = zones[z].points[i]; !point.excluded && point.node_position >= 0)
        of_node[zones[z].slave.nodes[static_cast<std::size_t>(point.node_position)]].push_back({z, i});
  std::vector<std::vector<PointOfZone>> groups;
  for (auto& [node, points] : of_node)
    if (points.size() > 1 &&
        std::ranges::any_of(points, [&](const auto& p) { return zones[p.zone].settings.friction > 0; }))
      groups.push_back(std::move(points));
  return groups;
}

FrictionDirections common_directions(const Kinematics& of, std::span<const Eigen::Vector3d> normals) {
  const bool in_plane = of.stencil.components == 2;
  FrictionDirections left;
  for (const auto& normal : normals) {
    const Eigen::Vector2d across(dot(column_of(of.tangents, 0), normal),
                                 dot(column_of(of.tangents, 1), normal));
    const double size = in_plane ? std::abs(across[0]) : length_of(across);
    if (size <= same_surface)
      continue;
    if (in_plane || (left.count == 1 && std::abs(dot(across, left.only)) > same_surface))
      return {.count = 0};
    left = {.count = 1, .only = {-across[1] / size, across[0] / size}};
  }
  return left;
}

} // namespace rubato::contact
