// SPDX-License-Identifier: LGPL-3.0-or-later
#include "rubato/mesh/face_cells.hpp"

namespace rubato::mesh {
namespace {

CornerSet corners(CellType type, std::span<const NodeIndex> nodes) {
  return corner_set(nodes.first(static_cast<std::size_t>(cell::topology(type).corner_count)));
}

} // namespace

FaceCells::FaceCells(const Mesh& mesh) : mesh_(mesh), old_count_(mesh.cell_count()), skin_(skin(mesh)) {
  for (const auto& face : skin_)
    skin_sets_.insert(corners(face.type, face.nodes()));
  for_each_cell(mesh, [&](CellIndex cell, const cell::CellTopology& shape, std::span<const NodeIndex> nodes) {
    if (shape.dimension != mesh.dimension - 1)
      return;
    const auto number = static_cast<std::size_t>(cell_sets_.insert(corners(shape.type, nodes)));
    if (number == cells_.size())
      cells_.push_back(cell);
  });
}

CellIndex FaceCells::cell_of(const SurfaceFace& face) {
  const auto number = static_cast<std::size_t>(cell_sets_.insert(corners(face.type, face.nodes())));
  if (number == cells_.size()) {
    cells_.push_back(old_count_ + static_cast<CellIndex>(added_.size()));
    added_.push_back(face);
  }
  return cells_[number];
}

const SurfaceFace* FaceCells::face_of(CellIndex cell) const {
  const auto number = skin_sets_.find(corners_of(cell));
  return number == CornerSets::none ? nullptr : &skin_[static_cast<std::size_t>(number)];
}

CellType FaceCells::type_of(CellIndex cell) const {
  return is_new(cell) ? added_[static_cast<std::size_t>(cell - old_count_)].type : mesh_.type_of(cell);
}

std::span<const NodeIndex> FaceCells::nodes_of(CellIndex cell) const {
  return is_new(cell) ? added_[static_cast<std::size_t>(cell - old_count_)].nodes() : mesh_.nodes_of(cell);
}

CornerSet FaceCells::corners_of(CellIndex cell) const {
  return corners(type_of(cell), nodes_of(cell));
}

} // namespace rubato::mesh
