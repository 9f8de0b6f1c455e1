// SPDX-License-Identifier: LGPL-3.0-or-later
/// Slave nodes with several points of contact: in several zones, or on both sides of an edge.
///
/// Where two of them press, their gaps determine the motion of the node along both normals. Friction of one
/// along the normal of the other determines it a second time: the forces are not unique then, and iterations
/// pass them from one point to the other. Friction of such points acts along directions only that are
/// tangential to both surfaces: along the edge that these form in space, along none in the plane.
///
/// Points of several zones on one node before the same master have the same gap along the same normal. The
/// gap closes once, and how its force is distributed to the zones is undetermined. One point represents them
/// with the sum of their areas; each reports the same pressure, and its part of the force by its area.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::contact {

struct Kinematics;
struct PointOutcome;
struct Zone;
struct ZoneState;

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

/// Joins the points of nodes that several zones share before the same master or obstacle, where their method
/// closes gaps exactly at nodes. The first point with friction, else the first one, gets the areas of all and
/// the mean of their coefficients of friction; the others are excluded.
void join_shared_points(std::span<Zone> zones);

/// Distributes what representing points do, in proportion to areas: outcomes, statuses and multipliers.
/// `states`: those of the zones at the end of a step, whose excluded points did nothing.
void distribute_shared_points(std::span<const Zone> zones, std::span<ZoneState> states);

/// The outcome of all points that one point represents. `outcome`: its own part of that.
PointOutcome whole_outcome(const Zone& zone, std::size_t point, const PointOutcome& outcome);

/// What is tangential to the surface of a point and to those with these normals, unit vectors. Normals within
/// 10 degrees of the point's, its own too, count as the same surface.
FrictionDirections common_directions(const Kinematics& of, std::span<const Eigen::Vector3d> normals);

} // namespace rubato::contact
