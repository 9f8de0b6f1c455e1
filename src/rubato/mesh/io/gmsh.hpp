// SPDX-License-Identifier: LGPL-3.0-or-later
/// Gmsh files: meshes (.msh) and geometries (.geo, meshed on the way) through Gmsh's own library.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <filesystem>

namespace rubato::mesh {

/// The mesh of a .msh file, or the one that Gmsh makes of a .geo file.
/// As in a file that Gmsh saves, only cells in physical groups are kept, every cell when there are no such
/// groups. Physical groups become groups of cells, those of points groups of nodes; a group without a name is
/// called "surface_12" (point_, line_, volume_) by its tag. Node and cell numbers are Gmsh's tags; nodes that
/// neither a cell nor a group uses are left out. Space is 2D when there are no solids and z = 0 everywhere.
/// Throws InputError when the file is absent or Gmsh refuses it, when it holds no cells or cells this project
/// doesn't know, and when the program was built without Gmsh or doesn't find its library.
Mesh read_gmsh(const std::filesystem::path& path);

/// Whether read_gmsh can do more than throw. Loads Gmsh's library.
bool has_gmsh();

} // namespace rubato::mesh
