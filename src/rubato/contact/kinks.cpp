// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/kinks.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/sharp_edges.hpp"
#include "rubato/contact/small_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace rubato::contact {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Kinks below that are rounding: of half a thousandth of a degree.
constexpr double no_kink = 1e-11;

/// An edge of a face by the positions of its corners, ascending, and its middle node or −1. In 2D an end.
struct FaceEdge {
  std::array<int, 2> corners{};
  int middle = -1;
};

template <class Visit> void for_each_edge(const Face& face, const Visit& visit) {
  const auto& cell = cell::topology(face.type);
  const auto position = [&](std::size_t node) { return face.positions[node]; };
  if (cell.dimension == 1) {
    for (const std::size_t end : {0U, 1U})
      visit(FaceEdge{{position(end), position(end)}});
    return;
  }
  for (std::size_t e = 0; e < cell.edges.size(); ++e) {
    const int one = position(cell.edges[e][0]), other = position(cell.edges[e][1]);
    const int middle = cell.order == 2 ? position(static_cast<std::size_t>(cell.corner_count) + e) : -1;
    visit(FaceEdge{{std::min(one, other), std::max(one, other)}, middle});
  }
}

void find_borders(Surface& surface) {
  std::map<std::array<int, 2>, int> faces_at;
  for (const auto& face : surface.faces)
    for_each_edge(face, [&](const FaceEdge& edge) { ++faces_at[edge.corners]; });
  surface.at_edge.assign(surface.nodes.size(), 0);
  for (const auto& face : surface.faces)
    for_each_edge(face, [&](const FaceEdge& edge) {
      if (faces_at[edge.corners] != 1)
        return;
      for (const int node : {edge.corners[0], edge.corners[1], edge.middle})
        if (node >= 0)
          surface.at_edge[static_cast<std::size_t>(node)] = 1;
    });
}

using NodeNormals = std::array<Vector3d, 9>;

NodeNormals normals_at_nodes(const Face& face, std::span<const Vector3d> undeformed) {
  const auto coordinates = values_of(face, undeformed);
  const auto& nodes = cell::reference_cell(face.type).nodes;
  NodeNormals normals;
  for (std::size_t i = 0; i < face.node_span().size(); ++i)
    normals[i] = outward_normal(face.type, coordinates, Vector2d(nodes[i][0], nodes[i][1]));
  return normals;
}

std::size_t index_of(const Face& face, int position) {
  const auto positions = face.position_span();
  return static_cast<std::size_t>(std::ranges::find(positions, position) - positions.begin());
}

void measure_kink(std::size_t face, std::size_t node, std::span<const NodeNormals> normals,
                  Surface& surface) {
  const double least_cosine = std::cos(sharp_edge * std::numbers::pi / 180);
  const int position = surface.faces[face].positions[node];
  const auto& own = normals[face][node];
  Vector3d sum(0, 0, 0);
  int count = 0;
  for (const int other : surface.faces_of_node[static_cast<std::size_t>(position)]) {
    const auto at = static_cast<std::size_t>(other);
    const auto& normal = normals[at][index_of(surface.faces[at], position)];
    if (at != face && dot(normal, own) < least_cosine) {
      surface.at_edge[static_cast<std::size_t>(position)] = 1;
      continue;
    }
    add_scaled(1, normal, sum);
    ++count;
  }
  const double kink = 1 - length_of(sum) / count;
  surface.faces[face].kinks[node] = kink > no_kink ? kink : 0;
}

} // namespace

void measure_kinks(std::span<const Vector3d> undeformed, Surface& surface) {
  find_borders(surface);
  std::vector<NodeNormals> normals;
  normals.reserve(surface.faces.size());
  for (const auto& face : surface.faces)
    normals.push_back(normals_at_nodes(face, undeformed));
  for (std::size_t f = 0; f < surface.faces.size(); ++f)
    for (std::size_t i = 0; i < surface.faces[f].node_span().size(); ++i)
      measure_kink(f, i, normals, surface);
}

} // namespace rubato::contact
