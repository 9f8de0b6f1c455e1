// SPDX-License-Identifier: LGPL-3.0-or-later
/// What an iterative solver is told of the unknowns: their nodes, and how rigid motions of the whole move
/// them.
#pragma once

#include "rubato/linalg/iterative_solver.hpp"
#include "rubato/model/fwd.hpp"

namespace rubato::step {

/// Rigid motions of the undeformed bodies: in the plane two shifts and a turn, in space three of each.
/// Sections of axisymmetric bodies have those of the plane: far from the axis they stretch little.
linalg::NodalUnknowns nodal_unknowns(const model::Model& model);

} // namespace rubato::step
