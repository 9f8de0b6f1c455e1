// SPDX-License-Identifier: LGPL-3.0-or-later
/// The pairs of find_pairs for motions in many short steps, without a search of the surface in each.
///
/// A search keeps for every slave point the master nodes up to a margin s farther than its nearest one. While
/// slave points have moved by at most a and master nodes by at most b since (common translation aside), a
/// node left out cannot have become the nearest before 2 (a + b) > s; only then the search is repeated. (L.
/// Verlet, Computer "experiments" on classical fluids I, Phys. Rev. 159, 1967, keeps such lists of
/// neighbours.)
///
/// Hopping. In a valley between two faces each of them pushes the point onto the other one, and on a ridge
/// off itself: no iterate ends on the face that its forces were computed with, and the answer lies on their
/// common edge. A point that comes back to a face it has left in the same attempt at a step therefore stays
/// on one of the two, the first in the surface, continued a little beyond its border: normal and place are
/// smooth there.
///
/// Of a surface that touches itself a point faces only what is the master of a face it stands on
/// (self_pairs.hpp), where the step begins, and what looks towards it.
#pragma once

#include "rubato/contact/pairing.hpp"
#include "rubato/contact/self_pairs.hpp"
#include "rubato/contact/zone.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace rubato::contact {

class NeighbourList {
public:
  explicit NeighbourList(const Zone& zone);

  /// Takes the pairs to a configuration. Allocates only when it searches. Before an obstacle there is nothing
  /// to search.
  void update(const Configuration& configuration);
  /// The same of some of the slave points: the other pairs stay what they were.
  void update(const Configuration& configuration, std::span<const std::size_t> points);
  /// What find_pairs gives there, one a slave point, but for points that hop between faces.
  std::span<const Pair> pairs() const { return pairs_; }

  /// Forgets which faces the points have been on: Newton's iterations begin.
  void forget_visits();
  /// Lets points go that stay on a face and have come to stand more than a trace beyond its border, each
  /// once: they may have hopped only on the way. Whether there were any.
  bool release_beyond_borders();

  const Zone& zone() const { return *zone_; }
  int searches() const { return searches_; }

private:
  void follow(const Configuration& configuration);
  void pair(std::size_t point);
  void note_visit(std::size_t point);
  bool stays_on(std::size_t point, int face);
  void locate(const Configuration& configuration);
  double moved_since_search() const;
  void search();
  std::size_t nearest_of(std::size_t point) const;

  void follow_itself(const Configuration& configuration);
  void pair_with_itself(std::size_t point);
  bool may_face(std::size_t point, int face) const;

  /// Faces that a point has been on, the last one first.
  struct Visits {
    std::array<int, 4> faces{-1, -1, -1, -1};
    int kept_face = -1; ///< the face that it stays on, beyond its border too, or −1
    double beyond = 0;  ///< how far it is outside that face, in its reference lengths
    bool released = false;
  };

  using Points = std::vector<Eigen::Vector3d>;
  const Zone* zone_;
  double margin_;
  Points master_; ///< where the master's nodes and the slave's points are
  Points slave_;
  Points master_at_search_;
  Points slave_at_search_;
  std::vector<std::size_t> start_;        ///< of each slave point in near_; one more at the end
  std::vector<std::uint32_t> near_nodes_; ///< positions in the master's nodes
  std::vector<Pair> pairs_;
  std::vector<Visits> visits_; ///< of each slave point in this attempt
  int searches_ = 0;

  std::optional<SelfPairs> self_; ///< of a surface that touches itself: as it is where the step begins
  Points step_start_;             ///< of the master's nodes there
  Points normals_;                ///< of its faces, unit, at the configuration at hand
};

} // namespace rubato::contact
