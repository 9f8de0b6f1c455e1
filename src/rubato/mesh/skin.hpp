// SPDX-License-Identifier: LGPL-3.0-or-later
/// The surface of bodies: sides of bulk cells with their nodes ordered so that the normal points out of the
/// body. Bulk cells are those of the dimension of space. They must be positive: call mend_orientation first.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rubato::mesh {

/// A side of a bulk cell. In 2D it is a segment and the normal (t_y, −t_x) of its direction t points out.
struct SurfaceFace {
  static constexpr CellIndex none = -1;

  CellType type = CellType::point1;
  std::uint8_t side = 0;  ///< which side of the owner
  CellIndex owner = none; ///< the bulk cell it bounds
  CellIndex face = none;  ///< the mesh's own cell on this side, `none` when no cell was asked for
  std::array<NodeIndex, 9> node_list{};

  /// node_count(type) nodes in the order of `type`, the normal pointing out of the owner.
  std::span<const NodeIndex> nodes() const {
    return std::span(node_list).first(static_cast<std::size_t>(cell::topology(type).node_count));
  }
};

/// The sides that belong to one of `bulk_cells` only, in the order of the cells and of their sides. Cells of
/// other dimensions are passed over.
std::vector<SurfaceFace> skin(const Mesh& mesh, std::span<const CellIndex> bulk_cells);

/// The skin of every body of the mesh.
std::vector<SurfaceFace> skin(const Mesh& mesh);

struct OrientedFaces {
  std::vector<SurfaceFace> faces; ///< in the order asked for, without the faulty ones below

  std::vector<CellIndex> not_faces; ///< cells whose dimension is not that of space minus one
  std::vector<CellIndex> unowned;   ///< sides of no bulk cell
  std::vector<CellIndex> inside;    ///< sides of two bulk cells: no skin, no outside
  bool sound() const { return not_faces.empty() && unowned.empty() && inside.empty(); }
};

/// For each of `cells` (a group of faces) the bulk cell whose side has the same corner nodes. Type and nodes
/// are those of the owner's side, so that a linear face on a quadratic solid still moves as the solid does.
OrientedFaces oriented_faces(const Mesh& mesh, std::span<const CellIndex> cells);

/// One sentence for each kind of fault, with the number of cells and the first one's number; none when sound.
std::vector<std::string> faults_of(const Mesh& mesh, const OrientedFaces& surface);

} // namespace rubato::mesh
