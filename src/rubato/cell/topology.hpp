// SPDX-License-Identifier: LGPL-3.0-or-later
/// The cells a mesh is made of: names, node counts, corners, edges and faces.
///
/// Local numbering is VTK's, but for prisms, whose base VTK turns the other way round (mesh/io/vtu.cpp):
/// corners, then mid-edge nodes, then face and body nodes; a cell of positive volume (area) has a positive
/// Jacobian in that order. Faces are listed with their nodes in the order of the face's own cell type and
/// their normal pointing out of the cell.
///   SEG3    0 1 | 2 in the middle
///   TRIA6   0 1 2 | 01 12 20 | TRIA7: + centre
///   QUAD8   0 1 2 3 | 01 12 23 30 | QUAD9: + centre
///   TETRA10 0..3 | 01 12 20 03 13 23
///   PYRA13  0..3 (ζ=0), 4 (apex) | 01 12 23 30 | 04 14 24 34
///   PENTA15 0 1 2 (ζ=−1), 3 4 5 (ζ=+1) | 01 12 20 | 34 45 53 | 03 14 25
///   HEXA20  0..3 (ζ=−1), 4..7 (ζ=+1) | 01 12 23 30 | 45 56 67 74 | 04 15 26 37
///   HEXA27  HEXA20 + face centres ξ=−1, ξ=+1, η=−1, η=+1, ζ=−1, ζ=+1 + body centre
/// Reference cells: SEG [−1,1]; TRIA ξ,η ≥ 0, ξ+η ≤ 1; QUAD [−1,1]²; TETRA ξ,η,ζ ≥ 0, ξ+η+ζ ≤ 1;
/// PYRA |ξ|, |η| ≤ 1−ζ, 0 ≤ ζ ≤ 1; PENTA TRIA × [−1,1]; HEXA [−1,1]³.
#pragma once

#include "rubato/core/cell_type.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace rubato::cell {

/// A side of a cell: its own cell type and the cell's local nodes in that type's order.
struct CellSide {
  CellType type;
  std::span<const std::uint8_t> nodes;
};

struct CellTopology {
  CellType type;
  std::string_view name; ///< upper case, as MED and Code_Aster write it: "HEXA20"
  int dimension;
  int order; ///< 1 linear, 2 quadratic
  int node_count;
  int corner_count;
  /// Sides of dimension − 1, outward: faces of solids, edges of surfaces, none for segments and points.
  std::span<const CellSide> sides;
  /// Corner pairs of the edges, in the order in which the mid-edge nodes are numbered.
  std::span<const std::array<std::uint8_t, 2>> edges;
};

const CellTopology& topology(CellType type);

/// Every cell type there is, in the order of the enumeration.
std::span<const CellTopology> all_topologies();

/// The type of that name, upper or lower case ("hexa20", "HEXA20"); nothing when there is none.
std::optional<CellType> cell_type_named(std::string_view name);

} // namespace rubato::cell
