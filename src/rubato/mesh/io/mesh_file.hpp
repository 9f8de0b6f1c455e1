// SPDX-License-Identifier: LGPL-3.0-or-later
/// Mesh files of any known format.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rubato::mesh {

/// Reads a file of any format of all_formats() that is read; a file with another ending is recognised by its
/// first bytes. A plane mesh with three coordinates, one z for all nodes but for rounding, becomes a mesh in
/// the plane. `mesh_name` chooses among the meshes of a MED file. Throws InputError as the format's function
/// does, and for a file of no known format.
Mesh read_mesh(const std::filesystem::path& path, const std::string& mesh_name = "");

/// Writes a file of the format that has its ending (.vtu: cells of every dimension, no groups). Throws
/// InputError for an ending of no format that is written, and as the format's function does.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh);

/// A mesh format: how its files are recognised, and what reads and writes them.
struct Format {
  std::vector<std::string_view> endings;  ///< of file names, in lower case: ".med"
  std::vector<std::string_view> openings; ///< first bytes of a file whose ending says nothing; at most 16
  /// `mesh_name` chooses among several meshes of a file. nullptr: such files are not read.
  Mesh (*read)(const std::filesystem::path& path, const std::string& mesh_name);
  void (*write)(const std::filesystem::path& path, const Mesh& mesh); ///< nullptr: not written
  std::string_view summary;
  bool is_built_in = true; ///< else `read` says what this build lacks
};
/// Every mesh format of this build, for `rubato list`.
std::vector<Format> all_formats();

/// The endings of the files that this build reads: ".med, .rmed, .mmed, .msh, .mail".
std::string readable_endings();

} // namespace rubato::mesh
