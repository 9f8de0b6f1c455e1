// SPDX-License-Identifier: LGPL-3.0-or-later
/// The two sides of sets of faces that meet each other.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <vector>

namespace rubato::contact {

struct FlatFace;

/// Of two faces: whether they belong to different sides or to the same one.
struct Joint {
  double apart = 0; ///< joints are taken in this order; of equal ones first those of different sides
  bool opposite = false;
  int one = 0, other = 0;
};

/// The set and the side of each face.
struct Side {
  int set = 0;
  bool other = false; ///< not that of the set's own face
};

/// Joins faces in the order of the joints. A joint between faces that are joined already says nothing more.
std::vector<Side> two_sides(std::size_t faces, std::vector<Joint> joints);

/// Of each face whether it is on the side of its set whose centre, the mean of its faces, is farther along
/// the axis on which the two centres are farthest apart; of sides with the same centre, that with the first
/// face.
std::vector<char> farther_sides(std::span<const Side> sides, std::span<const FlatFace> undeformed);

/// The first axis that no later one is clearly stronger than: directions between two axes keep theirs.
int strongest_axis(const Eigen::Vector3d& along);

} // namespace rubato::contact
