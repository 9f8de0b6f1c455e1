// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where a shape that makes a group is.
#pragma once

#include "rubato/study/mesh_source.hpp"

#include <Eigen/Core>

namespace rubato::mesh {

/// How far `place` is from what a box, a sphere, a cylinder or a plane takes [length]: 0 inside and up to
/// `within` from its surface. A cylinder has no ends. Throws std::logic_error for a group of another kind.
double distance_from(const study::MadeGroup& shape, const Eigen::Vector3d& place);

} // namespace rubato::mesh
