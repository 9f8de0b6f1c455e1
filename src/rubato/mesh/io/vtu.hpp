// SPDX-License-Identifier: LGPL-3.0-or-later
/// VTK's unstructured grids (.vtu), for ParaView: XML with appended binary data, compressed by zlib.
#pragma once

#include "rubato/mesh/io/vtk_grid.hpp"
#include "rubato/mesh/mesh.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rubato::mesh {

/// One value array over the nodes or over the cells that are written.
struct VtuArray {
  std::string name;
  int components = 1;
  std::span<const double> values;           ///< node by node or cell by cell, count · components
  std::vector<std::string> component_names; ///< as many as components, or none
  bool of_cells = false;
};

struct VtuSettings {
  VtuCells which = VtuCells::of_highest_dimension;
  std::span<const Eigen::Vector3d> points = {}; ///< one a node: a deformed shape; empty: the mesh's
  int digits = 17;                              ///< that are kept of the arrays (with_digits)
};

/// Writes mesh and arrays; the file's own numbers go along as "node_number" and "cell_number" where known,
/// and for each group an array of 1 and 0 (vtk_groups). Throws InputError when the file can't be made,
/// WriteError when it can't be written to its end (the former one is still there then);
/// std::invalid_argument for an array of the wrong size.
void write_vtu(const std::filesystem::path& path, const Mesh& mesh, std::span<const VtuArray> arrays = {},
               const VtuSettings& settings = {});

/// `text` with &, <, > and quotes written as XML wants them.
std::string xml_escaped(const std::string& text);

} // namespace rubato::mesh
