// SPDX-License-Identifier: LGPL-3.0-or-later
/// Regular grids of rectangles and boxes.
#pragma once

#include "rubato/mesh/mesh.hpp"

#include <span>

namespace rubato::study {
struct Body;
}

namespace rubato::mesh {

/// One mesh of all bodies, `refine` ≥ 1 times the divisions each asks for. A body's nodes are its own, even
/// where another body's coincide. Nodes and cells are numbered from 1.
///
/// Cells: TRIA3/6/7, QUAD4/8/9 in rectangles, TETRA4/10, PENTA6/15, HEXA8/20/27 in boxes. Triangles split
/// each quadrangle along the diagonal from its lowest to its highest corner, prisms are these triangles along
/// z, tetrahedra split each hexahedron into six around that diagonal (Kuhn's triangulation: conforming
/// everywhere).
///
/// Groups of cells: each body's bulk cells by its name; for every named side the cells that cover it, normals
/// outward, of the type of the bulk cells' own sides; for every named edge of a box its segments. Groups of
/// nodes: the named corner points. Where bodies or sides give the same name the group is the union.
///
/// Throws InputError with every fault found: a size or number of divisions not above 0, a cell type that does
/// not fit the dimension, an unknown side, edge or point, bodies of different dimensions, more nodes than an
/// index holds.
Mesh generate(std::span<const study::Body> bodies, int refine = 1);

} // namespace rubato::mesh
