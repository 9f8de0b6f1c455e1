// SPDX-License-Identifier: LGPL-3.0-or-later
/// Uniform refinement of any mesh.
#pragma once

#include "rubato/mesh/mesh.hpp"

namespace rubato::mesh {

/// Every edge cut into `parts` equal parts of the reference cell: segments into 2, triangles and quadrangles
/// into 4, solids into 8 cells of the same type at each halving; curved cells keep their curve. Tetrahedra
/// are cut along the shortest inner diagonal. Old nodes keep index, number and groups, new cells take the
/// groups of the cell they come from, cells are numbered anew from 1. Throws InputError when `parts` is not a
/// power of two, for pyramids and PENTA18, and when nodes would outgrow their index.
Mesh refined(const Mesh& mesh, int parts);

} // namespace rubato::mesh
