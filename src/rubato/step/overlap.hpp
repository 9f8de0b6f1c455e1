// SPDX-License-Identifier: LGPL-3.0-or-later
/// Bodies that overlap when a run begins, as those of interference fits do. Contact closes the overlap in the
/// first step, and its pressures do work on the way: energy that the overlap brings along, which no load or
/// support has given. Formulas: docs/theory/energy.md, "Overlaps".
#pragma once

#include "rubato/model/fwd.hpp"
#include "rubato/step/state.hpp"

#include <vector>

namespace rubato::step {

/// How deep the points of every zone stand in what they face, and nothing presses on them yet; 0 where none
/// does. [length]
using Overlaps = std::vector<std::vector<double>>;

/// Those of the state a run begins with. A point that presses already, as in the end of another run, has an
/// energy of its own there. Empty when there are none.
Overlaps overlaps_of(const model::Model& model, const State& start);

/// What the overlaps give in the step to `trial`, the first one: the trapezoidal rule's work of the pressures
/// over the part of each that the step closes. Springs keep what they have not closed: they are given the
/// whole. [force · length], ≥ 0
double work_of_overlaps(const model::Model& model, const Overlaps& overlaps, const State& trial);

/// What the same pressures give in the second step where they leave: by the trapezoidal rule half of them
/// acts over the opening, and in motion they throw the bodies about as far apart as they overlapped. [force ·
/// length], ≥ 0
double work_of_rebound(const model::Model& model, const Overlaps& overlaps, const State& committed,
                       const State& trial);

} // namespace rubato::step
