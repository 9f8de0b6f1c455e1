// SPDX-License-Identifier: LGPL-3.0-or-later
/// Kernels of the physics, each compiled in a source of its own.
#pragma once

#include "rubato/element/energy_momentum.hpp"
#include "rubato/element/nonlinear.hpp"

namespace rubato::element {

CellResult evaluate_solid(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                          const CellOutput& output);
CellResult evaluate_plane(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                          const CellOutput& output);
CellResult evaluate_axisymmetric(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                                 const CellOutput& output);

/// The same of forces over a step, in finite strain.
BetweenResult evaluate_between_solid(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                                     const BetweenOutput& output);
BetweenResult evaluate_between_plane(const CellKind& kind, const PointLaws& laws, const BetweenInput& input,
                                     const BetweenOutput& output);
BetweenResult evaluate_between_axisymmetric(const CellKind& kind, const PointLaws& laws,
                                            const BetweenInput& input, const BetweenOutput& output);

} // namespace rubato::element
