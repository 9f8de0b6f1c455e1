// SPDX-License-Identifier: LGPL-3.0-or-later
/// A mesh as VTK's unstructured grids have it, whatever file they go to.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::mesh {

/// Which cells are written.
enum class VtuCells {
  of_highest_dimension, ///< the bodies alone
  all                   ///< faces, edges and points too
};

/// Cells block by block, with VTK's types and in the order that VTK gives their nodes.
struct VtkCells {
  std::vector<const CellBlock*> blocks; ///< of the mesh that they were taken from
  std::vector<std::int32_t> connectivity;
  std::vector<std::int64_t> ends; ///< of each cell's nodes in `connectivity`
  std::vector<std::uint8_t> types;
  std::vector<std::int64_t> numbers; ///< the file's own; empty where they are not known
};
VtkCells vtk_cells(const Mesh& mesh, VtuCells which);

/// The type of cell that VTK numbers so (vtkCellType.h); nothing for one that this project does not know.
std::optional<CellType> cell_type_of_vtk(int number);

/// The nodes of a cell, which stand as VTK orders them, in this project's order.
std::vector<NodeIndex> from_vtk_order(CellType type, std::span<const NodeIndex> nodes);

/// How names of arrays that stand for groups begin.
constexpr std::string_view vtk_group_prefix = "group_";

/// Which of the points or of the cells written belong to a group: 1, of others 0.
struct VtkGroup {
  std::string name; ///< the prefix and the name of the group
  std::vector<std::uint8_t> members;
};
struct VtkGroups {
  std::vector<VtkGroup> of_points; ///< groups of nodes; of cells that are not written, their nodes
  std::vector<VtkGroup> of_cells;
};
/// Where a group of nodes and one of faces share a name, the one of nodes is taken.
VtkGroups vtk_groups(const Mesh& mesh, const VtkCells& cells);

/// The numbers with so many significant digits, rounded in binary: bits that say no more are 0, which makes
/// files smaller. The error is at most half a unit of the last digit. From 16 digits on as they are.
std::vector<double> with_digits(std::span<const double> values, int digits);

} // namespace rubato::mesh
