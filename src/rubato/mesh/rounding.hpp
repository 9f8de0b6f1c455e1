// SPDX-License-Identifier: LGPL-3.0-or-later
/// Coordinates that are what they are meant to be but for rounding.
#pragma once

#include "rubato/mesh/mesh.hpp"

namespace rubato::mesh {

/// Coordinates nearer than this part of the bounding box' diagonal are the same. Meshers, rotations and
/// conversions of units leave differences of 1e-16 to 1e-10; no cell is this thin.
constexpr double coordinate_rounding = 1e-9;

/// The bounding box' diagonal [length]; NaN when a coordinate is not finite, 0 without nodes.
double diagonal(const Mesh& mesh);

/// Makes a mesh in space a plane one, z = 0 everywhere, when it has cells but no solids and all its nodes
/// share one z but for rounding: what meshers write of a plane geometry. Returns whether it did.
bool lay_flat(Mesh& mesh);

/// Puts nodes that are off the line x = 0 by rounding onto it, as an axisymmetric model wants them.
void snap_to_axis(Mesh& mesh);

} // namespace rubato::mesh
