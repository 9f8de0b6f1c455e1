// SPDX-License-Identifier: LGPL-3.0-or-later
/// Faces of bodies as cells: those that the mesh has, and others that groups need.
#pragma once

#include "rubato/mesh/corner_sets.hpp"
#include "rubato/mesh/skin.hpp"

#include <span>
#include <vector>

namespace rubato::mesh {

/// The skin of the bodies of a mesh, whose faces become cells as they are asked for. Cells are known by
/// their index in the mesh; the k-th new one by `mesh.cell_count() + k` until the mesh is built.
class FaceCells {
public:
  /// `mesh` must outlive it; its cells must be positive.
  explicit FaceCells(const Mesh& mesh);

  /// The faces that bound the bodies, in the order of `skin`.
  std::span<const SurfaceFace> faces() const { return skin_; }
  /// The cell of a face of the skin: one of the mesh with the same corners, else a new one.
  CellIndex cell_of(const SurfaceFace& face);
  /// The face of the skin with the corners of this cell, nullptr when there is none.
  const SurfaceFace* face_of(CellIndex cell) const;

  /// Type and nodes of an old or a new cell.
  CellType type_of(CellIndex cell) const;
  std::span<const NodeIndex> nodes_of(CellIndex cell) const;
  bool is_new(CellIndex cell) const { return cell >= old_count_; }

  /// New cells, the first is `mesh.cell_count()`.
  std::span<const SurfaceFace> added() const { return added_; }

private:
  CornerSet corners_of(CellIndex cell) const;

  const Mesh& mesh_;
  CellIndex old_count_;
  std::vector<SurfaceFace> skin_;
  CornerSets skin_sets_; ///< numbers are places in `skin_`
  CornerSets cell_sets_;
  std::vector<CellIndex> cells_; ///< by number in `cell_sets_`
  std::vector<SurfaceFace> added_;
};

} // namespace rubato::mesh
