// SPDX-License-Identifier: LGPL-3.0-or-later
/// Groups that a study makes of what its mesh has.
#pragma once

#include "rubato/mesh/mesh.hpp"
#include "rubato/study/mesh_source.hpp"

#include <span>

namespace rubato::mesh {

/// A node is inside of a shape, or on it, up to this part of the bounding box' diagonal: coordinates in files
/// have at least that many digits.
constexpr double shape_rounding = 1e-6;

/// The mesh with these groups besides its own. Faces of bodies that a group has and the mesh has not become
/// cells of it, numbered after the others; nodes and cells keep numbers and names. The groups must keep the
/// rules of study::validate, cells must be positive (mend_orientation). Throws InputError with a fault for
/// each group that cannot be made or has nothing in it, at its path, "mesh.groups.top".
Mesh with_groups(Mesh mesh, std::span<const study::MadeGroup> groups);

} // namespace rubato::mesh
