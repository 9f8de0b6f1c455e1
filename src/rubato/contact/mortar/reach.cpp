// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/reach.hpp"

#include "rubato/contact/mortar/frames.hpp"
#include "rubato/contact/motion.hpp"
#include "rubato/contact/point_tree.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector3d;

/// Normals of master nodes at an edge are those of no side: depth along them is up to half too small.
constexpr double depth_factor = 2;
/// Of the longest face: twice the sag of a chord as long as the radius.
constexpr double largest_sag = 0.25;

/// Of every slave node, behind the master node that is nearest to it.
std::vector<double> depths_of(const Surface& master, std::span<const Vector3d> slave_x,
                              std::span<const Vector3d> master_x) {
  std::vector<Vector3d> normals;
  nodal_normals(master, master_x, {}, normals);
  const PointTree tree(master_x);
  std::vector<double> depths;
  for (const auto& x : slave_x) {
    const auto nearest = tree.nearest(x).index;
    depths.push_back(std::max(0., dot(difference_of(master_x[nearest], x), normals[nearest])));
  }
  return depths;
}

} // namespace

void ReachInStep::begin(const Surface& slave, const Surface& master, std::span<const Vector3d> slave_x,
                        std::span<const Vector3d> master_x, double longest_face) {
  slave_.assign(slave_x.begin(), slave_x.end());
  master_.assign(master_x.begin(), master_x.end());
  const auto depths = depths_of(master, slave_x, master_x);
  const double sag = largest_sag * std::max(longest_face, master.longest_edge);
  resting_.clear();
  for (const auto& face : slave.faces) {
    double depth = 0;
    for (std::size_t i = 0; i < face.node_span().size(); ++i)
      depth = std::max(depth, depths[static_cast<std::size_t>(face.positions[i])]);
    resting_.push_back({longest_face + depth_factor * depth, sag + depth_factor * depth});
  }
}

std::span<const Reach> ReachInStep::at(std::span<const Vector3d> slave_x,
                                       std::span<const Vector3d> master_x) {
  const Vector3d common = mean_motion(slave_, slave_x);
  const double way = farthest_motion(slave_, slave_x, common) + farthest_motion(master_, master_x, common);
  now_ = resting_;
  for (auto& reach : now_) {
    reach.ahead += way;
    reach.behind += way;
  }
  return now_;
}

} // namespace rubato::contact::mortar
