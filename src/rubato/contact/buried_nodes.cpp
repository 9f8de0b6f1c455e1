// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/buried_nodes.hpp"

#include "rubato/contact/mortar/frames.hpp"
#include "rubato/contact/motion.hpp"
#include "rubato/contact/point_tree.hpp"
#include "rubato/contact/projection.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;

/// Behind one face whose normal is against `normal`; 0 in front of it, beside it or where they do not face.
double depth_behind(const Face& face, const std::vector<Vector3d>& slave_x, const Vector3d& x,
                    const Vector3d& normal) {
  const auto nodes = values_of(face, slave_x);
  const auto place = project(face.type, nodes, x, Wanted::inside);
  if (!place.converged || !place.inside())
    return 0;
  const auto at = face_geometry(face.type, nodes, place.xi);
  const auto outward = unit_of(cross(column_of(at.tangents, 0), column_of(at.tangents, 1)));
  return dot(outward, normal) < 0 ? std::max(0., dot(outward, difference_of(at.position, x))) : 0;
}

} // namespace

BuriedNodes::BuriedNodes(const Zone& zone, std::vector<double> shallow)
    : zone_(&zone), shallow_(std::move(shallow)), near_(zone.master.nodes.size(), 0) {}

std::vector<double> BuriedNodes::depths(const Configuration& configuration) {
  const auto slave_x = positions_of(zone_->slave, configuration);
  const auto master_x = positions_of(zone_->master, configuration);
  const auto is_near = [&](std::size_t i) {
    const auto apart = difference_of(slave_x[near_[i]], master_x[i]);
    return dot(apart, apart) <= shallow_[i] * shallow_[i];
  };
  std::vector<double> depths(master_x.size(), 0.);
  std::optional<PointTree> tree; // most often neither is asked for
  std::vector<Vector3d> normals;
  for (std::size_t i = 0; i < master_x.size(); ++i) {
    if (is_near(i))
      continue;
    if (!tree)
      tree.emplace(slave_x);
    near_[i] = tree->nearest(master_x[i]).index;
    if (is_near(i))
      continue;
    if (normals.empty())
      mortar::nodal_normals(zone_->master, master_x, {}, normals);
    for (const int face : zone_->slave.faces_of_node[near_[i]])
      depths[i] = std::max(depths[i], depth_behind(zone_->slave.faces[static_cast<std::size_t>(face)],
                                                   slave_x, master_x[i], normals[i]));
  }
  return depths;
}

std::vector<double> edges_around(const mesh::Mesh& mesh, const Surface& surface) {
  std::vector<double> shortest(surface.nodes.size(), std::numeric_limits<double>::infinity());
  for (const auto& face : surface.faces)
    for (const auto& [from, to] : cell::topology(face.type).edges) {
      const auto& a = mesh.points[static_cast<std::size_t>(face.nodes[from])];
      const auto& b = mesh.points[static_cast<std::size_t>(face.nodes[to])];
      for (int i = 0; i < face.node_count; ++i) {
        auto& edge = shortest[static_cast<std::size_t>(face.positions[static_cast<std::size_t>(i)])];
        edge = std::min(edge, length_of(difference_of(b, a)));
      }
    }
  return shortest;
}

} // namespace rubato::contact
