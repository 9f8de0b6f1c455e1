// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/kinks.hpp"

#include "rubato/cell/reference_cell.hpp"
#include "rubato/contact/face_edges.hpp"
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

/// The positions of the ends of a side, ascending.
std::array<int, 2> ends_of(const Face& face, const LocalEdge& side) {
  const int from = face.positions[static_cast<std::size_t>(side.from)];
  const int to = face.positions[static_cast<std::size_t>(side.to)];
  return {std::min(from, to), std::max(from, to)};
}

void find_borders(Surface& surface) {
  std::map<std::array<int, 2>, int> faces_at;
  for (const auto& face : surface.faces)
    for_each_side(face.type, [&](const LocalEdge& side) { ++faces_at[ends_of(face, side)]; });
  surface.at_edge.assign(surface.nodes.size(), 0);
  for (const auto& face : surface.faces)
    for_each_side(face.type, [&](const LocalEdge& side) {
      if (faces_at[ends_of(face, side)] != 1)
        return;
      for (const int node : {side.from, side.to, side.middle})
        if (node >= 0)
          surface.at_edge[static_cast<std::size_t>(face.positions[static_cast<std::size_t>(node)])] = 1;
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
