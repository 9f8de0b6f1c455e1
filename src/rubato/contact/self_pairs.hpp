// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which faces of a surface that touches itself may meet, and which of two is the slave.
///
/// Not met are: faces that share a node; and faces that stand back to back, at the two sides of a thin part
/// of the body, though their normals are opposite as those of faces that touch.
///
/// Were both faces of a pair slaves, each gap would be closed twice, by constraints that depend on each other
/// (two passes; P. Wriggers, Computational Contact Mechanics, 2nd ed., Springer 2006). Of faces that meet one
/// only is the slave, and its neighbours are slaves as well: where a step begins, faces get one of two sides,
/// by joining them in the order of their distance, faces that meet to different sides and neighbours to the
/// same one, unless they are joined already (J. Kruskal, Proc. Am. Math. Soc. 7 (1956) 48–50). Of the two
/// sides of a set that is joined the one farther along an axis, undeformed, is the slave: that axis along
/// which their centres are farthest apart. The order does not change in iterations.
#pragma once

#include "rubato/contact/surface.hpp"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace rubato::contact {

/// A face seen as flat.
struct FlatFace {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero(); ///< unit, out of the body; 0 without area
  double size = 0;                                  ///< largest distance of a node from the centre
};

class SelfPairs {
public:
  /// Of a surface that outlives it. `undeformed` by position in the surface's nodes; `reach`: how far apart
  /// faces are that may meet, at most [length].
  SelfPairs(const Surface& surface, std::span<const Eigen::Vector3d> undeformed, double reach);

  /// Finds the sides where nodes are at `x`, by position.
  void update(std::span<const Eigen::Vector3d> x);

  /// Whether they may meet with the first as the slave; never both (a, b) and (b, a). Faces without a side,
  /// those that are far from all others, are ordered pair by pair.
  bool may_pair(int slave_face, int master_face) const;
  /// Of faces with these unit normals, by index.
  bool face_each_other(std::span<const Eigen::Vector3d> normals, int one, int other) const;
  /// How far apart faces are that may meet where nodes have come to `x` in the step: more by as much as two
  /// of them can have come nearer since it began, so that none passes another one unseen.
  double reach_at(std::span<const Eigen::Vector3d> x) const;
  /// Whether they may meet with either of them as the slave.
  bool may_meet(int one, int other) const;

private:
  enum class Role : std::uint8_t { none, master, slave };
  struct Meeting {
    int one = 0, other = 0;
    double apart = 0; ///< how soon they meet [length]
  };

  bool share_a_node(const Face& one, const Face& other) const;
  bool back_to_back(std::size_t one, std::size_t other) const;
  bool is_behind(std::size_t one, std::size_t other) const;
  bool is_before(int one, int other) const;
  bool is_passed_over(std::size_t one, std::size_t other) const;
  void measure_thickness();
  std::vector<Meeting> meetings() const;
  void give_roles(std::span<const Meeting> meetings);

  const Surface* surface_;
  double reach_;
  std::vector<FlatFace> undeformed_;
  std::vector<FlatFace> now_;          ///< where the step begins
  std::vector<Eigen::Vector3d> start_; ///< places of the nodes there
  std::vector<double> thickness_; ///< of the body behind each face, undeformed; infinite where it is thick
  std::vector<std::pair<int, int>> neighbours_; ///< faces that share a node of the surface
  std::vector<std::vector<int>> across_edge_;   ///< of each face those beyond a sharp edge (sharp_edges.hpp)
  std::vector<Role> role_;
};

/// The unit normals of the faces' corners where nodes are at `x`, by position; 0 of a face without area.
std::vector<Eigen::Vector3d> unit_normals(const Surface& surface, std::span<const Eigen::Vector3d> x);

} // namespace rubato::contact
