// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/mortar/frames.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/face_edges.hpp"
#include "rubato/contact/projection.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace rubato::contact::mortar {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A direction's part across the normal below that, of its length, is none.
constexpr double no_direction = 1e-8;

double radians(double degrees) {
  return degrees * std::numbers::pi / 180;
}

Vector2d node_place(CellType type, std::size_t node) {
  const auto& place = cell::reference_cell(type).nodes[node];
  return {place[0], place[1]};
}

/// The local node that τ₁ of a local node points at (see tangent_neighbours).
int neighbour_in(CellType type, int node) {
  const auto& cell = cell::topology(type);
  if (cell.dimension == 1)
    return node == 0 ? 1 : 0;
  if (node >= cell.corner_count + static_cast<int>(cell.edges.size()))
    return cell.corner_count;
  if (node >= cell.corner_count)
    return cell.edges[static_cast<std::size_t>(node - cell.corner_count)][0];
  return cell.order == 2 ? cell.corner_count + node : cell.edges[static_cast<std::size_t>(node)][1];
}

Vector3d any_across(const Vector3d& n) {
  int smallest = 0;
  for (const int axis : {1, 2})
    if (std::abs(n[axis]) < std::abs(n[smallest]))
      smallest = axis;
  return unit_of(cross(Vector3d(smallest == 0, smallest == 1, smallest == 2), n));
}

/// Where an edge of a face stands: the face, and ξ of the edge's middle.
struct EdgePlace {
  int face = 0;
  Vector2d xi = Vector2d::Zero();
};
using Edge = std::array<mesh::NodeIndex, 2>;

Edge nodes_of(const Face& face, const LocalEdge& side) {
  const auto [low, high] = std::minmax(face.nodes[static_cast<std::size_t>(side.from)],
                                       face.nodes[static_cast<std::size_t>(side.to)]);
  return {low, high};
}

EdgePlace place_on(const Face& face, int index, const LocalEdge& side) {
  const auto from = node_place(face.type, static_cast<std::size_t>(side.from));
  const auto to = node_place(face.type, static_cast<std::size_t>(side.to));
  return {index, Vector2d(0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]))};
}

} // namespace

/// The turn is small where n·n′/|n′| = |n′| is near 1.
void remove_held(HeldComponents held, Vector3d& normal) {
  Vector3d free = normal;
  for (int c = 0; c < 3; ++c)
    if ((held >> c & 1) != 0)
      free[c] = 0;
  if (length_of(free) > std::cos(radians(largest_symmetry_turn)))
    normal = unit_of(free);
}

void nodal_normals(const Surface& surface, std::span<const Vector3d> x, std::span<const HeldComponents> held,
                   std::vector<Vector3d>& normals) {
  normals.assign(surface.nodes.size(), Vector3d(0, 0, 0));
  for (const auto& face : surface.faces) {
    const auto coordinates = values_of(face, x);
    for (std::size_t i = 0; i < face.node_span().size(); ++i)
      add_scaled(1, outward_normal(face.type, coordinates, node_place(face.type, i)),
                 normals[static_cast<std::size_t>(face.positions[i])]);
  }
  for (std::size_t j = 0; j < normals.size(); ++j) {
    normals[j] = length_of(normals[j]) > no_direction ? unit_of(normals[j]) : Vector3d(0, 0, 0);
    if (!held.empty())
      remove_held(held[j], normals[j]);
  }
}

std::vector<int> tangent_neighbours(const Surface& surface) {
  std::vector<int> neighbours(surface.nodes.size());
  for (std::size_t j = 0; j < neighbours.size(); ++j) {
    const auto& face = surface.faces[static_cast<std::size_t>(surface.faces_of_node[j].front())];
    const auto* const at = std::find(face.positions.begin(), face.positions.end(), static_cast<int>(j));
    neighbours[j] = face.positions[static_cast<std::size_t>(
        neighbour_in(face.type, static_cast<int>(at - face.positions.begin())))];
  }
  return neighbours;
}

Frame frame_of(const Vector3d& outward, const Vector3d& along, int dimension) {
  const Vector3d n = scaled(-1, outward);
  Vector3d first(-n[1], n[0], 0);
  if (dimension == 3) {
    const Vector3d across = part_across(n, along);
    first = length_of(across) > no_direction * length_of(along) ? unit_of(across) : any_across(n);
  }
  const Vector3d second = cross(n, first);
  Frame frame;
  frame.normal = n;
  for (int i = 0; i < 3; ++i) {
    frame.tangents(i, 0) = first[i];
    frame.tangents(i, 1) = second[i];
  }
  return frame;
}

Eigen::Matrix<double, 3, 2> turned(const Eigen::Matrix<double, 3, 2>& tangents, const Frame& from,
                                   const Frame& to) {
  Eigen::Matrix<double, 3, 2> result;
  for (int a = 0; a < 2; ++a) {
    const Vector3d tangent = column_of(tangents, a);
    Vector3d sum = scaled(dot(from.normal, tangent), to.normal);
    for (int b = 0; b < 2; ++b)
      add_scaled(dot(column_of(from.tangents, b), tangent), column_of(to.tangents, b), sum);
    for (int c = 0; c < 3; ++c)
      result(c, a) = sum[c];
  }
  return result;
}

namespace {

/// Two faces with a common edge.
struct CommonEdge {
  int one = 0;
  int other = 0;
  double cosine = 1; ///< of the angle between their normals there; 1 where one has no area
};

/// All of them, the first face at an edge with each of the others.
template <class Visit>
void for_each_common_edge(const Surface& surface, std::span<const Vector3d> x, const Visit& visit) {
  std::map<Edge, std::vector<EdgePlace>> edges;
  for (std::size_t f = 0; f < surface.faces.size(); ++f) {
    const auto& face = surface.faces[f];
    for_each_side(face.type, [&](const LocalEdge& side) {
      edges[nodes_of(face, side)].push_back(place_on(face, static_cast<int>(f), side));
    });
  }
  const auto normal_at = [&](const EdgePlace& place) {
    const auto& face = surface.faces[static_cast<std::size_t>(place.face)];
    return outward_normal(face.type, values_of(face, x), place.xi);
  };
  for (const auto& [edge, places] : edges)
    for (std::size_t i = 1; i < places.size(); ++i) {
      const Vector3d one = normal_at(places[0]), other = normal_at(places[i]);
      const bool known = !is_zero(one) && !is_zero(other);
      visit(CommonEdge{places[0].face, places[i].face, known ? dot(one, other) : 1});
    }
}

} // namespace

std::optional<std::pair<int, int>> first_sharp_edge(const Surface& surface, std::span<const Vector3d> x,
                                                    double degrees) {
  const double least_cosine = std::cos(radians(degrees));
  std::optional<std::pair<int, int>> first;
  for_each_common_edge(surface, x, [&](const CommonEdge& edge) {
    const std::pair faces{edge.one, edge.other};
    if (edge.cosine < least_cosine && (!first || faces < *first))
      first = faces;
  });
  return first;
}

std::vector<std::pair<int, int>> smooth_neighbours(const Surface& surface, std::span<const Vector3d> x,
                                                   double degrees) {
  const double least_cosine = std::cos(radians(degrees));
  std::vector<std::pair<int, int>> pairs;
  for_each_common_edge(surface, x, [&](const CommonEdge& edge) {
    if (!(edge.cosine < least_cosine))
      pairs.emplace_back(std::minmax(edge.one, edge.other));
  });
  return pairs;
}

} // namespace rubato::contact::mortar
