// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/pairing.hpp"

#include "rubato/cell/reference_nodes.hpp"
#include "rubato/cell/topology.hpp"
#include "rubato/contact/point_tree.hpp"
#include "rubato/contact/small_vectors.hpp"
#include "rubato/core/tolerances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rubato::contact {
namespace {

using Eigen::Vector3d;

/// Squared distances this near to each other, relatively, may be the same.
constexpr double rounding = 1e-9;
/// Distances this near to each other, in edges of the surface, are the same: of faces that see a point beside
/// the node they share rounding would choose one, and its normal.
constexpr double same_distance = 1e-12;

struct Candidate {
  int face = -1;
  Projection projection;
  double distance = INFINITY;

  /// Of equally good faces the first in the zone wins, in whatever order they are tried.
  bool precedes(const Candidate& other, double rounding_of_distance) const {
    if (other.face < 0)
      return true;
    if (projection.inside() != other.projection.inside())
      return projection.inside();
    if (std::abs(distance - other.distance) <= rounding_of_distance)
      return face < other.face;
    return distance < other.distance;
  }
};

/// Whether no place of the face can be as near to the point as that. Only faces without midside nodes lie in
/// the box of their nodes.
bool is_farther(const Face& face, const FaceCoordinates& nodes, const Vector3d& point, double distance) {
  if (face.node_count != cell::topology(face.type).corner_count)
    return false;
  double squared = 0;
  for (int i = 0; i < 3; ++i) {
    double low = nodes(i, 0), high = low;
    for (int node = 1; node < face.node_count; ++node) {
      low = std::min(low, nodes(i, node));
      high = std::max(high, nodes(i, node));
    }
    const double outside = std::max({low - point[i], point[i] - high, 0.0});
    squared += outside * outside;
  }
  return squared > (1 + rounding) * distance * distance;
}

/// Tries one more face.
void consider(const Zone& zone, int face_index, const Vector3d& point, std::span<const Vector3d> master,
              Candidate& best) {
  const auto& face = zone.master.faces[static_cast<std::size_t>(face_index)];
  const auto nodes = values_of(face, master);
  const bool one_inside = best.face >= 0 && best.projection.inside();
  const double rounding_of_distance = same_distance * zone.master.longest_edge;
  if (one_inside && is_farther(face, nodes, point, best.distance + rounding_of_distance))
    return;
  Candidate candidate{face_index, project(face.type, nodes, point, one_inside ? Wanted::inside : Wanted::any),
                      0};
  if (one_inside && !candidate.projection.inside())
    return;
  candidate.distance =
      length_of(difference_of(point, face_position(face.type, nodes, candidate.projection.clamped)));
  if (candidate.precedes(best, rounding_of_distance))
    best = candidate;
}

/// The length of an edge of the reference face.
double reference_length(CellType type) {
  return cell::topology(type).corner_count == 3 ? 1 : 2;
}

/// Moves the clamped place to the node of the face that is nearest to the point, where it stays.
void move_to_node(CellType type, const FaceCoordinates& nodes, const Vector3d& point,
                  Projection& projection) {
  int nearest = 0;
  double least = INFINITY;
  for (int node = 0; node < cell::topology(type).node_count; ++node) {
    const double distance = length_of(difference_of(point, column_of(nodes, node)));
    // The first node counts if several are equally near, regardless of rounding.
    if (distance < (1 - rounding) * least) {
      nearest = node;
      least = distance;
    }
  }
  const Vector3d xi = cell::reference_node(type, nearest);
  projection.clamped = {xi[0], xi[1]};
  projection.clamp_derivative.setZero();
  // A projection inside would move the place with the point.
  projection.overshoot = std::max(projection.overshoot, std::numeric_limits<double>::min());
}

/// Unpaired where there is no face, or the projection lies too far outside it.
Pair pair_of(const Zone& zone, const Candidate& best, const Vector3d& point,
             std::span<const Vector3d> master) {
  if (best.face < 0)
    return {};
  const auto& face = zone.master.faces[static_cast<std::size_t>(best.face)];
  const auto type = face.type;
  const double allowed =
      zone.settings.projection_tolerance.value_or(tolerances.paired_overshoot * reference_length(type));
  if (!(best.projection.overshoot <= allowed))
    return {};
  Pair pair{best.face, best.projection};
  if (zone.settings.nodal_pairs)
    move_to_node(type, values_of(face, master), point, pair.projection);
  return pair;
}

} // namespace

Pair pair_around(const Zone& zone, std::size_t node, const Vector3d& x, std::span<const Vector3d> master,
                 int guess) {
  const auto& faces = zone.master.faces_of_node[node];
  const bool guessed = std::find(faces.begin(), faces.end(), guess) != faces.end();
  Candidate best;
  if (guessed)
    consider(zone, guess, x, master, best);
  for (const int face : faces)
    if (!guessed || face != guess)
      consider(zone, face, x, master, best);
  return pair_of(zone, best, x, master);
}

Pair pair_among(const Zone& zone, std::span<const int> faces, const Vector3d& x,
                std::span<const Vector3d> master) {
  Candidate best;
  for (const int face : faces)
    consider(zone, face, x, master, best);
  return pair_of(zone, best, x, master);
}

Pair pair_on(const Zone& zone, int face, const Vector3d& x, std::span<const Vector3d> master) {
  const auto& of_zone = zone.master.faces[static_cast<std::size_t>(face)];
  const auto nodes = values_of(of_zone, master);
  Pair pair{face, project(of_zone.type, nodes, x)};
  if (zone.settings.nodal_pairs)
    move_to_node(of_zone.type, nodes, x, pair.projection);
  return pair;
}

FaceCoordinates deformed(const Face& face, const Configuration& configuration) {
  FaceCoordinates coordinates(3, face.node_count);
  for (int i = 0; i < face.node_count; ++i)
    set_column(i, configuration.position(face.nodes[static_cast<std::size_t>(i)]), coordinates);
  return coordinates;
}

Vector3d position(const SlavePoint& point, const Configuration& configuration) {
  if (point.node_position >= 0)
    return configuration.position(point.nodes.front());
  Vector3d x(0, 0, 0);
  for (std::size_t i = 0; i < point.nodes.size(); ++i)
    if (point.shape[i] != 0)
      add_scaled(point.shape[i], configuration.position(point.nodes[i]), x);
  return x;
}

std::vector<Pair> find_pairs(const Zone& zone, const Configuration& configuration) {
  if (zone.obstacle)
    return std::vector(zone.points.size(), Pair::before_obstacle());
  std::vector<Vector3d> master;
  master.reserve(zone.master.nodes.size());
  for (const auto node : zone.master.nodes)
    master.push_back(configuration.position(node));
  const PointTree tree(master);

  std::vector<Pair> pairs;
  pairs.reserve(zone.points.size());
  for (const auto& point : zone.points) {
    const Vector3d x = position(point, configuration);
    pairs.push_back(pair_around(zone, tree.nearest(x).index, x, master));
  }
  return pairs;
}

} // namespace rubato::contact
