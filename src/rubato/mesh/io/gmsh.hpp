// SPDX-License-Identifier: LGPL-3.0-or-later
/// Gmsh's geometries (.geo), meshed on the way through Gmsh's own library. Meshes (.msh) need none: msh.hpp.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>

namespace rubato::mesh {

/// The mesh that Gmsh makes of a .geo file, as read_msh reads what Gmsh saves of it: the cells in physical
/// groups, every cell when there are no such groups. Throws InputError when the file is absent or Gmsh
/// refuses it, when its mesh holds no cells or cells this project doesn't know, and when the program was
/// built without Gmsh or doesn't find its library.
Mesh read_geo(const std::filesystem::path& path);

/// Whether read_geo was built in.
bool is_gmsh_built_in();

/// Whether read_geo can do more than throw. Loads Gmsh's library.
bool has_gmsh();

} // namespace rubato::mesh
