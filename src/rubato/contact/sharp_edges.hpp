// SPDX-License-Identifier: LGPL-3.0-or-later
/// The parts of a surface between its sharp edges, and the surface whose nodes there stand in it once for
/// every smooth side.
///
/// A node on an edge of a body has no normal of its own, but one of each side. As a slave it is a point of
/// contact on each of them: it may touch with one side, with the other, or with both in a corner.
#pragma once

#include "rubato/contact/surface.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace rubato::contact {

/// Beyond this angle between the normals of its faces an edge is sharp [degrees].
inline constexpr double sharp_edge = 60;

/// The same faces. `nodes` has a node once for every set of its faces that are joined around it by edges of
/// at most 60°: ascending, with repeats; position_of gives the first of them. `undeformed` by position.
Surface with_split_edges(const Surface& surface, std::span<const Eigen::Vector3d> undeformed);

/// Which part each face belongs to: a part is what edges of at most 60° join. Parts are numbered in the order
/// of their first faces. `undeformed` by position.
std::vector<std::size_t> smooth_parts(const Surface& surface, std::span<const Eigen::Vector3d> undeformed);

} // namespace rubato::contact
