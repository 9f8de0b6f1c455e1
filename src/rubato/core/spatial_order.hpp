// SPDX-License-Identifier: LGPL-3.0-or-later
/// Points in parts that lie together in space.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace rubato {

/// The indices of the points, by recursive bisection across the longest side of their box, down to parts of
/// at most `together` points, in which they ascend. All parts but the last have as many. Of points at one
/// coordinate those with the lower indices come first.
std::vector<std::size_t> spatial_order(std::span<const Eigen::Vector3d> points, std::size_t together);

} // namespace rubato
