// SPDX-License-Identifier: LGPL-3.0-or-later
/// Whole rings from generated rectangles: x is the angle from 0 to 2π, y the radius; those of radii below 1
/// are pins.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <Eigen/Core>

#include <functional>

namespace rubato::test {

/// Where a node of that angle and radius is put.
using RingShape = std::function<Eigen::Vector3d(double angle, double radius)>;

Eigen::Vector3d circle(double angle, double radius);

/// Joins the ends that meet and takes pins to circles, the rings around them to `shape`.
mesh::Mesh closed_rings(mesh::Mesh mesh, const RingShape& shape = circle);

} // namespace rubato::test
