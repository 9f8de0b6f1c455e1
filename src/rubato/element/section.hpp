// SPDX-License-Identifier: LGPL-3.0-or-later
/// The physics of cells and the thickness of those in the plane.
#pragma once

#include "rubato/study/study.hpp"

namespace rubato::element {

struct Section {
  study::Physics physics = study::Physics::solid;
  double thickness = 1; ///< plane stress and plane strain only [length]
};

/// Displacement components a node: 3 for solids, else 2.
int component_count(study::Physics physics);

/// The factor from an area or volume of the mesh to that of the body: 1, the thickness, or 2πr at radius `x`.
double measure(const Section& section, double x);

} // namespace rubato::element
