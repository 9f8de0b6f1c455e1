// SPDX-License-Identifier: LGPL-3.0-or-later
/// VTK's unstructured grids (.vtu), for ParaView: XML with raw appended binary data.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rubato::mesh {

/// One value array over the nodes.
struct VtuArray {
  std::string name;
  int components = 1;
  std::span<const double> values;           ///< node-major, node_count · components
  std::vector<std::string> component_names; ///< as many as components, or none
};

enum class VtuCells {
  of_highest_dimension, ///< the bodies alone
  all                   ///< faces, edges and points too
};

/// Writes mesh and node arrays; the file's own numbers go along as "node_number" and "cell_number" where
/// known. `points`, one a node, stand in for the mesh's coordinates when given (a deformed shape). Throws
/// InputError when the file can't be made, WriteError when it can't be written to its end (the former one is
/// still there then); std::invalid_argument for an array of the wrong size.
void write_vtu(const std::filesystem::path& path, const Mesh& mesh, std::span<const VtuArray> arrays = {},
               VtuCells which = VtuCells::of_highest_dimension, std::span<const Eigen::Vector3d> points = {});

/// The type of cell that VTK numbers so (vtkCellType.h); nothing for one that this project does not know.
std::optional<CellType> cell_type_of_vtk(int number);

/// The nodes of a cell, which stand as VTK orders them, in this project's order.
std::vector<NodeIndex> from_vtk_order(CellType type, std::span<const NodeIndex> nodes);

/// `text` with &, <, > and quotes written as XML wants them.
std::string xml_escaped(const std::string& text);

} // namespace rubato::mesh
