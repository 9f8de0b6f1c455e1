// SPDX-License-Identifier: LGPL-3.0-or-later
/// What laws are where nothing has happened yet.
#pragma once

#include "rubato/element/nonlinear.hpp"
#include "rubato/material/point_law.hpp"

namespace rubato::domain {

/// The tangent in small strain.
material::ElasticPoint first_tangent(const material::PointLaw& law);

/// G, in space the least one of the three planes, and of laws that yield the strain σ_y/(√3 G) at which they
/// do in shear.
element::HourglassControl hourglass_control(const material::PointLaw& law, study::Physics physics);

} // namespace rubato::domain
