// SPDX-License-Identifier: LGPL-3.0-or-later
/// Groups of what is inside of a shape, of faces that look somewhere, of faces that bound a part.
#pragma once

#include "rubato/mesh/group_sources.hpp"

namespace rubato::mesh {

/// Nodes inside of a box, a sphere, a cylinder or on a plane, or cells or faces of bodies whose nodes all
/// are; up to `rounding` [length]. Throws InputError with what is nearest when there are none.
GroupItems inside_of(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                     FaceCells& faces, double rounding);

/// Faces of the bodies whose outward normal, of their corners, is within the group's angle of its direction.
/// Throws InputError with the nearest angle when there are none, and for cells that bound no body.
GroupItems facing(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                  FaceCells& faces);

/// Faces of the skin of the bodies behind which the cells of the group are. Throws InputError when there are
/// none.
GroupItems outside_of(const study::MadeGroup& group, const GroupSources& sources, const Mesh& mesh,
                      FaceCells& faces);

} // namespace rubato::mesh
