// SPDX-License-Identifier: LGPL-3.0-or-later
/// Gmsh's mesh files (.msh), versions 2 and 4.1, as text and binary, read without Gmsh.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>

namespace rubato::mesh {

/// The mesh of a .msh file, in space. Every cell of the file is kept, points excepted; nodes that neither a
/// cell nor a group uses are left out. Physical groups become groups of cells, those of points groups of
/// nodes; a group without a name is called "surface_12" (point_, line_, volume_) by its tag, groups of one
/// name become one. Node and cell numbers are Gmsh's tags; cells keep the order of the file, nodes stand in
/// the order of their tags. Sections about other things are skipped. `called`: what faults call the file when
/// not by its path. Throws InputError when the file is absent, of another format or version, damaged, or
/// holds no cells or cells this project doesn't know.
Mesh read_msh(const std::filesystem::path& path, const std::filesystem::path& called = {});

} // namespace rubato::mesh
