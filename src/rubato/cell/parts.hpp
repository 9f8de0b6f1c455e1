// SPDX-License-Identifier: LGPL-3.0-or-later
/// Where the nodes of a cell sit: on its corners, the middles of its edges, the centres of its sides, inside
/// it. Local node numbers run in that order (topology.hpp), so every table here follows from the topology.
#pragma once

#include "rubato/cell/topology.hpp"

#include <array>
#include <cstddef>
#include <optional>

namespace rubato::cell {

/// Local number of the node in the middle of an edge; only for cells of order 2.
inline int mid_node(const CellTopology& cell, std::size_t edge) {
  return cell.corner_count + static_cast<int>(edge);
}

/// Local number of the node at the centre of a side: quadrangular sides of full quadratic solids have one.
inline std::optional<int> centre_node(const CellSide& side) {
  if (side.type != CellType::quad9)
    return std::nullopt;
  return side.nodes[8];
}

/// Local number of the node inside the cell: TRIA7, QUAD9 and HEXA27 have one.
inline std::optional<int> inner_node(const CellTopology& cell) {
  switch (cell.type) {
  case CellType::tria7:
  case CellType::quad9:
  case CellType::hexa27:
    return cell.node_count - 1;
  default:
    return std::nullopt;
  }
}

/// The cell of the same shape with corners only, and with corners and mid-edge nodes.
CellType linear_type(CellType type);
CellType quadratic_type(CellType type);

/// The cell of the same shape with every node of the tensor product: QUAD9, HEXA27 and, in a plane, TRIA7.
/// Segments, tetrahedra, prisms, pyramids and the triangles that bound solids have no more than
/// quadratic_type.
CellType full_quadratic_type(CellType type, int space_dimension);

} // namespace rubato::cell
