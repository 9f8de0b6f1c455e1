// SPDX-License-Identifier: LGPL-3.0-or-later
/// Edges of contact faces by the numbers of the nodes in the face.
#pragma once

#include "rubato/cell/topology.hpp"

#include <cstddef>

namespace rubato::contact {

struct LocalEdge {
  int from = 0;
  int to = 0;
  int middle = -1; ///< the node between; −1 without
};

/// Calls visit(edge) for each edge of a face in space, and for a segment itself.
template <class Visit> void for_each_edge(CellType type, const Visit& visit) {
  const auto& cell = cell::topology(type);
  const auto middle = [&](int edge) { return cell.order == 2 ? cell.corner_count + edge : -1; };
  if (cell.dimension == 1)
    return visit(LocalEdge{0, 1, middle(0)});
  int number = 0;
  for (const auto& [from, to] : cell.edges)
    visit(LocalEdge{from, to, middle(number++)});
}

/// Calls visit(edge) for what a face shares with a neighbour: each edge in space; each end of a segment, as
/// an edge from the end to itself.
template <class Visit> void for_each_side(CellType type, const Visit& visit) {
  if (cell::topology(type).dimension != 1)
    return for_each_edge(type, visit);
  visit(LocalEdge{0, 0, -1});
  visit(LocalEdge{1, 1, -1});
}

/// Whether a node of the face lies on no edge: TRIA7 and QUAD9.
inline bool has_node_inside(CellType type) {
  const auto& cell = cell::topology(type);
  return cell.dimension == 2 && cell.node_count > cell.corner_count + static_cast<int>(cell.edges.size());
}

} // namespace rubato::contact
