// SPDX-License-Identifier: LGPL-3.0-or-later
/// The sign of cells: all other modules expect bulk cells of positive volume (in 2D: counter-clockwise).
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace rubato::mesh {

/// Length, area or volume of the cell that the corner nodes span [length^dimension of the cell]. Solids, and
/// surface cells of a 2D mesh, are negative when their nodes run the wrong way round; others never are. Exact
/// for straight edges (volume between bilinear faces included).
double signed_measure(const Mesh& mesh, CellIndex cell);
double signed_measure(CellType type, std::span<const NodeIndex> nodes,
                      const std::vector<Eigen::Vector3d>& points, int space_dimension);

/// The numbering of the mirrored cell: local node i of the mirrored cell is local node mirror[i] of this one.
/// It is its own inverse.
std::span<const std::uint8_t> mirrored_numbering(CellType type);

/// Mirrors the numbering of every bulk cell of negative measure, of any type; returns these cells, ascending.
/// The nodes stay where they are, and so do groups and cell numbers.
std::vector<CellIndex> mend_orientation(Mesh& mesh);

} // namespace rubato::mesh
