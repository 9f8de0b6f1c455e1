// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which faces of a surface that touches itself may meet, and which of two is the slave.
///
/// Not met are: faces that share a node; and faces that stand back to back, at the two sides of a thin part
/// of the body, though their normals are opposite as those of faces that touch.
///
/// Were both faces of a pair slaves, each gap would be closed twice, by constraints that depend on each other
/// (two passes; P. Wriggers, Computational Contact Mechanics, 2nd ed., Springer 2006). A face may be slave of
/// one part of the surface and master of another, but of two faces one only is the slave: the one farther
/// along an axis of the model, both undeformed. Faces that meet, and those around them, make a patch, and a
/// patch has one axis: that along which the faces that meet in it are farthest apart undeformed, so that the
/// whole of one side is slave: of a ring that is pressed flat along y the upper half is. Undeformed places
/// don't turn with the body, and the order of two faces stays.
#pragma once

#include "rubato/contact/surface.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace rubato::contact {

class SelfPairs {
public:
  /// Of a surface that outlives it. `undeformed` by position in the surface's nodes; `reach`: how far apart
  /// faces are that may meet, at most [length].
  SelfPairs(const Surface& surface, std::span<const Eigen::Vector3d> undeformed, double reach);

  /// Finds the patches where nodes are at `x`, by position. Faces in no patch are ordered pair by pair.
  void update(std::span<const Eigen::Vector3d> x);

  /// Whether they may meet with the first as the slave; never both (a, b) and (b, a).
  bool may_pair(int slave_face, int master_face) const;
  /// Of faces with these unit normals, by index.
  bool face_each_other(std::span<const Eigen::Vector3d> normals, int one, int other) const;
  double reach() const { return reach_; }
  /// Whether they may meet with either of them as the slave: they share no node and are not back to back.
  bool may_meet(int one, int other) const;

private:
  using Meeting = std::pair<int, int>;
  bool share_a_node(const Face& one, const Face& other) const;
  bool back_to_back(std::size_t one, std::size_t other) const;
  std::vector<Meeting> meetings(std::span<const Eigen::Vector3d> x) const;
  int axis_of(std::size_t one, std::size_t other) const;

  const Surface* surface_;
  double reach_;
  std::vector<Eigen::Vector3d> centres_; ///< undeformed, one a face
  std::vector<Eigen::Vector3d> normals_; ///< unit, out of the body, undeformed
  std::vector<double> sizes_;            ///< largest distance of a node from the centre
  std::vector<int> axis_of_face_;        ///< of the patch it is in, or −1
};

/// The unit normals of the faces' corners where nodes are at `x`, by position; 0 of a face without area.
std::vector<Eigen::Vector3d> unit_normals(const Surface& surface, std::span<const Eigen::Vector3d> x);

} // namespace rubato::contact
