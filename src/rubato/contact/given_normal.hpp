// SPDX-License-Identifier: LGPL-3.0-or-later
/// Contact normals that are not those of the master's face alone. They come from the slave's normal n_s
/// (slave_normal.hpp), from averages n_m at the master's nodes (averaged_normal.hpp), or from both. Each is
/// the unit of
///
///   slave               −n_s
///   average             n − n_s, with n the normal of the master's face, or n_m/|n_m| of smoothed ones
///   master, smoothed    n_m
#pragma once

#include "rubato/contact/zone.hpp"

#include <Eigen/Core>

#include <array>
#include <span>

namespace rubato::contact {

struct GivenNormal {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(); ///< what it is the unit of, less the face's n if that counts
  bool adds_face = false;                        ///< whether the normal n of the master's face is added
  /// ∂sum/∂ξ of averages at the master's nodes. Else 0.
  std::array<Eigen::Vector3d, 2> by_place{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
};

/// Returns whether the zone has such normals.
bool gives_normal(const study::ContactZone& settings);
/// Returns whether the nodes around a master face turn the normal there.
bool averages_master(const study::ContactZone& settings);

/// At ξ of a face of the master.
GivenNormal given_normal(const Zone& zone, const SlavePoint& point, int face, const Eigen::Vector2d& xi,
                         const Configuration& configuration);

/// −∂sum/∂u at a ξ that does not move. `nodes` are the point's, then the master's that turn the normal: one
/// column a component of each.
void vary_given_normal(const Zone& zone, const SlavePoint& point, int face, const Eigen::Vector2d& xi,
                       const Configuration& configuration, std::span<const mesh::NodeIndex> nodes,
                       Eigen::Matrix<double, 3, Eigen::Dynamic>& into);

} // namespace rubato::contact
