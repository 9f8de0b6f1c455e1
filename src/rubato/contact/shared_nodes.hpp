// SPDX-License-Identifier: LGPL-3.0-or-later
/// Slave nodes with several points of contact: in several zones, or on both sides of an edge.
///
/// Where two of them press, their gaps determine the motion of the node along both normals. Friction of one
/// along the normal of the other determines it a second time: the forces are not unique then, and iterations
/// pass them from one point to the other. Friction of such points acts along directions only that are
/// tangential to both surfaces: along the edge that these form in space, along none in the plane.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::contact {

struct Kinematics;
struct Zone;

struct PointOfZone {
  std::size_t zone = 0;
  std::size_t point = 0;
};

/// Along which tangential directions friction of a point acts.
struct FrictionDirections {
  int count = 2;                                  ///< 2 all, 1 along `only`, 0 none
  Eigen::Vector2d only = Eigen::Vector2d::Zero(); ///< a unit vector among τ₁, τ₂
};

/// The points of each slave node that has several, where one of their zones has friction. Points of ties,
/// excluded ones and those that share multipliers with others are in none.
std::vector<std::vector<PointOfZone>> points_of_shared_nodes(std::span<const Zone> zones);

/// What is tangential to the surface of a point and to those with these normals, unit vectors. Normals within
/// 10 degrees of the point's, its own too, count as the same surface.
FrictionDirections common_directions(const Kinematics& of, std::span<const Eigen::Vector3d> normals);

} // namespace rubato::contact
