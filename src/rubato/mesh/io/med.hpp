// SPDX-License-Identifier: LGPL-3.0-or-later
/// MED files (Salome, Code_Aster): unstructured meshes with groups, read and written through the MED library.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>
#include <string>

namespace rubato::mesh {

/// The mesh of that name in a MED file (versions 3.0 to the library's own), or its only mesh when no name is
/// given. The first computation step of the mesh is taken, the space dimension is the file's. Groups come
/// sorted by name, empty ones included. Where the file numbers neither nodes nor cells they count from 1,
/// cells through the blocks. MED numbers the corners of solids the other way round: the nodes are permuted
/// into this project's order; a cell that the file itself has inside out stays so. Throws InputError when the
/// file is absent, unreadable, truncated, not MED, of another version, without mesh or with several and none
/// named; when the mesh is a structured grid or has cells this project doesn't know.
Mesh read_med(const std::filesystem::path& path, const std::string& mesh_name = "");

/// Writes one mesh into a new MED file (an existing one is replaced), groups as families.
/// Throws InputError when the file can't be made, WriteError when it can't be written to its end (the former
/// one is still there then), and InputError when a name is longer than MED allows (mesh 64, group 80).
void write_med(const std::filesystem::path& path, const Mesh& mesh, const std::string& name = "mesh");

} // namespace rubato::mesh
