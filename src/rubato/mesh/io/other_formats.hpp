// SPDX-License-Identifier: LGPL-3.0-or-later
/// Inside the module only: mesh formats besides MED and VTK.
#pragma once

#include "rubato/mesh/io/mesh_file.hpp"

#include <vector>

namespace rubato::mesh {

/// Gmsh's .msh and .geo, Code_Aster's .mail, Abaqus' and CalculiX' .inp. A build with RUBATO_RUNS_ONLY
/// refuses to read them.
std::vector<Format> other_formats();

} // namespace rubato::mesh
