// SPDX-License-Identifier: LGPL-3.0-or-later
/// The same mesh with cells of another order. Groups and the numbers of nodes and cells are kept; new nodes
/// are numbered after the largest number and belong to no group of nodes. New nodes are shared by the cells
/// that share the edge or face itself (its corner nodes), so coincident bodies stay apart.
#pragma once

#include "rubato/mesh/mesh.hpp"

namespace rubato::study {
enum class MeshConversion;
}

namespace rubato::mesh {

/// Corners only. Nodes that were middles or centres and are no cell's corner are dropped, also from groups.
Mesh to_linear(const Mesh& mesh);

/// Linear cells get nodes in the middles of their edges; quadratic ones stay as they are.
Mesh to_quadratic(const Mesh& mesh);

/// HEXA27 and QUAD9, and TRIA7 in 2D, from whatever order: face and body nodes stand where the serendipity
/// functions of face and body put their centre (QUAD8: −1/4 Σ corners + 1/2 Σ middles). Tetrahedra, prisms,
/// pyramids and the faces that bound them stay quadratic. Throws InputError when a hexahedron shares a face
/// with a prism or a pyramid.
Mesh to_full_quadratic(const Mesh& mesh);

/// The conversion a deck asks for.
Mesh converted(const Mesh& mesh, study::MeshConversion conversion);

} // namespace rubato::mesh
