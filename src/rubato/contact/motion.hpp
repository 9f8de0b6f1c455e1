// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the nodes of a surface are, and how far points have come from one configuration to another.
#pragma once

#include "rubato/contact/zone.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::contact {

/// By position in the surface's nodes.
std::vector<Eigen::Vector3d> positions_of(const Surface& surface, const Configuration& configuration);

/// Of at least one point.
Eigen::Vector3d mean_motion(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to);

/// The longest way of a point, without the part `common` of all ways [length].
double farthest_motion(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to,
                       const Eigen::Vector3d& common);

} // namespace rubato::contact
