// SPDX-License-Identifier: LGPL-3.0-or-later
/// The pairs of find_pairs for motions in many short steps, without a search of the surface in each.
///
/// A search keeps for every slave point the master nodes up to a margin s farther than its nearest one. While
/// slave points have moved by at most a and master nodes by at most b since (common translation aside), a
/// node left out cannot have become the nearest before 2 (a + b) > s; only then the search is repeated. (L.
/// Verlet, Computer "experiments" on classical fluids I, Phys. Rev. 159, 1967, keeps such lists of
/// neighbours.)
#pragma once

#include "rubato/contact/pairing.hpp"
#include "rubato/contact/zone.hpp"

#include <cstdint>
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
  /// What find_pairs gives there, one a slave point.
  std::span<const Pair> pairs() const { return pairs_; }

  const Zone& zone() const { return *zone_; }
  int searches() const { return searches_; }

private:
  void follow(const Configuration& configuration);
  void pair(std::size_t point);
  void locate(const Configuration& configuration);
  double moved_since_search() const;
  void search();
  std::size_t nearest_of(std::size_t point) const;

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
  int searches_ = 0;
};

} // namespace rubato::contact
