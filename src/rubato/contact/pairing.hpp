// SPDX-License-Identifier: LGPL-3.0-or-later
/// Which master face each slave point faces, on the deformed surfaces.
#pragma once

#include "rubato/contact/projection.hpp"
#include "rubato/contact/zone.hpp"

#include <span>
#include <vector>

namespace rubato::contact {

/// A slave point's place on the master surface; master_face = −1 when it faces none. An obstacle is one face,
/// 0, that every point faces, with no coordinates on it.
struct Pair {
  int master_face = -1;
  Projection projection;

  bool paired() const { return master_face >= 0; }
  static Pair before_obstacle() { return {.master_face = 0, .projection = {}}; }
};

/// The projection of each slave point: the faces around the nearest master node are tried; one that holds the
/// orthogonal projection precedes any that doesn't, then the shortest distance wins, of equal ones the first
/// face. A point whose projection lies farther outside the face it got than the zone allows is unpaired
/// (study::ContactZone::projection_tolerance).
std::vector<Pair> find_pairs(const Zone& zone, const Configuration& configuration);

/// The same for one point at `x`; `master` tells where the master's nodes are, `node` which of them is
/// nearest. `guess` is the face it is likely to get or −1: the answer doesn't depend on it, the time it takes
/// does.
Pair pair_around(const Zone& zone, std::size_t node, const Eigen::Vector3d& x,
                 std::span<const Eigen::Vector3d> master, int guess = -1);

/// The same of the faces given, ascending; unpaired when there is none.
Pair pair_among(const Zone& zone, std::span<const int> faces, const Eigen::Vector3d& x,
                std::span<const Eigen::Vector3d> master);

/// The projection of a point at `x` on one face of the master, however far beyond its border.
Pair pair_on(const Zone& zone, int face, const Eigen::Vector3d& x, std::span<const Eigen::Vector3d> master);

/// Current coordinates of a face's nodes.
FaceCoordinates deformed(const Face& face, const Configuration& configuration);

/// Current position of a slave point.
Eigen::Vector3d position(const SlavePoint& point, const Configuration& configuration);

} // namespace rubato::contact
