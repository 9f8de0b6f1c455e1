// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where a surface has edges and kinks, undeformed: a body that was smooth stays so however it deforms.
#pragma once

#include "rubato/contact/surface.hpp"

#include <Eigen/Core>

#include <span>

namespace rubato::contact {

/// Sets Surface::at_edge and Face::kinks. `undeformed` by position.
///
/// A node is at an edge where one face alone has an edge of its cells (2D: an end), and where two faces meet
/// at more than 60°. The kink of a face at a node is 1 − |mean n|, n the unit normals there of all faces
/// around the node within 60° of its own: 1 − cos φ/2 of two faces at an angle φ, and 0 of a flat surface.
void measure_kinks(std::span<const Eigen::Vector3d> undeformed, Surface& surface);

} // namespace rubato::contact
