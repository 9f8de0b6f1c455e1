// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/contact/sharp_edges.hpp"

#include "rubato/contact/kinks.hpp"
#include "rubato/contact/mortar/frames.hpp"
#include "rubato/core/disjoint_sets.hpp"

#include <algorithm>
#include <set>

namespace rubato::contact {
namespace {

using Sides = std::vector<std::vector<int>>; ///< faces around one node, by smooth side

using FacePairs = std::set<std::pair<int, int>>; ///< (low, high)

bool joined(const FacePairs& smooth, int one, int other) {
  return smooth.contains(std::minmax(one, other));
}

/// Adds a face to the sides around a node: those that it joins become one.
void add_face(const FacePairs& smooth, int face, Sides& sides) {
  std::vector<int> own;
  std::erase_if(sides, [&](const auto& side) {
    const bool joins = std::ranges::any_of(side, [&](int other) { return joined(smooth, face, other); });
    if (joins)
      own.insert(own.end(), side.begin(), side.end());
    return joins;
  });
  own.push_back(face);
  std::ranges::sort(own);
  sides.push_back(std::move(own));
}

Sides sides_around(const FacePairs& smooth, const std::vector<int>& faces) {
  Sides sides;
  for (const int face : faces)
    add_face(smooth, face, sides);
  std::ranges::sort(sides);
  return sides;
}

/// The faces of a side know their node by its new position.
void place_node(int position, mesh::NodeIndex node, const std::vector<int>& side, Surface& surface) {
  for (const int face : side) {
    auto& placed = surface.faces[static_cast<std::size_t>(face)];
    const auto found = std::ranges::find(placed.node_span(), node) - placed.node_span().begin();
    placed.positions[static_cast<std::size_t>(found)] = position;
  }
}

} // namespace

Surface with_split_edges(const Surface& surface, std::span<const Eigen::Vector3d> undeformed) {
  const auto pairs = mortar::smooth_neighbours(surface, undeformed);
  const FacePairs smooth(pairs.begin(), pairs.end());
  Surface split = surface;
  split.nodes.clear();
  split.faces_of_node.clear();
  std::vector<Eigen::Vector3d> places;
  for (std::size_t j = 0; j < surface.nodes.size(); ++j)
    for (auto& side : sides_around(smooth, surface.faces_of_node[j])) {
      place_node(static_cast<int>(split.nodes.size()), surface.nodes[j], side, split);
      split.nodes.push_back(surface.nodes[j]);
      split.faces_of_node.push_back(std::move(side));
      places.push_back(undeformed[j]);
    }
  measure_kinks(places, split);
  return split;
}

std::vector<std::size_t> smooth_parts(const Surface& surface, std::span<const Eigen::Vector3d> undeformed) {
  DisjointSets sets(surface.faces.size());
  for (const auto& [one, other] : mortar::smooth_neighbours(surface, undeformed))
    sets.join(static_cast<std::size_t>(one), static_cast<std::size_t>(other));
  std::vector<std::size_t> part_of_face(surface.faces.size());
  std::size_t count = 0;
  for (std::size_t f = 0; f < part_of_face.size(); ++f) {
    const auto root = sets.root(f); // the part's first face
    part_of_face[f] = root == f ? count++ : part_of_face[root];
  }
  return part_of_face;
}

} // namespace rubato::contact
