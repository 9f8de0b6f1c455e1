// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "rubato/material/law.hpp"

namespace rubato::material {

/// How a material resists stretching along an axis while it is held across, mean over the axes [stress].
double stretching_stiffness(const Law& law, study::Physics physics);

} // namespace rubato::material
