// SPDX-License-Identifier: LGPL-3.0-or-later
/// The evaluation of one cell, by formulation.
#pragma once

#include "rubato/element/nonlinear.hpp"

namespace rubato::element {

/// evaluate() of a kind that is offered.
CellResult evaluate_cell(const CellKind& kind, const PointLaws& laws, const CellInput& input,
                         const CellOutput& output);

} // namespace rubato::element
