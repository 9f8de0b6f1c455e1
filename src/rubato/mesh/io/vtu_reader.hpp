// SPDX-License-Identifier: LGPL-3.0-or-later
/// VTK's unstructured grids (.vtu) and their collections (.pvd), read back: those that this program writes,
/// and what the format allows besides: data as text, in base64 or appended, plain or compressed by zlib.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace rubato::mesh::vtk {

/// An array over the nodes; numbers and groups of nodes are not among them.
struct VtuArray {
  std::string name;
  std::vector<std::string> component_names; ///< as many as components
  std::vector<double> values;               ///< node-major
};

struct VtuContent {
  Mesh mesh; ///< dimension: that of its highest cells. Node numbers from "node_number", else from 1
  std::vector<VtuArray> arrays;
};

/// Throws InputError when the file cannot be read, is no unstructured grid of one piece, or is damaged.
VtuContent read_vtu(const std::filesystem::path& path);

/// Its arrays alone, without the mesh.
std::vector<VtuArray> read_vtu_arrays(const std::filesystem::path& path);

struct PvdEntry {
  double time = 0.0;
  std::filesystem::path file; ///< as this program opens it
};

/// The files of a collection; none when there is no such file. Throws InputError when it cannot be read.
std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

} // namespace rubato::mesh::vtk
