// SPDX-License-Identifier: LGPL-3.0-or-later
/// How far points have come from one configuration to another.
#pragma once

#include <Eigen/Core>

#include <span>

namespace rubato::contact {

/// Of at least one point.
Eigen::Vector3d mean_motion(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to);

/// The longest way of a point, without the part `common` of all ways [length].
double farthest_motion(std::span<const Eigen::Vector3d> from, std::span<const Eigen::Vector3d> to,
                       const Eigen::Vector3d& common);

} // namespace rubato::contact
