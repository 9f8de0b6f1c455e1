// SPDX-License-Identifier: LGPL-3.0-or-later
/// Mesh files of any known format.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace rubato::mesh {

/// Reads .med, .rmed, .mmed (MED), .msh and .geo (Gmsh); a file with another ending is recognised by its
/// first bytes. A plane mesh with three coordinates, one z for all nodes but for rounding, becomes a mesh in
/// the plane. `mesh_name` chooses among the meshes of a MED file. Throws InputError as read_med, read_msh and
/// read_geo do, and for a file of no known format.
Mesh read_mesh(const std::filesystem::path& path, const std::string& mesh_name = "");

/// Writes .med, .rmed, .mmed (groups included) or .vtu (cells of every dimension, no groups), by the file's
/// ending. Throws InputError for any other ending, and as write_med and write_vtu do.
void write_mesh(const std::filesystem::path& path, const Mesh& mesh);

struct FormatEntry {
  std::string_view extension;
  std::string_view summary;
  bool is_read;
  bool is_written;
};
/// Every mesh format of this build, for `rubato list`.
std::span<const FormatEntry> all_formats();

/// The endings of the files that this build reads: ".med, .rmed, .mmed, .msh".
std::string readable_endings();

} // namespace rubato::mesh
